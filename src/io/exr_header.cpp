// The layout of an OpenEXR file's header: "OpenEXR File Layout", openexr.com.
#include <cstring>
#include <string_view>

#include "base/error.hpp"
#include "io/image_header.hpp"

namespace tessera {
namespace {

class Cursor {
 public:
  Cursor(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }
  std::span<const std::byte> take(std::size_t count) {
    if (count > bytes_.size()) throw input_error("{}: EXR header is truncated", name_);
    const auto taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  std::int32_t take_int() {
    std::int32_t value = 0;
    std::memcpy(&value, take(4).data(), 4);
    return value;
  }
  std::string take_string() {  // zero-terminated
    const void* end = bytes_.empty() ? nullptr : std::memchr(bytes_.data(), 0, std::min<std::size_t>(left(), 256));
    if (end == nullptr) throw input_error("{}: EXR header holds a name without an end", name_);
    const std::size_t length = std::size_t(static_cast<const std::byte*>(end) - bytes_.data());
    std::string result(reinterpret_cast<const char*>(bytes_.data()), length);
    take(length + 1);
    return result;
  }

 private:
  std::span<const std::byte> bytes_;
  const std::string& name_;
};

void read_channels(std::span<const std::byte> value, ExrHeader& header, const std::string& name) {
  Cursor cursor(value, name);
  while (cursor.left() > 1) {
    ExrHeader::Channel channel;
    channel.name = cursor.take_string();
    if (channel.name.empty()) break;
    const std::int32_t type = cursor.take_int();
    cursor.take(4);  // pLinear, reserved
    const std::int32_t x_sampling = cursor.take_int();
    const std::int32_t y_sampling = cursor.take_int();
    if (type < 0 || type > 2) throw input_error("{}: channel '{}' has unknown type {}", name, channel.name, type);
    if (x_sampling != 1 || y_sampling != 1) {
      throw input_error("{}: channel '{}' is sub-sampled, which is not supported", name, channel.name);
    }
    channel.type = ExrHeader::Type(type);
    header.channels.push_back(channel);
    if (header.channels.size() > 1024) throw input_error("{}: more than 1024 channels", name);
  }
}

void check_tiles(std::span<const std::byte> value, const std::string& name) {
  Cursor cursor(value, name);
  const auto width = std::uint32_t(cursor.take_int());
  const auto height = std::uint32_t(cursor.take_int());
  // 8192 x 8192: a hostile tile size would be allocated before any pixel is read.
  if (width < 1 || height < 1 || width > 8192 || height > 8192) {
    throw input_error("{}: tiles of {} x {} pixels, expected 1 to 8192", name, width, height);
  }
}

}  // namespace

ExrHeader read_exr_header(std::span<const std::byte> bytes, const std::string& name) {
  Cursor cursor(bytes, name);
  if (bytes.size() < 8 || cursor.take_int() != 20000630) throw input_error("{}: not an OpenEXR file", name);
  const auto version = std::uint32_t(cursor.take_int());
  if ((version & 0xff) != 2) throw input_error("{}: EXR version {}, expected 2", name, version & 0xff);

  ExrHeader header;
  header.tiled = (version & 0x200) != 0;
  header.deep = (version & 0x800) != 0;
  bool has_window = false;
  for (;;) {
    const std::string attribute = cursor.take_string();
    if (attribute.empty()) break;
    const std::string type = cursor.take_string();
    const std::int32_t size = cursor.take_int();
    if (size < 0) throw input_error("{}: attribute '{}' has {} bytes", name, attribute, size);
    const auto value = cursor.take(std::size_t(size));
    if (attribute == "dataWindow" && type == "box2i") {
      Cursor box(value, name);
      std::int64_t corner[4];
      for (auto& c : corner) c = box.take_int();
      header.width = corner[2] - corner[0] + 1;
      header.height = corner[3] - corner[1] + 1;
      has_window = true;
    } else if (attribute == "channels" && type == "chlist") {
      read_channels(value, header, name);
    } else if (attribute == "tiles" && type == "tiledesc") {
      check_tiles(value, name);
    } else if (type == "string") {
      const std::string content(reinterpret_cast<const char*>(value.data()), value.size());
      if (attribute == "type") header.tiled = header.tiled || content.ends_with("tile");
      header.strings[attribute] = content;
    }
  }
  if (!has_window) throw input_error("{}: EXR header without a data window", name);
  if (header.channels.empty()) throw input_error("{}: EXR header without channels", name);
  const auto bytes_per_pixel = std::int64_t(header.channels.size()) * 4;
  check_image_size(header.width, header.height, bytes_per_pixel, std::uint64_t{64} << 30, name);
  const std::uint64_t decoded = std::uint64_t(header.width) * std::uint64_t(header.height) * bytes_per_pixel;
  // DWA's zero blocks go furthest: 64 pixels as one value, deflated.
  if (decoded / 65536 > bytes.size()) {
    throw input_error("{}: truncated: {} bytes cannot hold an image of {} bytes", name, bytes.size(), decoded);
  }
  return header;
}

}  // namespace tessera

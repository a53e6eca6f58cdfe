#include "io/image_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <string_view>

#include "base/error.hpp"

namespace tessera {
namespace {

std::string_view text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::uint32_t big_endian(std::span<const std::byte> bytes, std::size_t at, int size) {
  std::uint32_t value = 0;
  for (int i = 0; i < size; ++i) value = value << 8 | std::uint32_t(bytes[at + std::size_t(i)]);
  return value;
}

void check_plausible(std::uint64_t decoded, std::uint64_t file, std::uint64_t ratio, const std::string& name) {
  if (decoded / ratio > file + 65536) {
    throw input_error("{}: truncated: {} bytes cannot hold an image of {} bytes", name, file, decoded);
  }
}

std::uint32_t crc32(std::span<const std::byte> bytes) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      t[i] = i;
      for (int k = 0; k < 8; ++k) t[i] = t[i] >> 1 ^ ((t[i] & 1) != 0 ? 0xedb88320u : 0u);
    }
    return t;
  }();
  std::uint32_t crc = 0xffffffffu;
  for (const std::byte b : bytes) crc = crc >> 8 ^ table[(crc ^ std::uint32_t(b)) & 255];
  return ~crc;
}

// libpng finds these errors too, but reports them on standard error by itself.
void check_png_chunks(std::span<const std::byte> bytes, const std::string& name) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = big_endian(bytes, at, 4);
    const std::string_view type = text(bytes).substr(at + 4, 4);
    if (length > bytes.size() - at - 12) break;
    if (!std::all_of(type.begin(), type.end(),
                     [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); })) {
      throw input_error("{}: damaged: PNG chunk at byte {} has no valid type", name, at);
    }
    const bool critical = type[0] >= 'A' && type[0] <= 'Z';
    if (critical && crc32(bytes.subspan(at + 4, length + 4)) != big_endian(bytes, at + 8 + length, 4)) {
      throw input_error("{}: damaged: PNG chunk at byte {} has a wrong checksum", name, at);
    }
    if (type == "IEND") return;
    at += length + 12;
  }
  throw input_error("{}: truncated: PNG without an end", name);
}

void check_png(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.size() < 33 || text(bytes).substr(12, 4) != "IHDR") throw input_error("{}: PNG without a header", name);
  const std::int64_t width = big_endian(bytes, 16, 4);
  const std::int64_t height = big_endian(bytes, 20, 4);
  check_image_size(width, height, 8, std::uint64_t{8} << 30, name);
  const int depth = int(bytes[24]);
  const int type = int(bytes[25]);
  const int samples = type == 2 ? 3 : type == 4 ? 2 : type == 6 ? 4 : 1;
  // deflate cannot do better than 1032:1.
  check_plausible(std::uint64_t(width) * std::uint64_t(height) * std::uint64_t(depth * samples) / 8, bytes.size(), 1032,
                  name);
  check_png_chunks(bytes, name);
}

void check_jpeg(std::span<const std::byte> bytes, const std::string& name) {
  std::size_t at = 2;
  while (at + 9 < bytes.size()) {
    if (bytes[at] != std::byte{0xff}) throw input_error("{}: JPEG with a broken marker at byte {}", name, at);
    const std::uint32_t marker = big_endian(bytes, at + 1, 1);
    if (marker == 0xff) {  // padding
      ++at;
      continue;
    }
    const bool start_of_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (start_of_frame) {
      check_image_size(big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2), 4, std::uint64_t{8} << 30, name);
      return;
    }
    if (marker == 0xd9 || marker == 0xda) break;
    const bool alone = marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8);
    at += alone ? 2 : 2 + big_endian(bytes, at + 2, 2);
  }
  throw input_error("{}: JPEG without a frame header", name);
}

bool parse_positive(std::string_view& line, std::string_view axis, std::int64_t& value) {
  if (!line.starts_with(axis)) return false;
  line.remove_prefix(axis.size());
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc{} || value <= 0) return false;
  line.remove_prefix(std::size_t(end - line.data()));
  return true;
}

// Ward, "Real Pixels", Graphics Gems II: text lines, an empty line, the resolution line, then scanlines of RGBE.
void check_hdr(std::span<const std::byte> bytes, const std::string& name) {
  std::string_view rest = text(bytes.first(std::min<std::size_t>(bytes.size(), 65536)));
  for (;;) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) throw input_error("{}: HDR header does not end", name);
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
      throw input_error("{}: HDR format is '{}', expected 32-bit_rle_rgbe", name, line.substr(7, 40));
    }
    if (line.empty()) break;
  }
  std::string_view resolution = rest.substr(0, rest.find('\n'));
  const std::string shown(resolution.substr(0, 60));
  std::int64_t width = 0;
  std::int64_t height = 0;
  if (!parse_positive(resolution, "-Y ", height) || !parse_positive(resolution, " +X ", width) || !resolution.empty()) {
    throw input_error("{}: HDR resolution line is '{}', expected '-Y height +X width'", name, shown);
  }
  check_image_size(width, height, 12, std::uint64_t{16} << 30, name);
  // A run of up to 127 equal bytes takes two.
  check_plausible(std::uint64_t(width) * std::uint64_t(height) * 4, bytes.size(), 64, name);
}

}  // namespace

const char* image_format(std::span<const std::byte> bytes, const std::string& name) {
  const std::string_view head = text(bytes.first(std::min<std::size_t>(bytes.size(), 16)));
  if (head.empty()) throw input_error("{}: empty, expected an image", name);
  if (head.starts_with("\x89PNG\r\n\x1a\n")) return "png";
  if (head.starts_with("\xff\xd8\xff")) return "jpeg";
  if (head.starts_with("#?RADIANCE") || head.starts_with("#?RGBE")) return "hdr";
  if (head.starts_with("\x76\x2f\x31\x01")) return "openexr";
  if (head.starts_with("RIFF") && head.substr(8, 4) == "WEBP") return "webp";
  if (head.starts_with("II*\0") || head.starts_with(std::string_view("MM\0*", 4))) return "tiff";
  if (head.starts_with("\xabKTX")) throw input_error("{}: KTX textures are not supported", name);
  throw input_error("{}: not an image that can be read (PNG, JPEG, HDR, OpenEXR, WebP, TIFF)", name);
}

void check_image_header(std::span<const std::byte> bytes, const std::string& format, const std::string& name) {
  if (format == "png") check_png(bytes, name);
  if (format == "jpeg") check_jpeg(bytes, name);
  if (format == "hdr") check_hdr(bytes, name);
  if (format == "openexr") read_exr_header(bytes, name);
}

void check_image_size(std::int64_t width, std::int64_t height, std::int64_t bytes_per_pixel, std::uint64_t limit,
                      const std::string& name) {
  if (width < 1 || height < 1 || width > max_image_side || height > max_image_side) {
    throw input_error("{}: image of {} x {} pixels, expected 1 to {} on each side", name, width, height,
                      max_image_side);
  }
  const std::uint64_t total = std::uint64_t(width) * std::uint64_t(height) * std::uint64_t(bytes_per_pixel);
  if (total > limit) {
    throw input_error("{}: image of {} x {} pixels needs {} bytes, expected at most {}", name, width, height, total,
                      limit);
  }
}

}  // namespace tessera

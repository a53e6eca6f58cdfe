#include "io/image_file.hpp"

#include <cstring>
#include <exception>

#include "base/error.hpp"
#include "base/half.hpp"
#include "io/file_bytes.hpp"
#include "io/image_header.hpp"
#include "io/image_input.hpp"

namespace tessera {
namespace {

constexpr std::uint64_t texture_limit = std::uint64_t{1} << 30;  // decoded bytes
constexpr std::uint64_t image_limit = std::uint64_t{8} << 30;    // as floats: 16k x 8k environments fit

template <class T>
void widen(const std::vector<std::byte>& in, float divisor, AlignedVector<float>& out) {
  const T* values = reinterpret_cast<const T*>(in.data());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = float(values[i]) / divisor;
}

void widen_half(const std::vector<std::byte>& in, AlignedVector<float>& out) {
  const auto* values = reinterpret_cast<const std::uint16_t*>(in.data());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = half_to_float(values[i]);
}

void read_pixels(ImageReader& reader, int channels, const OIIO::TypeDesc& type, void* pixels, const std::string& name) {
  if (!reader.input->read_image(0, 0, 0, channels, type, pixels)) throw decode_error(name, *reader.input);
}

// The channels that make a picture: RGB(A), a single one, or all of up to four. OpenImageIO puts R, G, B, A first.
int picture_channels(const OIIO::ImageSpec& spec, const std::string& name) {
  const auto& names = spec.channelnames;
  if (names.size() >= 3 && names[0] == "R" && names[1] == "G" && names[2] == "B") {
    return names.size() >= 4 && names[3] == "A" ? 4 : 3;
  }
  if (names.size() > 4) {
    throw input_error("{}: {} channels without R, G and B, expected a picture of 1 to 4 channels", name, names.size());
  }
  return int(names.size());
}

// Runs a decoder: whatever it throws becomes one clear line.
template <class Body>
auto guarded(const std::string& name, const Body& body) {
  try {
    return body();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw input_error("{}: too large for this machine's memory", name);
  } catch (const std::exception& e) {
    throw input_error("{}: cannot be decoded: {}", name, e.what());
  }
}

SourceImage decode(std::span<const std::byte> bytes, const std::string& name, std::uint64_t limit) {
  ImageReader reader = open_image(bytes, name);
  const OIIO::ImageSpec& spec = reader.spec();
  SourceImage image;
  image.name = name;
  image.channels = picture_channels(spec, name);
  OIIO::TypeDesc type = spec.format;
  if (type == OIIO::TypeDesc::UINT8) {
    image.type = PixelType::u8;
  } else if (type == OIIO::TypeDesc::UINT16) {
    image.type = PixelType::u16;
  } else if (type == OIIO::TypeDesc::HALF) {
    image.type = PixelType::half;
  } else {
    image.type = PixelType::f32;
    type = OIIO::TypeDesc::FLOAT;
  }
  const std::size_t pixel_size = std::size_t(image.channels) * type.size();
  check_image_size(spec.width, spec.height, std::int64_t(pixel_size), limit, name);
  image.width = spec.width;
  image.height = spec.height;
  image.pixels.resize(std::size_t(spec.width) * std::size_t(spec.height) * pixel_size);
  read_pixels(reader, image.channels, type, image.pixels.data(), name);
  return image;
}

}  // namespace

Error decode_error(const std::string& name, OIIO::ImageInput& input) {
  std::string reason = input.geterror();
  for (char& c : reason)
    if (c == '\n' || c == '\r') c = ' ';
  while (reason.ends_with(' ')) reason.pop_back();
  return input_error("{}: cannot be decoded: {}", name, reason.empty() ? "the file is damaged" : reason);
}

ImageReader open_image(std::span<const std::byte> bytes, const std::string& name) {
  ImageReader reader;
  reader.format = image_format(bytes, name);
  check_image_header(bytes, reader.format, name);
  reader.bytes = std::make_unique<MemoryReader>(bytes);
  reader.input = OIIO::ImageInput::create(reader.format);
  if (!reader.input) throw input_error("{}: this OpenImageIO cannot read {} files", name, reader.format);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  reader.input->set_ioproxy(reader.bytes.get());
  OIIO::ImageSpec found;
  if (!reader.input->open(name, found, config)) throw decode_error(name, *reader.input);
  if (found.depth > 1) throw input_error("{}: is a volume, expected a picture", name);
  return reader;
}

Image read_image(const std::string& path, PixelType* type) {
  return guarded(path, [&] {
    const SourceImage source = decode(read_file(path), path, image_limit);
    if (type != nullptr) *type = source.type;
    check_image_size(source.width, source.height, source.channels * std::int64_t(sizeof(float)), image_limit, path);
    Image image(source.width, source.height, source.channels);
    switch (source.type) {
      case PixelType::u8:
        widen<std::uint8_t>(source.pixels, 255.0f, image.pixels);
        break;
      case PixelType::u16:
        widen<std::uint16_t>(source.pixels, 65535.0f, image.pixels);
        break;
      case PixelType::half:
        widen_half(source.pixels, image.pixels);
        break;
      case PixelType::f32:
        std::memcpy(image.pixels.data(), source.pixels.data(), source.pixels.size());
        break;
    }
    return image;
  });
}

SourceImage decode_image(std::span<const std::byte> bytes, const std::string& name) {
  return guarded(name, [&] { return decode(bytes, name, texture_limit); });
}

}  // namespace tessera

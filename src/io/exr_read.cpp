#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>

#include <cstring>
#include <exception>
#include <new>

#include "base/error.hpp"
#include "base/half.hpp"
#include "io/file_bytes.hpp"
#include "io/image_file.hpp"
#include "io/image_header.hpp"
#include "io/image_input.hpp"

namespace tessera {
namespace {

// Where a channel's values go.
struct Plane {
  OIIO::TypeDesc type;
  float* f32 = nullptr;
  std::uint32_t* u32 = nullptr;

  void set(std::size_t index, const void* value) const {
    if (u32 != nullptr) {
      std::memcpy(u32 + index, value, 4);
    } else if (type == OIIO::TypeDesc::HALF) {
      std::uint16_t h = 0;
      std::memcpy(&h, value, 2);
      f32[index] = half_to_float(h);
    } else {
      std::memcpy(f32 + index, value, 4);
    }
  }
};

std::vector<Plane> make_planes(const OIIO::ImageSpec& spec, std::size_t values, ExrLayers& layers) {
  std::vector<Plane> planes(std::size_t(spec.nchannels));
  for (int c = 0; c < spec.nchannels; ++c) {
    Plane& plane = planes[std::size_t(c)];
    plane.type = spec.channelformat(c);
    const std::string& name = spec.channelnames[std::size_t(c)];
    if (plane.type == OIIO::TypeDesc::UINT) {
      auto& values_of = layers.u32[name];
      values_of.resize(values);
      plane.u32 = values_of.data();
    } else {
      auto& values_of = layers.f32[name];
      values_of.resize(values);
      plane.f32 = values_of.data();
    }
  }
  return planes;
}

void read_flat(ImageReader& reader, const std::string& path, ExrLayers& layers) {
  const OIIO::ImageSpec& spec = reader.spec();
  const std::size_t pixels = std::size_t(spec.width) * std::size_t(spec.height);
  layers.counts.assign(pixels, 1);
  const std::vector<Plane> planes = make_planes(spec, pixels, layers);
  const std::size_t pixel_size = spec.pixel_bytes(true);
  const bool tiled = spec.tile_width != 0;  // tiles come all at once
  const int band_rows = tiled ? spec.height : 64;
  std::vector<std::byte> band(pixel_size * std::size_t(spec.width) * std::size_t(std::min(band_rows, spec.height)));
  for (int y = 0; y < spec.height; y += band_rows) {
    const int rows = std::min(band_rows, spec.height - y);
    const bool good = tiled ? reader.input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UNKNOWN, band.data())
                            : reader.input->read_scanlines(0, 0, spec.y + y, spec.y + y + rows, 0, 0, spec.nchannels,
                                                           OIIO::TypeDesc::UNKNOWN, band.data());
    if (!good) throw decode_error(path, *reader.input);
    const std::size_t first = std::size_t(y) * std::size_t(spec.width);
    const std::size_t count = std::size_t(rows) * std::size_t(spec.width);
    std::size_t offset = 0;
    for (const Plane& plane : planes) {
      for (std::size_t i = 0; i < count; ++i) plane.set(first + i, band.data() + i * pixel_size + offset);
      offset += plane.type.size();
    }
  }
}

void read_deep(ImageReader& reader, const std::string& path, ExrLayers& layers) {
  OIIO::DeepData data;
  if (!reader.input->read_native_deep_image(0, 0, data)) throw decode_error(path, *reader.input);
  std::size_t total = 0;
  layers.counts.resize(std::size_t(data.pixels()));
  for (std::size_t p = 0; p < layers.counts.size(); ++p) {
    layers.counts[p] = std::uint32_t(data.samples(std::int64_t(p)));
    total += layers.counts[p];
  }
  const std::vector<Plane> planes = make_planes(reader.spec(), total, layers);
  std::size_t next = 0;
  for (std::size_t p = 0; p < layers.counts.size(); ++p)
    for (std::uint32_t s = 0; s < layers.counts[p]; ++s, ++next)
      for (std::size_t c = 0; c < planes.size(); ++c) {
        planes[c].set(next, data.data_ptr(std::int64_t(p), int(c), int(s)));
      }
}

}  // namespace

ExrLayers read_exr_layers(const std::string& path) {
  try {
    const std::vector<std::byte> bytes = read_file(path);
    ExrLayers layers;
    layers.attributes = read_exr_header(bytes, path).strings;
    ImageReader reader = open_image(bytes, path);
    const OIIO::ImageSpec& spec = reader.spec();
    layers.width = spec.width;
    layers.height = spec.height;
    layers.deep = spec.deep;
    if (layers.deep) {
      read_deep(reader, path, layers);
    } else {
      read_flat(reader, path, layers);
    }
    return layers;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw input_error("{}: too large for this machine's memory", path);
  } catch (const std::exception& e) {
    throw input_error("{}: cannot be decoded: {}", path, e.what());
  }
}

}  // namespace tessera

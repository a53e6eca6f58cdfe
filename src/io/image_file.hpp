// Image files in and out, through OpenImageIO. Dimensions and sizes are checked before pixels are read or memory is
// asked for.
#pragma once
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/image.hpp"
#include "scene/texture.hpp"

namespace tessera {

/// Reads any image (PNG, JPEG, HDR, EXR ...) as floats, unchanged in encoding; type, if given, is set to what the file
/// holds. Throws Error(input).
Image read_image(const std::string& path, PixelType* type = nullptr);

/// Decodes an image held in memory (a glTF buffer view or data URI) in its own pixel type; name is for error messages.
SourceImage decode_image(std::span<const std::byte> bytes, const std::string& name);

/// Writes 8-bit RGBA (or RGB) PNG. path "-": standard output. The file appears whole or not at all. Throws
/// Error(output).
void write_png(const std::string& path, int width, int height, int channels, const unsigned char* pixels);

/// Writes three floats per pixel as Radiance RGBE (.hdr). As write_png.
void write_hdr(const std::string& path, int width, int height, const float* rgb);

/// One plane of an EXR: its channel name ("R", "normal.X", "id") and one value per pixel; exactly one pointer is set.
struct ExrChannel {
  std::string name;
  const float* f32 = nullptr;          // written as float
  const std::uint32_t* u32 = nullptr;  // written as uint
  std::size_t stride = 1;              // in elements, from pixel to pixel
};

/// Writes a flat EXR (float or uint channels, ZIP compression), with text attributes. path "-": standard output.
void write_exr(const std::string& path, int width, int height, const std::vector<ExrChannel>& channels,
               const std::map<std::string, std::string>& attributes = {});

/// A deep EXR: any number of values per pixel. channel planes hold total(counts) values, pixels in raster order.
void write_deep_exr(const std::string& path, int width, int height, const std::vector<std::uint32_t>& counts,
                    const std::vector<ExrChannel>& channels, const std::map<std::string, std::string>& attributes = {});

/// What read_exr_layers finds: named planes of a flat or deep EXR.
struct ExrLayers {
  int width = 0, height = 0;
  bool deep = false;
  std::vector<std::uint32_t> counts;  // values per pixel; all 1 when flat
  std::map<std::string, AlignedVector<float>> f32;
  std::map<std::string, std::vector<std::uint32_t>> u32;
  std::map<std::string, std::string> attributes;
};
ExrLayers read_exr_layers(const std::string& path);

}  // namespace tessera

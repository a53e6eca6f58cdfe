// Images as a file stores them, and how a material samples them.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "kernels/interface.hpp"

namespace tessera {

enum class PixelType { u8, u16, half, f32 };

/// A decoded image, in the file's own encoding (sRGB is not undone here), top row first.
struct SourceImage {
  std::string name;
  int width = 0, height = 0, channels = 0;  // 1, 2, 3 or 4 channels
  PixelType type = PixelType::u8;
  std::vector<std::byte> pixels;
};

/// glTF's sampler; its defaults.
struct Sampler {
  WrapMode wrap_u = WrapMode::repeat, wrap_v = WrapMode::repeat;
  FilterMode magnify = FilterMode::linear, minify = FilterMode::linear, mip = FilterMode::linear;
  bool mipmapped = true;
};

struct Texture {
  int image = -1;
  Sampler sampler;
};

/// A material's use of a texture. UV' = offset + rotate(rotation) * (scale * UV)   (KHR_texture_transform).
struct TextureSlot {
  int texture = -1;  // -1: none
  int uv_set = 0;    // 0 or 1
  float offset[2] = {0, 0}, scale[2] = {1, 1};
  float rotation = 0;  // radians, counter-clockwise
};

}  // namespace tessera

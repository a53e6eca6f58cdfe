// Textures in the formats and layouts of kernels/sampling.hpp.
#pragma once
#include <array>
#include <cstdint>
#include <functional>

#include "base/aligned.hpp"
#include "kernels/sampling.hpp"

namespace tessera {

using SamplingColor = std::array<float, 3>;

/// One texel in 16, 8, 4 or 4 bytes, the lowest word first. Rounded to nearest, clamped to what the format holds;
/// negative and NaN: 0.
std::array<std::uint32_t, 4> encode_sampling_texel(SamplingFormat format, const SamplingColor& color);
std::size_t sampling_texel_bytes(SamplingFormat format);

struct SamplingTexture {
  AlignedVector<std::uint32_t> words;
  SamplingView view;
  std::size_t bytes;
};

/// texel(level, face, x, y) gives its colour; face is 0 for a 2D texture. size a power of two from
/// smallest_sampling_level to the largest size; levels at most those down to smallest_sampling_level.
SamplingTexture build_sampling_texture(SamplingFormat format, SamplingLayout layout, bool cube, int size, int levels,
                                       const std::function<SamplingColor(int level, int face, int x, int y)>& texel);

}  // namespace tessera

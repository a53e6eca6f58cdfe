// Texture and cubemap sampling by texel format, layout in memory and filter: array kernels for the chart, one list per
// instruction set. (The renderer's own sampling is kernels/texture/sample.hpp and kernels/light/environment.hpp.)
#pragma once
#include <cstddef>
#include <cstdint>

namespace tessera {

enum class SamplingFormat : std::uint32_t {
  rgba32_float,  // 16 bytes
  rgba16_float,  // 8
  rgb9_e5,       // 4: nine bits each, from the low end red green blue; five bits of exponent, shared (OpenGL 4.6, 8.25)
  r11_g11_b10,   // 4: floats without sign, five bits of exponent each; red in the low bits
};
enum class SamplingLayout : std::uint32_t {
  linear,   // rows
  tiled_4,  // 4 x 4 texels one after another, tiles in rows
  tiled_8,
  morton,  // x and y bit by bit: x in the even bits
};
enum class SamplingFilter : std::uint32_t { nearest, bilinear, trilinear };

inline constexpr int smallest_sampling_level = 8;  // mips end here: no level is smaller than a tile
inline constexpr int max_sampling_size = 8192, max_sampling_cube_size = 2048;

/// size x size texels, size a power of two, levels one after another from the finest; in a level of a cube, face by
/// face (+X -X +Y -Y +Z -Z, as interface.hpp has them). 64-byte aligned, 16 bytes of slack behind the last texel.
struct SamplingView {
  const void* texels;
  int size, levels;
};

constexpr std::size_t sampling_texels(int size, int levels, bool cube) {
  std::size_t count = 0;
  for (int k = 0; k < levels; ++k) count += std::size_t(size >> k) * std::size_t(size >> k);
  return cube ? 6 * count : count;
}

struct SamplingArgs {
  SamplingView texture;
  // A 2D texture: u, v (repeated), level of detail. A cube: a direction (of any length but 0) and level of detail,
  // clamped to its face. The level is clamped to those that there are, and read by trilinear filtering only.
  const float* in[4];
  float* out[3];
  std::size_t count;
};

struct SamplingKernel {
  SamplingFormat format;
  SamplingLayout layout;
  SamplingFilter filter;
  bool cube;
  /// Any bits of coordinates give a texel of the texture. Infinities and NaNs in it become large numbers.
  void (*run)(const SamplingArgs&);
};

struct SamplingKernels {
  const char* isa;
  const SamplingKernel* first;
  int count;
};

/// As kernel_tables: narrowest first, null-terminated.
extern const SamplingKernels* const sampling_tables[];

}  // namespace tessera

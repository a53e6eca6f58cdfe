#include "precompute/sampling_texture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tessera {
namespace {

double sane(float x) { return x > 0 ? double(x) : 0; }

// A float without sign: five bits of exponent (bias 15), `bits` of mantissa; without infinities. The same for halves.
std::uint32_t small_float(double x, int bits) {
  const double largest = std::ldexp(2 - std::ldexp(1, -bits), 15);
  x = std::min(x, largest);
  const int exponent = x > 0 ? std::max(std::ilogb(x), -14) : -14;
  // In units of the last place; a mantissa that rounds up to the next power carries into the exponent by itself.
  const auto units = std::uint32_t(std::nearbyint(std::ldexp(x, bits - exponent)));
  return units + (std::uint32_t(exponent + 14) << bits);
}

// EXT_texture_shared_exponent, "Encoding" (OpenGL 4.6, 8.5.2).
std::uint32_t shared_exponent(const SamplingColor& color) {
  const double largest_value = 511.0 / 512 * std::ldexp(1, 16);
  double c[3];
  for (std::size_t k = 0; k < 3; ++k) c[k] = std::min(sane(color[k]), largest_value);
  const double largest = std::max({c[0], c[1], c[2]});
  int exponent = std::max(-16, largest > 0 ? std::ilogb(largest) : -16) + 1 + 15;
  if (std::floor(std::ldexp(largest, 24 - exponent) + 0.5) == 512) ++exponent;
  std::uint32_t word = std::uint32_t(exponent) << 27;
  for (int k = 0; k < 3; ++k) word |= std::uint32_t(std::floor(std::ldexp(c[k], 24 - exponent) + 0.5)) << (9 * k);
  return word;
}

std::uint32_t interleave(std::uint32_t x, std::uint32_t y) {
  std::uint32_t z = 0;
  for (unsigned bit = 0; bit < 16; ++bit) z |= (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1);
  return z;
}

std::size_t place(SamplingLayout layout, int x, int y, int n) {
  const auto tiled = [&](int t) {
    const auto tile = std::size_t(y / t) * std::size_t(n / t) + std::size_t(x / t), side = std::size_t(t);
    return (tile * side + std::size_t(y % t)) * side + std::size_t(x % t);
  };
  switch (layout) {
    case SamplingLayout::tiled_4:
      return tiled(4);
    case SamplingLayout::tiled_8:
      return tiled(8);
    case SamplingLayout::morton:
      return interleave(std::uint32_t(x), std::uint32_t(y));
    default:
      return std::size_t(y) * std::size_t(n) + std::size_t(x);
  }
}

}  // namespace

std::size_t sampling_texel_bytes(SamplingFormat format) {
  return format == SamplingFormat::rgba32_float ? 16 : format == SamplingFormat::rgba16_float ? 8 : 4;
}

std::array<std::uint32_t, 4> encode_sampling_texel(SamplingFormat format, const SamplingColor& c) {
  switch (format) {
    case SamplingFormat::rgba32_float:
      return {std::bit_cast<std::uint32_t>(float(sane(c[0]))), std::bit_cast<std::uint32_t>(float(sane(c[1]))),
              std::bit_cast<std::uint32_t>(float(sane(c[2]))), std::bit_cast<std::uint32_t>(1.0f)};
    case SamplingFormat::rgba16_float:
      return {small_float(sane(c[0]), 10) | small_float(sane(c[1]), 10) << 16,
              small_float(sane(c[2]), 10) | 0x3c000000u};
    case SamplingFormat::rgb9_e5:
      return {shared_exponent(c)};
    default:
      return {small_float(sane(c[0]), 6) | small_float(sane(c[1]), 6) << 11 | small_float(sane(c[2]), 5) << 22};
  }
}

SamplingTexture build_sampling_texture(SamplingFormat format, SamplingLayout layout, bool cube, int size, int levels,
                                       const std::function<SamplingColor(int, int, int, int)>& texel) {
  SamplingTexture texture;
  const std::size_t words = sampling_texel_bytes(format) / 4, count = sampling_texels(size, levels, cube);
  texture.bytes = 4 * words * count;
  texture.words.resize(words * count + 4);
  std::size_t first = 0;
  for (int level = 0; level < levels; ++level) {
    const int n = size >> level;
    for (int face = 0; face < (cube ? 6 : 1); ++face, first += std::size_t(n) * std::size_t(n))
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          const auto encoded = encode_sampling_texel(format, texel(level, face, x, y));
          std::copy_n(encoded.begin(), words, texture.words.data() + (first + place(layout, x, y, n)) * words);
        }
  }
  texture.view = {texture.words.data(), size, levels};
  return texture;
}

}  // namespace tessera

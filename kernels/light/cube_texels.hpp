// Texels of a cubemap as a bilinear footprint reads them: a texel and its neighbour to the right, by storage format.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// How texels are stored: CubeFormat at compile time.
struct HalfTexels {};
struct Rgb9e5Texels {};

/// What a decoded texel is divided by. It goes into the weights that texels are multiplied by anyway.
template <class Texels, class F>
inline constexpr float texel_scale = 1;

/// Three channels of a texel and of its neighbour to the right.
template <class F>
struct TexelPair {
  Vec3<F> left, right;
};

// ------------------------------------------------------------------------------------------------------------ halves

/// Halves become floats by a shift, which leaves them 2^-112 times too small (exactly, subnormals included): the factor
/// goes into the weights that they are multiplied by anyway. Infinities and NaNs become numbers.
template <>
inline constexpr float texel_scale<HalfTexels, Float> = 0x1p112f;
template <>
inline constexpr float texel_scale<HalfTexels, Pair<Float>> = 0x1p112f;
TESSERA_INLINE Float scaled_low_half(Int x) { return from_bits(low_half_shifted<13>(x)); }
TESSERA_INLINE Float scaled_high_half(Int x) { return from_bits(high_half_shifted<13>(x)); }

/// Two neighbours as they lie in memory, eight halves: the texels divided by texel_scale.
TESSERA_INLINE TexelPair<Float> decode_texels(const Float (&words)[4]) {
  const Int rg0 = bits(words[0]), b0 = bits(words[1]), rg1 = bits(words[2]), b1 = bits(words[3]);
  return {{scaled_low_half(rg0), scaled_high_half(rg0), scaled_low_half(b0)},
          {scaled_low_half(rg1), scaled_high_half(rg1), scaled_low_half(b1)}};
}

/// The texels index and index + 1 (counted from level 0), divided by texel_scale.
template <class F>
TESSERA_INLINE TexelPair<F> cube_texels(HalfTexels, const CubeView& cube, IntOf<F> index) {
  Float words[4];
  gather_quads(reinterpret_cast<const float*>(cube.texels), index << 1, words);
  return decode_texels(words);
}
// One lane at a time: the same texels for tests and set-up.
template <class F>
inline Vec3<F> cube_texel_scalar(const CubeView& cube, std::int64_t index) {
  const std::uint16_t* texel = cube.texels + 4 * index;
  return {F(half_to_float(std::int32_t(texel[0]))), F(half_to_float(std::int32_t(texel[1]))),
          F(half_to_float(std::int32_t(texel[2])))};
}
template <>
inline TexelPair<float> cube_texels<float>(HalfTexels, const CubeView& cube, std::int32_t index) {
  return {cube_texel_scalar<float>(cube, index), cube_texel_scalar<float>(cube, std::int64_t{index} + 1)};
}
template <>
inline TexelPair<double> cube_texels<double>(HalfTexels, const CubeView& cube, std::int64_t index) {
  return {cube_texel_scalar<double>(cube, index), cube_texel_scalar<double>(cube, index + 1)};
}

// ------------------------------------------------------------------------------------------------------------ rgb9e5

/// A channel is its nine bits times 2^(e - 24), exactly: OpenGL 4.6, section 8.5.2 (EXT_texture_shared_exponent). Any
/// bits are finite and not negative.
template <class F, class I>
TESSERA_INLINE Vec3<F> decode_rgb9e5(I word) {
  const I mantissa(511);
  const F scale = F(from_bits((shift_right_logical(word, 27) + I(127 - 24)) << 23));
  return {F(to_float(word & mantissa)) * scale, F(to_float((word >> 9) & mantissa)) * scale,
          F(to_float((word >> 18) & mantissa)) * scale};
}

/// The texels index and index + 1, as they are.
template <class F>
TESSERA_INLINE TexelPair<F> cube_texels(Rgb9e5Texels, const CubeView& cube, IntOf<F> index) {
  const IntPair words = gather_pairs(cube.texels, index << 2);
  return {decode_rgb9e5<Float>(words.low), decode_rgb9e5<Float>(words.high)};
}
template <class F>
inline TexelPair<F> rgb9e5_scalar(const CubeView& cube, std::int64_t index) {
  const std::uint16_t* halves = cube.texels + 2 * index;
  const auto word = [&](int k) { return static_cast<std::int32_t>(halves[k] | std::uint32_t{halves[k + 1]} << 16); };
  return {decode_rgb9e5<F>(word(0)), decode_rgb9e5<F>(word(2))};
}
template <>
inline TexelPair<float> cube_texels<float>(Rgb9e5Texels, const CubeView& cube, std::int32_t index) {
  return rgb9e5_scalar<float>(cube, index);
}
template <>
inline TexelPair<double> cube_texels<double>(Rgb9e5Texels, const CubeView& cube, std::int64_t index) {
  return rgb9e5_scalar<double>(cube, index);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

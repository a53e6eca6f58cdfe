// Reading and filtering the texels of a footprint.
//
// Texel bits of any value give finite, non-negative results. UVs may be anything (address.hpp). A TextureView must
// describe memory that exists, hold at most max_texture_texels texels with its mips, and have max_texture_levels at
// most: TextureSet (src/precompute) sees to it.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/simd.hpp"
#include "kernels/texture/footprint.hpp"

namespace tessera::TESSERA_ISA {
namespace {

enum Channels : unsigned { channel_r = 1, channel_g = 2, channel_b = 4, channel_a = 8 };

/// A half in bits 13 to 27 -> float; the sign and all else must be 0. Exact for every half in [0, 65504], finite for
/// the others' bits. Denormal floats never occur on the way: an instruction that meets one takes 100 times as long.
///
/// Derivation. Adding 112 (= 127 - 15) to the exponent is all that a normal half needs. With exponent 0 and mantissa m,
/// it makes x = 2^-15 (1 + m / 1024) where 2^-14 m / 1024 = 2 x - 2^-14 is meant. That is below x exactly when
/// x < 2^-14, that is for exponent 0: the smaller of both is right for either kind.
inline Float expand_half(Int half) {
  const Float x = from_bits(half + Int(112 << 23));
  return min(x, (x + x) - Float(0x1p-14));
}

/// What a format's texels are filtered in units of.
inline constexpr float texel_unit(TexelFormat format) {
  return format == TexelFormat::rgba8_unorm     ? 1.0f / 255
         : format == TexelFormat::rgba8_squares ? 1.0f / (255 * 255)
                                                : 1.0f;
}

/// The wanted channels of one texel per lane: unorm as 0..255, their squares as 0..255^2, half floats as they are.
template <TexelFormat format, unsigned channels>
inline void fetch_texel(const void* texels, Int index, Float (&out)[4]) {
  if constexpr (format == TexelFormat::rgba8_unorm) {
    const Int rgba = gather_bytes(texels, index << 2);
    if constexpr (channels & channel_r) out[0] = to_float(rgba & Int(255));
    if constexpr (channels & channel_g) out[1] = to_float((rgba >> 8) & Int(255));
    if constexpr (channels & channel_b) out[2] = to_float((rgba >> 16) & Int(255));
    if constexpr (channels & channel_a) out[3] = to_float(shift_right_logical(rgba, 24));
  } else if constexpr (format == TexelFormat::rgba8_squares) {
    const Int rgba = gather_bytes(texels, index << 2);
    const auto square = [](Int x) {
      const Float value = to_float(x & Int(255));
      return value * value;
    };
    if constexpr (channels & channel_r) out[0] = square(rgba);
    if constexpr (channels & channel_g) out[1] = square(rgba >> 8);
    if constexpr (channels & channel_b) out[2] = square(rgba >> 16);
    if constexpr (channels & channel_a) out[3] = to_float(shift_right_logical(rgba, 24)) * Float(255);
  } else {
    const IntPair rgba = gather_pairs(texels, index << 3);
    const Int field(0x0fffe000);
    if constexpr (channels & channel_r) out[0] = expand_half((rgba.low << 13) & field);
    if constexpr (channels & channel_g) out[1] = expand_half((rgba.low >> 3) & field);
    if constexpr (channels & channel_b) out[2] = expand_half((rgba.high << 13) & field);
    if constexpr (channels & channel_a) out[3] = expand_half((rgba.high >> 3) & field);
  }
}

template <unsigned channels>
inline void lerp_channels(const Float (&a)[4], const Float (&b)[4], Float t, Float (&out)[4]) {
  for (int c = 0; c < 4; ++c)
    if (channels >> c & 1) out[c] = mul_add(t, b[c] - a[c], a[c]);
}

template <TexelFormat format, unsigned channels>
inline void sample_level(const void* texels, const LevelTaps& taps, bool one_tap, Float (&out)[4]) {
  if (one_tap) {
    fetch_texel<format, channels>(texels, taps.texel[0], out);
    return;
  }
  Float left[4], right[4], top[4], bottom[4];
  fetch_texel<format, channels>(texels, taps.texel[0], left);
  fetch_texel<format, channels>(texels, taps.texel[1], right);
  lerp_channels<channels>(left, right, taps.right, top);
  fetch_texel<format, channels>(texels, taps.texel[2], left);
  fetch_texel<format, channels>(texels, taps.texel[3], right);
  lerp_channels<channels>(left, right, taps.right, bottom);
  lerp_channels<channels>(top, bottom, taps.lower, out);
}

template <TexelFormat format, unsigned channels>
inline void sample_format(const void* texels, const Footprint& f, Float (&out)[4]) {
  sample_level<format, channels>(texels, f.fine, f.one_tap, out);
  if (f.two_levels) {
    Float fine[4], coarse[4];
    for (int c = 0; c < 4; ++c)
      if (channels >> c & 1) fine[c] = out[c];
    sample_level<format, channels>(texels, f.coarse, f.one_tap, coarse);
    lerp_channels<channels>(fine, coarse, f.blend, out);
  }
  if constexpr (format != TexelFormat::rgba16_float) {
    constexpr float unit = texel_unit(format), largest = format == TexelFormat::rgba8_unorm ? 255 : 255 * 255;
    static_assert(largest * unit == 1.0f);
    for (int c = 0; c < 4; ++c)
      if (channels >> c & 1) out[c] = out[c] * Float(unit);
  }
}

/// Filters the wanted channels into out[0..3] = R, G, B, A; the others are left alone. The footprint must be of a
/// texture that is sampled_alike.
template <unsigned channels>
[[gnu::noinline]] void sample(const TextureView& texture, const Footprint& f, Float (&out)[4]) {
  if (texture.format == TexelFormat::rgba8_unorm)
    sample_format<TexelFormat::rgba8_unorm, channels>(texture.texels, f, out);
  else if (texture.format == TexelFormat::rgba8_squares)
    sample_format<TexelFormat::rgba8_squares, channels>(texture.texels, f, out);
  else
    sample_format<TexelFormat::rgba16_float, channels>(texture.texels, f, out);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

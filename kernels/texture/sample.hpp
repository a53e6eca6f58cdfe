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

/// The wanted channels of one texel per lane: unorm as 0..255, their squares as 0..255^2, half floats as they are. low
/// and high: its words; of formats of four bytes, the first one.
template <TexelFormat format, unsigned channels>
TESSERA_INLINE void decode_texel(Int low, Int high, Float (&out)[4]) {
  if constexpr (format == TexelFormat::rgba8_unorm) {
    if constexpr (channels & channel_r) out[0] = to_float(low & Int(255));
    if constexpr (channels & channel_g) out[1] = to_float((low >> 8) & Int(255));
    if constexpr (channels & channel_b) out[2] = to_float((low >> 16) & Int(255));
    if constexpr (channels & channel_a) out[3] = to_float(shift_right_logical(low, 24));
  } else if constexpr (format == TexelFormat::rgba8_squares) {
    const auto square = [](Int x) {
      const Float value = to_float(x & Int(255));
      return value * value;
    };
    if constexpr (channels & channel_r) out[0] = square(low);
    if constexpr (channels & channel_g) out[1] = square(low >> 8);
    if constexpr (channels & channel_b) out[2] = square(low >> 16);
    if constexpr (channels & channel_a) out[3] = to_float(shift_right_logical(low, 24)) * Float(255);
  } else {
    const Int field(0x0fffe000);
    if constexpr (channels & channel_r) out[0] = expand_half((low << 13) & field);
    if constexpr (channels & channel_g) out[1] = expand_half((low >> 3) & field);
    if constexpr (channels & channel_b) out[2] = expand_half((high << 13) & field);
    if constexpr (channels & channel_a) out[3] = expand_half((high >> 3) & field);
  }
}

template <TexelFormat format, unsigned channels>
TESSERA_INLINE void fetch_texel(const void* texels, Int index, Float (&out)[4]) {
  if constexpr (format == TexelFormat::rgba16_float) {
    const IntPair rgba = gather_pairs(texels, index << 3);
    decode_texel<format, channels>(rgba.low, rgba.high, out);
  } else {
    const Int rgba = gather_bytes(texels, index << 2);
    decode_texel<format, channels>(rgba, rgba, out);
  }
}

/// A texel and the one after it.
template <TexelFormat format, unsigned channels>
TESSERA_INLINE void fetch_texels(const void* texels, Int index, Float (&left)[4], Float (&right)[4]) {
  if constexpr (format == TexelFormat::rgba16_float) {
    Float words[4];
    gather_quads(static_cast<const float*>(texels), index << 1, words);
    decode_texel<format, channels>(bits(words[0]), bits(words[1]), left);
    decode_texel<format, channels>(bits(words[2]), bits(words[3]), right);
  } else {
    const IntPair words = gather_pairs(texels, index << 2);
    decode_texel<format, channels>(words.low, words.low, left);
    decode_texel<format, channels>(words.high, words.high, right);
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
  const auto row = [&](Int left_texel, Int right_texel, Float(&blended)[4]) {
    Float left[4], right[4];
    if (taps.side_by_side) {
      fetch_texels<format, channels>(texels, left_texel, left, right);
    } else {
      fetch_texel<format, channels>(texels, left_texel, left);
      fetch_texel<format, channels>(texels, right_texel, right);
    }
    lerp_channels<channels>(left, right, taps.right, blended);
  };
  Float top[4], bottom[4];
  row(taps.texel[0], taps.texel[1], top);
  row(taps.texel[2], taps.texel[3], bottom);
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

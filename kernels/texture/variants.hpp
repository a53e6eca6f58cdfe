// Texels by format and by layout, for sampling.hpp.
#pragma once
#include "kernels/sampling.hpp"
#include "kernels/simd.hpp"
#include "kernels/texture/sample.hpp"

namespace tessera::TESSERA_ISA {
namespace {

struct Rgb {
  Float channel[3];
};

/// The texel with this index, as three floats. At most 2^31 bytes.
template <SamplingFormat format>
TESSERA_INLINE Rgb decode_texel(const void* texels, Int index) {
  if constexpr (format == SamplingFormat::rgba32_float) {
    const Int offset = index << 4;
    const IntPair rg = gather_pairs(texels, offset);
    const Int b = gather_bytes(texels, offset + Int(8));
    return {{from_bits(rg.low), from_bits(rg.high), from_bits(b)}};
  } else if constexpr (format == SamplingFormat::rgba16_float) {
    const IntPair rgba = gather_pairs(texels, index << 3);
    const Int field(0x0fffe000);
    return {{expand_half((rgba.low << 13) & field), expand_half((rgba.low >> 3) & field),
             expand_half((rgba.high << 13) & field)}};
  } else if constexpr (format == SamplingFormat::rgb9_e5) {
    const Int word = gather_bytes(texels, index << 2);
    const Int mantissa(511);
    // 2^(e - 15 - 9)
    const Float scale = from_bits((shift_right_logical(word, 27) + Int(127 - 24)) << 23);
    return {{to_float(word & mantissa) * scale, to_float((word >> 9) & mantissa) * scale,
             to_float((word >> 18) & mantissa) * scale}};
  } else {
    // Exponents of five bits, as a half's: brought to where expand_half wants them.
    const Int word = gather_bytes(texels, index << 2);
    const Int eleven(0x0ffe0000), ten(0x0ffc0000);
    return {{expand_half((word << 17) & eleven), expand_half((word << 6) & eleven), expand_half((word >> 4) & ten)}};
  }
}

// Bits of x, below 2^13, spread to the even places.
TESSERA_INLINE Int spread_bits(Int x) {
  x = (x | (x << 8)) & Int(0x00ff00ff);
  x = (x | (x << 4)) & Int(0x0f0f0f0f);
  x = (x | (x << 2)) & Int(0x33333333);
  return (x | (x << 1)) & Int(0x55555555);
}

/// Where texel (x, y) of a square of n x n, n >= 8 a power of two, lies: part of x + part of y, so that a footprint of
/// four computes two of each.
template <SamplingLayout layout>
TESSERA_INLINE Int place_x(Int x) {
  if constexpr (layout == SamplingLayout::linear) {
    return x;
  } else if constexpr (layout == SamplingLayout::tiled_4) {
    return ((x >> 2) << 4) + (x & Int(3));
  } else if constexpr (layout == SamplingLayout::tiled_8) {
    return ((x >> 3) << 6) + (x & Int(7));
  } else {
    return spread_bits(x);
  }
}
template <SamplingLayout layout>
TESSERA_INLINE Int place_y(Int y, Int n) {
  if constexpr (layout == SamplingLayout::linear) {
    return y * n;
  } else if constexpr (layout == SamplingLayout::tiled_4) {
    return (y & Int(~3)) * n + ((y & Int(3)) << 2);
  } else if constexpr (layout == SamplingLayout::tiled_8) {
    return (y & Int(~7)) * n + ((y & Int(7)) << 3);
  } else {
    return spread_bits(y) << 1;
  }
}

enum class SamplingEdge { repeat, clamp };

template <SamplingEdge edge>
TESSERA_INLINE Int wrap_texel(Int x, Int n) {
  if constexpr (edge == SamplingEdge::repeat) {
    return x & (n - Int(1));
  } else {
    return clamp(x, Int(0), n - Int(1));
  }
}

/// s and t in [0,1] over a square of n x n whose first texel has the index `start`.
template <SamplingFormat format, SamplingLayout layout>
TESSERA_INLINE Rgb nearest_sample(const void* texels, Float s, Float t, Float n, Int ni, Int start) {
  const Int x = min(truncate_to_int(s * n), ni - Int(1)), y = min(truncate_to_int(t * n), ni - Int(1));
  return decode_texel<format>(texels, start + place_x<layout>(x) + place_y<layout>(y, ni));
}

template <SamplingFormat format, SamplingLayout layout, SamplingEdge edge>
TESSERA_INLINE Rgb bilinear_sample(const void* texels, Float s, Float t, Float n, Int ni, Int start) {
  const Float x = mul_sub(s, n, Float(0.5)), y = mul_sub(t, n, Float(0.5));
  const Float left = floor(x), top = floor(y);
  const Float wx = x - left, wy = y - top;
  const Int i = truncate_to_int(left), j = truncate_to_int(top);
  const Int x0 = place_x<layout>(wrap_texel<edge>(i, ni)), x1 = place_x<layout>(wrap_texel<edge>(i + Int(1), ni));
  const Int y0 = start + place_y<layout>(wrap_texel<edge>(j, ni), ni);
  const Int y1 = start + place_y<layout>(wrap_texel<edge>(j + Int(1), ni), ni);
  const Rgb a = decode_texel<format>(texels, y0 + x0), b = decode_texel<format>(texels, y0 + x1);
  const Rgb c = decode_texel<format>(texels, y1 + x0), d = decode_texel<format>(texels, y1 + x1);
  Rgb out;
  for (int k = 0; k < 3; ++k) {
    const Float upper = mul_add(wx, b.channel[k] - a.channel[k], a.channel[k]);
    const Float lower = mul_add(wx, d.channel[k] - c.channel[k], c.channel[k]);
    out.channel[k] = mul_add(wy, lower - upper, upper);
  }
  return out;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

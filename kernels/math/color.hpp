// Transfer functions and luminance of sRGB / Rec.709.
#pragma once
#include "kernels/math/approx.hpp"
#include "kernels/math/vector.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// Encoded value -> linear, both 1 for white. The straight piece goes on below 0, the power above 1; NaN stays NaN.
template <class F>
inline F srgb_to_linear(F encoded) {
  // IEC 61966-2-1:1999, clause 5.2.
  const MaskOf<F> straight = encoded <= F(0.04045);
  const F base = mul_add(encoded, F(1 / 1.055), F(0.055 / 1.055));
  // base^2.4 as base^2 base^0.4: rounding 2.4 itself to float would cost 3 ulp. 1e15^2.4 is finite.
  const F limited = clamp(base, F(0.05), F(1e15));
  const F power = (limited * limited) * pow_positive(limited, F(0.4));
  return select(is_nan(encoded), encoded, select(straight, encoded * F(1 / 12.92), power));
}

// Linear -> encoded, the inverse. NaN stays NaN.
template <class F>
inline F linear_to_srgb(F linear) {
  // IEC 61966-2-1:1999, clause 5.2.
  const MaskOf<F> straight = linear <= F(0.0031308);
  const F power = pow_positive(clamp(linear, F(0.001), F(3e38)), F(1.0 / 2.4));
  return select(is_nan(linear), linear, select(straight, linear * F(12.92), mul_sub(power, F(1.055), F(0.055))));
}

// Relative luminance of linear Rec.709, in the colour's own unit.
template <class F>
TESSERA_INLINE F luminance(Vec3<F> rgb) {
  // ITU-R BT.709-6, item 3.2.
  return dot(rgb, Vec3<F>{F(0.2126), F(0.7152), F(0.0722)});
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

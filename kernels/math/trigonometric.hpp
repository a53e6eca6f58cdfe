// sin, cos, sincos, tan, asin, acos, atan2. See kernels/math/approx.hpp.
#pragma once
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// pi / 2 as the sum of three floats.
template <class F>
struct HalfPi {
  F high = F(0x1.921fb6p+0), middle = F(-0x1.777a5cp-25), low = F(-0x1.ee59dap-50);
};

// Sine and cosine of |x| less quadrant * pi / 2, each the sum of two floats.
template <class F>
struct ReducedSinCos {
  F sine, sine_low, cosine, cosine_low;
  IntOf<F> quadrant;
};

template <class F>
TESSERA_INLINE ReducedSinCos<F> sincos_reduced(F x) {
  using I = IntOf<F>;
  const HalfPi<F> half_pi;
  const F a = abs(x);
  const F c = min(F(0x1p17), a);
  const I quadrant = round_to_int(c * F(0x1.45f306p-1));
  const F n = to_float(quadrant);
  // r + r_low = c - n pi / 2. Cody and Waite 1980: the first step is exact; the second keeps its error, because near
  // a multiple of pi / 2 little is left of the difference.
  const F first = neg_mul_add(n, half_pi.high, c);
  const F step = n * half_pi.middle;
  const F step_error = mul_sub(n, half_pi.middle, step);
  const F r = first - step;
  const F step_part = r - first;
  const F difference_error = (first - (r - step_part)) - (step + step_part);
  const F r_low = neg_mul_add(n, half_pi.low, difference_error - step_error);

  // For |r| <= pi / 4; relative errors 4.0e-9 and 1.9e-10.
  const F z = r * r;
  F s = mul_add(F(-0x1.9952fap-13), z, F(0x1.110776p-7));
  s = mul_add(s, z, F(-0x1.555546p-3));
  const F sine_tail = mul_add(r * z, s, r_low);
  F k = mul_add(F(0x1.9a6766p-16), z, F(-0x1.6c0e2ep-10));
  k = mul_add(k, z, F(0x1.55554ep-5));
  const F half_square = F(0.5) * z;
  const F leading = F(1) - half_square;
  const F leading_error = (F(1) - leading) - half_square;
  const F cosine_tail = leading_error + neg_mul_add(r, r_low, (z * z) * k);
  const F sine = r + sine_tail, cosine = leading + cosine_tail;
  return {sine, sine_tail - (sine - r), cosine, cosine_tail - (cosine - leading), quadrant};
}

template <class F>
struct SinCos {
  F sin, cos;
};

// Both at most 1 ulp for |x| <= 2^17. Beyond, where neighbouring floats are more than 0.01 apart, the value at
// +-2^17. NaN for infinities.
template <class F>
inline SinCos<F> sincos(F x) {
  using I = IntOf<F>;
  const ReducedSinCos<F> t = sincos_reduced(x);
  const MaskOf<F> odd = (t.quadrant & I(1)) != I(0), finite = abs(x) < F(__builtin_inff());
  const I sine_sign = ((t.quadrant & I(2)) << 30) ^ (bits(x) & bits(F(-0.0)));
  const I cosine_sign = ((t.quadrant + I(1)) & I(2)) << 30;
  const F nan = F(__builtin_nanf(""));
  return {select(finite, from_bits(bits(select(odd, t.cosine, t.sine)) ^ sine_sign), nan),
          select(finite, from_bits(bits(select(odd, t.sine, t.cosine)) ^ cosine_sign), nan)};
}
template <class F>
inline F sin(F x) {
  return sincos(x).sin;
}
template <class F>
inline F cos(F x) {
  return sincos(x).cos;
}
// At most 1.5 ulp for |x| <= 2^17; otherwise as sincos.
template <class F>
inline F tan(F x) {
  using I = IntOf<F>;
  const ReducedSinCos<F> t = sincos_reduced(x);
  const MaskOf<F> odd = (t.quadrant & I(1)) != I(0);
  const F over = select(odd, -t.cosine, t.sine), over_low = select(odd, -t.cosine_low, t.sine_low);
  const F under = select(odd, t.sine, t.cosine), under_low = select(odd, t.sine_low, t.cosine_low);
  const F quotient = over / under;
  const F remainder = neg_mul_add(quotient, under_low, neg_mul_add(quotient, under, over) + over_low);
  const F tangent = quotient + remainder / under;
  const F with_sign = from_bits(bits(tangent) ^ (bits(x) & bits(F(-0.0))));
  return select(abs(x) < F(__builtin_inff()), with_sign, F(__builtin_nanf("")));
}

// (asin(s) - s) for 0 <= s <= 1/2, z = s^2. Relative error of asin(s): 5.4e-9.
template <class F>
TESSERA_INLINE F asin_tail(F s, F z) {
  F q = mul_add(F(0x1.55ec3ap-5), z, F(0x1.90d362p-6));
  q = mul_add(q, z, F(0x1.73f174p-5));
  q = mul_add(q, z, F(0x1.3308b8p-4));
  q = mul_add(q, z, F(0x1.5555acp-3));
  return (s * z) * q;
}

// At most 2 ulp; NaN outside [-1, 1].
template <class F>
inline F asin(F x) {
  const HalfPi<F> half_pi;
  const F a = abs(x);
  // asin(a) = pi / 2 - 2 asin(sqrt((1 - a) / 2)).
  const MaskOf<F> large = a > F(0.5);
  const F z = select(large, (F(1) - a) * F(0.5), a * a);
  const F s = select(large, sqrt(z), a);
  const F tail = asin_tail(s, z);
  const F from_half_pi = (half_pi.high - F(2) * s) - (F(2) * tail - half_pi.middle);
  return copy_sign(select(large, from_half_pi, s + tail), x);
}

// At most 2 ulp; NaN outside [-1, 1].
template <class F>
inline F acos(F x) {
  const HalfPi<F> half_pi;
  const F a = abs(x);
  const MaskOf<F> large = a > F(0.5), negative = x < F(0);
  const F z = select(large, (F(1) - a) * F(0.5), a * a);
  const F s = select(large, sqrt(z), x);
  const F tail = asin_tail(s, z);
  const F middle = half_pi.high - (s + (tail - half_pi.middle));
  const F near_one = F(2) * (s + tail);
  const F near_minus_one = (F(2) * half_pi.high - F(2) * s) - (F(2) * tail - F(2) * half_pi.middle);
  return select(large, select(negative, near_minus_one, near_one), middle);
}

// The angle of (x, y) in [-pi, pi]. At most 2 ulp.
template <class F>
inline F atan2(F y, F x) {
  using I = IntOf<F>;
  const HalfPi<F> half_pi;
  const F ay = abs(y), ax = abs(x);
  const MaskOf<F> steep = ay > ax, left = bits(x) < I(0);
  const F small = min(ay, ax), large = max(ay, ax);
  F t = small / large;
  t = select(small == large, select(large == F(0), F(0), F(1)), t);  // 0 / 0 and infinity / infinity too
  // atan(t) - t for 0 <= t <= 1. Relative error of atan(t): 2.6e-9.
  const F z = t * t;
  F q = mul_add(F(-0x1.d4782ap-10), z, F(0x1.64b212p-7));
  q = mul_add(q, z, F(-0x1.fdefc4p-6));
  q = mul_add(q, z, F(0x1.da59eap-5));
  q = mul_add(q, z, F(-0x1.581456p-4));
  q = mul_add(q, z, F(0x1.c08f2ep-4));
  q = mul_add(q, z, F(-0x1.2420b4p-3));
  q = mul_add(q, z, F(0x1.9991e6p-3));
  q = mul_add(q, z, F(-0x1.55553ep-2));
  const F tail = (t * z) * q;
  // t + tail, pi / 2 -+ it, or pi - it; pi / 2 in two parts.
  const F turns = select(steep, F(1), select(left, F(2), F(0)));
  const F sign = select(steep ^ left, F(-1), F(1));
  const F angle = mul_add(turns, half_pi.high, sign * t) + mul_add(turns, half_pi.middle, sign * tail);
  return select(is_nan(x), x, select(is_nan(y), y, copy_sign(angle, y)));
}

inline SinCos<double> sincos(double x) { return {__builtin_sin(x), __builtin_cos(x)}; }
inline double sin(double x) { return __builtin_sin(x); }
inline double cos(double x) { return __builtin_cos(x); }
inline double tan(double x) { return __builtin_tan(x); }
inline double asin(double x) { return __builtin_asin(x); }
inline double acos(double x) { return __builtin_acos(x); }
inline double atan2(double y, double x) { return __builtin_atan2(y, x); }

}  // namespace
}  // namespace tessera::TESSERA_ISA

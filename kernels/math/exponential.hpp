// exp2, exp, log2, log, pow. See kernels/math/approx.hpp.
#pragma once
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// x * 2^n with one rounding, for x in [0.5, 2] and n in [-252, 254].
template <class F>
TESSERA_INLINE F scale_by_power_of_two(F x, IntOf<F> n) {
  using I = IntOf<F>;
  // In two steps: 2^n itself may be out of range. The first is exact.
  const I half = n >> 1, rest = n - half;
  return x * from_bits((half + I(127)) << 23) * from_bits((rest + I(127)) << 23);
}

// 2^f for |f| <= 0.5. Relative error of the polynomial: 3.0e-9.
template <class F>
TESSERA_INLINE F exp2_fraction(F f) {
  F q = mul_add(F(0x1.417872p-13), f, F(0x1.5f0952p-10));
  q = mul_add(q, f, F(0x1.3b2dd4p-7));
  q = mul_add(q, f, F(0x1.c6af7ap-5));
  q = mul_add(q, f, F(0x1.ebfbdcp-3));
  q = mul_add(q, f, F(0x1.62e430p-1));
  return mul_add(q, f, F(1));
}

// 2^x. At most 1 ulp.
template <class F>
inline F exp2(F x) {
  // 2^-152 rounds to 0 and 2^129 to infinity. In this order min and max keep a NaN.
  const F c = min(F(129), max(F(-152), x));
  const IntOf<F> n = round_to_int(c);
  return scale_by_power_of_two(exp2_fraction(c - to_float(n)), n);
}

// e^x. At most 1 ulp.
template <class F>
inline F exp(F x) {
  const F c = min(F(89.5), max(F(-105), x));  // e^-105 rounds to 0, e^89.5 to infinity
  const IntOf<F> n = round_to_int(c * F(0x1.715476p+0));
  // c - n ln 2, ln 2 in two parts; the first step is exact.
  const F whole = to_float(n);
  const F r = neg_mul_add(whole, F(-0x1.05c610p-29), neg_mul_add(whole, F(0x1.62e430p-1), c));
  // (e^r - 1 - r) / r^2 for |r| <= 0.3466; relative error of e^r: 3.2e-9.
  F q = mul_add(F(0x1.6ac500p-10), r, F(0x1.123dcap-7));
  q = mul_add(q, r, F(0x1.555858p-5));
  q = mul_add(q, r, F(0x1.55548cp-3));
  q = mul_add(q, r, F(0x1.fffffcp-2));
  const F square = r * r;
  return scale_by_power_of_two(F(1) + mul_add(square, q, r), n);
}

template <class F>
struct SplitFloat {
  F mantissa;  // in [sqrt(1/2), sqrt(2))
  F exponent;
};

// x = mantissa * 2^exponent, for x > 0 and finite; anything for other x.
template <class F>
TESSERA_INLINE SplitFloat<F> split_exponent(F x) {
  using I = IntOf<F>;
  const MaskOf<F> subnormal = x < F(0x1p-126);
  // Less the bits of sqrt(1/2); without the sign, so that the difference does not overflow for a negative x.
  const I offset = (bits(select(subnormal, x * F(0x1p24), x)) & I(0x7fffffff)) - I(0x3f3504f3);
  const F exponent = to_float(offset >> 23);
  return {from_bits((offset & I(0x7fffff)) + I(0x3f3504f3)), select(subnormal, exponent - F(24), exponent)};
}

// log(1 + f) - f for f in [sqrt(1/2) - 1, sqrt(2) - 1]. Relative error of log(1 + f): 5.9e-9.
template <class F>
TESSERA_INLINE F log1p_tail(F f) {
  F q = mul_add(F(-0x1.38c268p-4), f, F(0x1.056336p-3));
  q = mul_add(q, f, F(-0x1.0d8598p-3));
  q = mul_add(q, f, F(0x1.22d88cp-3));
  q = mul_add(q, f, F(-0x1.547218p-3));
  q = mul_add(q, f, F(0x1.99a022p-3));
  q = mul_add(q, f, F(-0x1.000228p-2));
  q = mul_add(q, f, F(0x1.555554p-2));
  q = mul_add(q, f, F(-0.5));
  return (f * f) * q;
}

// The logarithm's values outside its domain: -inf at 0, inf at inf, NaN for the rest.
template <class F>
TESSERA_INLINE F logarithm_or_special(F x, F value) {
  const F infinity = F(__builtin_inff());
  const F zero_or_invalid = select(x == F(0), -infinity, F(__builtin_nanf("")));
  const F outside = select(x == infinity, x, zero_or_invalid);
  return select((x > F(0)) & (x < infinity), value, outside);
}

// log2 of a positive finite number; anything for other x.
template <class F>
TESSERA_INLINE F log2_positive(F x) {
  const SplitFloat<F> s = split_exponent(x);
  const F f = s.mantissa - F(1);
  const F tail = log1p_tail(f);
  // (f + tail) / ln 2, 1 / ln 2 in two parts.
  const F low = mul_add(tail, F(0x1.715476p+0), f * F(0x1.4ae0c0p-26));
  const F log2_mantissa = mul_add(f, F(0x1.715476p+0), low);
  return s.exponent + log2_mantissa;
}

// Base-2 logarithm. At most 1.1 ulp.
template <class F>
inline F log2(F x) {
  return logarithm_or_special(x, log2_positive(x));
}

// Natural logarithm. At most 1 ulp.
template <class F>
inline F log(F x) {
  const SplitFloat<F> s = split_exponent(x);
  const F f = s.mantissa - F(1);
  const F low = mul_add(s.exponent, F(-0x1.05c610p-29), log1p_tail(f));
  return logarithm_or_special(x, mul_add(s.exponent, F(0x1.62e430p-1), f + low));
}

// x^y for x > 0 and finite, any y but NaN. The logarithm is carried in two floats: relative error about 2^-35.
template <class F>
TESSERA_INLINE F pow_positive(F x, F y) {
  const SplitFloat<F> split = split_exponent(x);
  const F m = split.mantissa;
  // s = (m - 1) / (m + 1) in two parts; m - 1 is exact, m + 1 in two parts too.
  const F numerator = m - F(1), denominator = m + F(1);
  const F denominator_low = m - (denominator - F(1));
  const F reciprocal = F(1) / denominator;
  const F s = numerator * reciprocal;
  const F remainder = neg_mul_add(s, denominator_low, neg_mul_add(s, denominator, numerator));
  const F s_low = remainder * reciprocal;
  // log m = 2 artanh s = 2 s (1 + t), t = z (1/3 + z q), z = s^2. q for |s| <= 0.1716; relative error of log
  // m: 8.5e-12.
  const F z = s * s;
  const F z_low = mul_add(s + s, s_low, mul_sub(s, s, z));
  F q = mul_add(F(0x1.dfa302p-4), z, F(0x1.24527ap-3));
  q = mul_add(q, z, F(0x1.999a00p-3));
  const F third = F(0x1.555556p-2), third_low = F(-0x1.555556p-27);
  const F t = z * third;
  F t_low = mul_add(z_low, third, mul_sub(z, third, t));
  t_low = mul_add(z, third_low, t_low);
  t_low = mul_add(z * z, q, t_low);
  // 2 / ln 2 s, then times 1 + t.
  const F k = F(0x1.715476p+1), k_low = F(0x1.4ae0c0p-25);
  const F product = k * s;
  const F product_low = mul_add(k_low, s, mul_add(k, s_low, mul_sub(k, s, product)));
  const F step = product * t;
  F low = mul_add(product, t_low, mul_sub(product, t, step));
  low = mul_add(product_low, t, product_low + low);
  const F high = product + step;
  const F high_low = low + (step - (high - product));
  // log2 x = exponent + log2 m. Either the exponent is 0, or larger than log2 m.
  const F log_high = split.exponent + high;
  const F log_low = (high - (log_high - split.exponent)) + high_low;
  // 2^(y log2 x)
  const F p = y * log_high;
  const F p_low = mul_add(y, log_low, mul_sub(y, log_high, p));
  const MaskOf<F> moderate = abs(p) < F(192);
  const F c = min(F(192), max(F(-192), p));
  const IntOf<F> n = round_to_int(c);
  const F fraction = (c - to_float(n)) + select(moderate, p_low, F(0));  // beyond, p_low may be NaN
  return scale_by_power_of_two(exp2_fraction(fraction), n);
}

// x^y. At most 1 ulp.
template <class F>
inline F pow(F x, F y) {
  using I = IntOf<F>;
  const F infinity = F(__builtin_inff()), a = abs(x);
  const MaskOf<F> ordinary = (a > F(0)) & (a < infinity) & (abs(y) < infinity);
  F power = pow_positive(a, y);
  // 0, infinity, or y infinite: the power is 0 or infinity, as a lies below or above 1 and y below or above 0.
  const F limit = select((a > F(1)) ^ (y > F(0)), F(0), infinity);
  power = select(ordinary, power, select(a == F(1), F(1), limit));
  power = select(is_nan(x), x, select(is_nan(y), y, power));

  const MaskOf<F> y_is_integer = floor(y) == y;
  const MaskOf<F> y_is_small = abs(y) < F(0x1p24);  // larger floats are even
  const I y_integer = round_to_int(select(y_is_small, y, F(0)));
  const MaskOf<F> y_is_odd = y_is_integer & y_is_small & ((y_integer & I(1)) != I(0));
  const MaskOf<F> x_has_sign = bits(x) < I(0);
  power = select(x_has_sign & y_is_odd, -power, power);
  const MaskOf<F> invalid = (x < F(0)) & (a < infinity) & !y_is_integer;
  power = select(invalid, F(__builtin_nanf("")), power);
  return select((y == F(0)) | (x == F(1)), F(1), power);
}

inline double exp2(double x) { return __builtin_exp2(x); }
inline double exp(double x) { return __builtin_exp(x); }
inline double log2(double x) { return __builtin_log2(x); }
inline double log(double x) { return __builtin_log(x); }
inline double pow(double x, double y) { return __builtin_pow(x, y); }
inline double pow_positive(double x, double y) { return __builtin_pow(x, y); }

}  // namespace
}  // namespace tessera::TESSERA_ISA

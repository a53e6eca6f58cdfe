// Cheaper forms of the elementary functions, by degree: points of the chart beside those of approx.hpp, which kernels
// use. The same bits on every target. None treats NaN, infinities or subnormals: each has its range, outside which it
// returns anything.
//
// Polynomials: minimax fits (Lawson's iteration on 400 Chebyshev nodes), coefficients rounded to float; the error
// quoted is the polynomial's in exact arithmetic.
#pragma once
#include "kernels/math/approx.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// c[0] + c[1] x + ...
template <int count, class F>
TESSERA_INLINE F horner(const float (&c)[count], F x) {
  F sum = F(c[count - 1]);
  for (int k = count - 2; k >= 0; --k) sum = mul_add(sum, x, F(c[k]));
  return sum;
}

// x 2^n where both are normal.
template <class F>
TESSERA_INLINE F scale_normal(F x, IntOf<F> n) {
  return x * from_bits((n + IntOf<F>(127)) << 23);
}
TESSERA_INLINE double scale_normal(double x, std::int64_t n) { return x * from_bits((n + 1023) << 52); }

template <class F>
struct NormalSplit {
  F mantissa, exponent;  // mantissa in [sqrt(1/2), sqrt(2))
};
template <class F>
TESSERA_INLINE NormalSplit<F> split_normal(F x) {
  using I = IntOf<F>;
  const I offset = bits(x) - I(0x3f3504f3);  // the bits of sqrt(1/2)
  return {from_bits((offset & I(0x7fffff)) + I(0x3f3504f3)), to_float(offset >> 23)};
}
TESSERA_INLINE NormalSplit<double> split_normal(double x) {
  const std::int64_t low = bits(static_cast<double>(__builtin_bit_cast(float, 0x3f3504f3)));
  const std::int64_t offset = bits(x) - low;
  return {from_bits((offset & ((std::int64_t{1} << 52) - 1)) + low), static_cast<double>(offset >> 52)};
}

// ------------------------------------------------------------------------------------------------------------- exp2

// 2^f for |f| <= 1/2. Relative errors 1.7e-3, 7.5e-5, 2.6e-6, 7.5e-8.
inline constexpr float exp2_degree_2[] = {1.0004431f, 0.703447998f, 0.238428935f};
inline constexpr float exp2_degree_3[] = {0.999928057f, 0.693260968f, 0.242611125f, 0.0551716685f};
inline constexpr float exp2_degree_4[] = {0.999999285f, 0.693121791f, 0.240247443f, 0.0559178591f, 0.00957010221f};
inline constexpr float exp2_degree_5[] = {1.00000012f,   0.693146944f,   0.240221202f,
                                          0.0555071346f, 0.00967554096f, 0.00132764096f};

/// 2^x for x in [-126, 127]; others, and NaN, are clamped to it: what a float beyond the integers converts to differs
/// between machines.
template <int count, class F>
TESSERA_INLINE F exp2_by(const float (&c)[count], F given) {
  const F x = clamp(given, F(-126), F(127));
  const IntOf<F> n = round_to_int(x);
  return scale_normal(horner(c, x - to_float(n)), n);
}
template <class F>
TESSERA_INLINE F exp2_poly2(F x) {
  return exp2_by(exp2_degree_2, x);
}
template <class F>
TESSERA_INLINE F exp2_poly3(F x) {
  return exp2_by(exp2_degree_3, x);
}
template <class F>
TESSERA_INLINE F exp2_poly4(F x) {
  return exp2_by(exp2_degree_4, x);
}
template <class F>
TESSERA_INLINE F exp2_poly5(F x) {
  return exp2_by(exp2_degree_5, x);
}

// ------------------------------------------------------------------------------------------------------------- log2

// log2(1 + f) / f for 1 + f in [sqrt(1/2), sqrt(2)): exact at 1. Absolute errors of log2 8.5e-4, 1.5e-5, 3.0e-7.
inline constexpr float log2_degree_3[] = {1.4451524f, -0.75408119f, 0.44506672f};
inline constexpr float log2_degree_5[] = {1.44257796f, -0.720241785f, 0.486686349f, -0.394575179f, 0.252658874f};
inline constexpr float log2_degree_7[] = {1.44269967f,  -0.721375883f, 0.480465025f, -0.35896185f,
                                          0.297262609f, -0.272697896f, 0.170634434f};

/// For normal x > 0.
template <int count, class F>
TESSERA_INLINE F log2_by(const float (&c)[count], F x) {
  const NormalSplit<F> s = split_normal(x);
  const F f = s.mantissa - F(1);
  return mul_add(f, horner(c, f), s.exponent);
}
template <class F>
TESSERA_INLINE F log2_poly3(F x) {
  return log2_by(log2_degree_3, x);
}
template <class F>
TESSERA_INLINE F log2_poly5(F x) {
  return log2_by(log2_degree_5, x);
}
template <class F>
TESSERA_INLINE F log2_poly7(F x) {
  return log2_by(log2_degree_7, x);
}

// -------------------------------------------------------------------------------------------------------------- pow

/// x^y for normal x > 0 and a result that is normal: the power magnifies the logarithm's error by y ln 2 2^(y log2 x).
template <class F>
TESSERA_INLINE F pow_exp2_log2(F x, F y) {
  return exp2(y * log2(x));
}
template <class F>
TESSERA_INLINE F pow_poly5_7(F x, F y) {
  return exp2_by(exp2_degree_5, y * log2_poly7(x));
}
template <class F>
TESSERA_INLINE F pow_poly3_5(F x, F y) {
  return exp2_by(exp2_degree_3, y * log2_poly5(x));
}

// ------------------------------------------------------------------------------------- square roots and reciprocals

template <class F>
TESSERA_INLINE F rsqrt_exact(F x) {
  return F(1) / sqrt(x);
}
template <class F>
TESSERA_INLINE F reciprocal_exact(F x) {
  return F(1) / x;
}

// Lomont 2003, Fast Inverse Square Root: 0x5f375a86. Within 3.5e-2.
TESSERA_INLINE Float rsqrt_guess(Float x) { return from_bits(Int(0x5f375a86) - (bits(x) >> 1)); }
TESSERA_INLINE double rsqrt_guess(double x) {
  return static_cast<double>(from_bits(0x5f375a86 - (bits(static_cast<float>(x)) >> 1)));
}
// Within 1.3e-1: the same idea, the bits of 1 twice, less what balances the error.
TESSERA_INLINE Float reciprocal_guess(Float x) { return from_bits(Int(0x7ef311c3) - bits(x)); }
TESSERA_INLINE double reciprocal_guess(double x) {
  return static_cast<double>(from_bits(0x7ef311c3 - bits(static_cast<float>(x))));
}

/// 1 / sqrt(x) for normal x > 0, by `steps` of Newton's iteration.
template <int steps, class F>
TESSERA_INLINE F rsqrt_newton(F x) {
  F y = rsqrt_guess(x);
  const F half = x * F(0.5);
  for (int k = 0; k < steps; ++k) y = y * neg_mul_add(half * y, y, F(1.5));
  return y;
}
template <class F>
TESSERA_INLINE F rsqrt_newton1(F x) {
  return rsqrt_newton<1>(x);
}
template <class F>
TESSERA_INLINE F rsqrt_newton2(F x) {
  return rsqrt_newton<2>(x);
}
template <class F>
TESSERA_INLINE F rsqrt_newton3(F x) {
  return rsqrt_newton<3>(x);
}

/// 1 / sqrt(x) without the divider, for a loop that keeps the division and root unit busy; for normal x > 0; at
/// most 1.5 ulp. Other x: some finite or infinite number, no trap. Lomont 2003, Fast Inverse Square Root (the constant;
/// within 3.5e-2), then, with h = 1 - x y^2, a step of third order y (1 + h/2 + 3/8 h^2) (Householder 1970;
/// within 1.1e-4) and one of Newton's, written as a correction so that its rounding counts only once.
template <class F>
TESSERA_INLINE F rsqrt_householder(F x) {
  F y = from_bits(IntOf<F>(0x5f375a86) - shift_right_logical(bits(x), 1));
  const F h = neg_mul_add(x * y, y, F(1));
  y = mul_add(y * h, mul_add(h, F(0.375), F(0.5)), y);
  const F rest = neg_mul_add(x * y, y, F(1));
  const F half = from_bits(bits(y) - IntOf<F>(1 << 23));
  return mul_add(half, rest, y);
}
TESSERA_INLINE double rsqrt_householder(double x) { return 1 / __builtin_sqrt(x); }

/// 1 / x for x in [1e-37, 1e37].
template <int steps, class F>
TESSERA_INLINE F reciprocal_newton(F x) {
  F y = reciprocal_guess(x);
  for (int k = 0; k < steps; ++k) y = mul_add(y, neg_mul_add(x, y, F(1)), y);
  return y;
}
template <class F>
TESSERA_INLINE F reciprocal_newton2(F x) {
  return reciprocal_newton<2>(x);
}
template <class F>
TESSERA_INLINE F reciprocal_newton3(F x) {
  return reciprocal_newton<3>(x);
}

// ------------------------------------------------------------------------------------------------------------- acos

// acos(a) / sqrt(1 - a) for a in [0,1]. Absolute errors of acos 3.2e-3, 3.8e-5, 6.4e-7. The form is Abramowitz and
// Stegun's 4.4.45.
inline constexpr float acos_degree_1[] = {1.56758928f, -0.168257803f};
inline constexpr float acos_degree_3[] = {1.57075834f, -0.212875187f, 0.0768973827f, -0.0208920334f};
inline constexpr float acos_degree_5[] = {1.57079566f,    -0.214542821f, 0.08817105f,
                                          -0.0459272228f, 0.0206200555f, -0.00491117174f};

/// x in [-1,1].
template <int count, class F>
TESSERA_INLINE F acos_by(const float (&c)[count], F x) {
  const F a = abs(x);
  const F y = sqrt(F(1) - a) * horner(c, a);
  return select(x < F(0), F(3.14159265358979) - y, y);
}
template <class F>
TESSERA_INLINE F acos_poly1(F x) {
  return acos_by(acos_degree_1, x);
}
template <class F>
TESSERA_INLINE F acos_poly3(F x) {
  return acos_by(acos_degree_3, x);
}
template <class F>
TESSERA_INLINE F acos_poly5(F x) {
  return acos_by(acos_degree_5, x);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

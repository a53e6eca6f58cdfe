// Elementary functions, the same bits on every target, for Float and float. Special values as in C (IEEE 754 annex of
// C11): NaN, infinities, signed zeros and subnormals included. Every function has a row in
// tests/kernels/math/accuracy_test.cpp with its range and bound.
//
// For double they are the host's libm: a formula evaluated in double then holds the formula's error alone. Only tests
// do that; a kernel object that referred to libm would not pass the `symbols` test.
//
// Polynomials: minimax fits in the relative error of the function (Lawson's iteration on 160 Chebyshev nodes, 34
// digits), then the coefficients rounded to float one by one from the lowest, fitting the others again each time. The
// error quoted is that of the rounded polynomial in exact arithmetic.
#pragma once
#include "kernels/math/exponential.hpp"
#include "kernels/math/trigonometric.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// x^5 by three multiplications.
template <class F>
TESSERA_INLINE F pow5(F x) {
  const F squared = x * x;
  return squared * squared * x;
}

// Cube root; at most 1 ulp.
template <class F>
inline F cbrt(F x) {
  using I = IntOf<F>;
  const F a = abs(x);
  // Subnormals are scaled so that their exponent counts, large numbers so that 3a is finite: by cubes.
  const MaskOf<F> small = a<F(0x1p-100), large = a> F(0x1p100);
  const F scaled = a * select(small, F(0x1p48), select(large, F(0x1p-48), F(1)));
  const F unscale = select(small, F(0x1p-16), select(large, F(0x1p16), F(1)));
  // A float's bits are nearly linear in its logarithm. Kahan's constant: within 6 %.
  F y = from_bits(truncate_to_int(to_float(bits(scaled)) * F(0.33333334)) + I(709921077));
  // Halley: within 1e-4.
  const F cube = y * y * y;
  y = y * ((cube + F(2) * scaled) / (F(2) * cube + scaled));
  // Newton, with the residual as if exact.
  const F square = y * y;
  const F square_error = mul_sub(y, y, square);
  const F residual = neg_mul_add(square_error, y, neg_mul_add(square, y, scaled));
  y = y + residual / (F(3) * square);
  const F root = copy_sign(y * unscale, x);
  return select((a > F(0)) & (a < F(__builtin_inff())), root, x);
}
inline double cbrt(double x) { return __builtin_cbrt(x); }

}  // namespace
}  // namespace tessera::TESSERA_ISA

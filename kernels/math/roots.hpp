// 1 / sqrt(x) without the divider: where a loop keeps the division and root unit busy, this runs beside it. The lights
// had it; on Zen 4, whose unit they fill to 58 %, hardware roots turned out faster.
#pragma once
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// 1 / sqrt(x) for normal x > 0; at most 1.5 ulp. Other x: some finite or infinite number, no trap.
/// Lomont 2003, Fast Inverse Square Root (the constant; within 3.5e-2), then, with h = 1 - x y^2, a step of third order
/// y (1 + h/2 + 3/8 h^2) (Householder 1970; within 1.1e-4) and one of Newton's, written as a correction so that its
/// rounding counts only once.
template <class F>
TESSERA_INLINE F reciprocal_sqrt(F x) {
  F y = from_bits(IntOf<F>(0x5f375a86) - shift_right_logical(bits(x), 1));
  const F h = neg_mul_add(x * y, y, F(1));
  y = mul_add(y * h, mul_add(h, F(0.375), F(0.5)), y);
  const F rest = neg_mul_add(x * y, y, F(1));
  const F half = from_bits(bits(y) - IntOf<F>(1 << 23));
  return mul_add(half, rest, y);
}
TESSERA_INLINE double reciprocal_sqrt(double x) { return 1 / __builtin_sqrt(x); }

}  // namespace
}  // namespace tessera::TESSERA_ISA

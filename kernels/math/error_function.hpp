// erf. See kernels/math/approx.hpp for what the functions of this folder promise, and how their polynomials were
// fitted.
#pragma once
#include "kernels/math/exponential.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// The error function, 2 / sqrt(pi) integral from 0 to x of e^(-t^2). At most 1.1 ulp.
template <class F>
inline F erf(F x) {
  const F a = abs(x);
  // erf(a) / a - 1 for a <= 1, z = a^2. Relative error of erf(a): 1.5e-9.
  const F z = a * a;
  F q = mul_add(F(0x1.47920cp-14), z, F(-0x1.a35986p-11));
  q = mul_add(q, z, F(0x1.53f2cap-8));
  q = mul_add(q, z, F(-0x1.b7f722p-6));
  q = mul_add(q, z, F(0x1.ce2ce6p-4));
  q = mul_add(q, z, F(-0x1.81273ep-2));
  q = mul_add(q, z, F(0x1.06eba8p-3));
  const F small = mul_add(a, q, a);
  // log(1 - erf(a)) for 1 <= a <= 4, beyond which erf rounds to 1. Relative error of erf(a): 1.1e-9.
  const F c = min(F(4), a);  // in this order a NaN is kept
  F p = mul_add(F(0x1.86dbaap-13), c, F(-0x1.825a6cp-9));
  p = mul_add(p, c, F(0x1.65cb72p-6));
  p = mul_add(p, c, F(-0x1.a6535ep-4));
  p = mul_add(p, c, F(-0x1.46bae4p-1));
  p = mul_add(p, c, F(-0x1.2088eep+0));
  p = mul_add(p, c, F(-0x1.660cf8p-12));
  return copy_sign(select(a < F(1), small, F(1) - exp(p)), x);
}
inline double erf(double x) { return __builtin_erf(x); }

}  // namespace
}  // namespace tessera::TESSERA_ISA

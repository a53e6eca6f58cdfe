// Distributions of microfacet normals beside GGX, each a density: integral D(h) n.h dh = 1. alpha = roughness^2 in
// [1e-4,1]; sin2 = 1 - NoH^2 taken from the vectors (sin2_between), both in [0,1]. Finite and non-negative there.
#pragma once
#include "kernels/bsdf/distribution.hpp"
#include "kernels/math/approx.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// log(1 + x) for x > -1, within a few ulp for small x too: rounding 1 + x scales the logarithm by the same factor as
/// the ratio takes out again (Higham 2002, Accuracy and Stability of Numerical Algorithms, section 1.14.1).
template <class F>
TESSERA_INLINE F log1p_ratio(F x) {
  const F u = F(1) + x;
  const F difference = u - F(1);
  return select(difference == F(0), x, log(u) * (x / difference));
}

/// (e^x - 1) / x, 1 at x = 0, by the same cancellation of errors.
template <class F>
TESSERA_INLINE F expm1_over_x(F x) {
  const F u = exp(x);
  const F logarithm = log(u);
  return select(logarithm == F(0), F(1), (u - F(1)) / logarithm);
}

/// Beckmann. Maximum 1/(pi alpha^2); 0 at the horizon.
template <class F>
TESSERA_INLINE F D_Beckmann(F NoH, F sin2, F alpha) {
  // Beckmann & Spizzichino 1963; as Walter et al. 2007, eq. 25, with tan^2 = sin2 / NoH^2.
  // 1e-18: its square stays a normal number; the exponential is 0 long before, from tan^2 > 88 alpha^2 on.
  const F cos2 = max(NoH * NoH, F(1e-18));
  const F alpha2 = alpha * alpha;
  return exp(-sin2 / (cos2 * alpha2)) / (F(pi) * alpha2 * cos2 * cos2);
}

/// Blinn-Phong, normalised, with the power that matches alpha: p = 2/alpha^2 - 2. alpha = 1 gives p = 0: constant 1/pi.
template <class F>
TESSERA_INLINE F D_BlinnPhong(F sin2, F alpha) {
  // Blinn 1977, Models of Light Reflection for Computer Synthesized Pictures; p as in Walter et al. 2007, section 5.2,
  // and Karis 2013, Specular BRDF Reference. NoH^p = (1 - sin2)^(p/2): for p up to 2e8 only the sine has the digits.
  const F alpha2 = alpha * alpha;
  const F half_power = (F(1) - alpha2) / alpha2;
  const F log_cos2 = log1p_ratio(-min(sin2, F(1 - 0x1p-24)));  // finite at the horizon
  return exp(half_power * log_cos2) / (F(pi) * alpha2);
}

/// Blinn-Phong through the power of the cosine, as most programs write it.
template <class F>
TESSERA_INLINE F D_BlinnPhong_naive(F NoH, F alpha) {
  const F alpha2 = alpha * alpha;
  const F power = F(2) / alpha2 - F(2);
  return (power + F(2)) * F(0.5 / pi) * pow(max(NoH, F(0)), power);
}

/// Generalised Trowbridge-Reitz with exponent gamma in [0.5,4]; 2 is GGX, 1 Berry's distribution.
template <class F>
TESSERA_INLINE F D_GTR(F NoH, F sin2, F alpha, F gamma) {
  // Burley 2012, Physically Based Shading at Disney, appendix B: c / t^gamma, t = sin^2 + (alpha cos)^2, with
  //   c = (gamma - 1)(alpha^2 - 1) / (pi (1 - alpha^(2 (1 - gamma)))).
  // Let L = ln alpha^2 and x = (1 - gamma) L. Then c = (1/pi) ((e^L - 1)/L) (x/(e^x - 1)): both factors tend to 1 where
  // the published form is 0/0, at alpha = 1 and at gamma = 1.
  const F scaled = alpha * NoH;
  const F t = max(mul_add(scaled, scaled, sin2), F(1e-37));
  const F log_alpha2 = F(2) * log(alpha);
  const F x = (F(1) - gamma) * log_alpha2;
  const F c = F(1 / pi) * expm1_over_x(log_alpha2) / expm1_over_x(x);
  return c * exp(-gamma * log(t));
}

/// Berry's distribution, GTR with exponent 1: the clearcoat of Disney's model. alpha = 1 is a 0/0 limit: constant 1/pi.
template <class F>
TESSERA_INLINE F D_GTR1(F NoH, F sin2, F alpha) {
  // Burley 2012, appendix B, eq. 4: (alpha^2 - 1) / (pi ln alpha^2 t).
  const F scaled = alpha * NoH;
  const F t = max(mul_add(scaled, scaled, sin2), F(1e-37));
  return F(1 / pi) * expm1_over_x(F(2) * log(alpha)) / t;
}

/// Anisotropic GGX; XoH, YoH, NoH = components of h along tangent, bitangent, normal; alpha_x, alpha_y in [1e-4,1].
template <class F>
TESSERA_INLINE F D_GGXAnisotropic(F XoH, F YoH, F NoH, F alpha_x, F alpha_y) {
  // Burley 2012, appendix B, eq. 13, multiplied through by (alpha_x alpha_y)^2: no division by a small alpha.
  const F product = alpha_x * alpha_y;
  const F u = alpha_y * XoH, v = alpha_x * YoH, w = product * NoH;
  const F t = mul_add(u, u, mul_add(v, v, w * w));
  const F ratio = product / max(t, F(1e-30));  // legitimate t is >= product^2 >= 1e-16
  return product * ratio * ratio * F(1 / pi);
}

/// Anisotropic Beckmann, the same inputs.
template <class F>
TESSERA_INLINE F D_BeckmannAnisotropic(F XoH, F YoH, F NoH, F alpha_x, F alpha_y) {
  // Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, eq. 80 and section 5.4.
  const F cos2 = max(NoH * NoH, F(1e-18));
  const F slope_x = XoH / alpha_x, slope_y = YoH / alpha_y;
  const F exponent = mul_add(slope_x, slope_x, slope_y * slope_y) / cos2;
  return exp(-exponent) / (F(pi) * alpha_x * alpha_y * cos2 * cos2);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

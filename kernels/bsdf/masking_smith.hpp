// Smith's masking and shadowing: the profile Lambda of a distribution, and how masking (towards the eye) and shadowing
// (towards the light) are joined. All as visibility V = G / (4 NoL NoV).
//
// A profile is used as its root S(mu) = mu (1 + 2 Lambda(mu)), which is finite at the horizon, where Lambda is not:
//   G1 = 1 / (1 + Lambda) = 2 mu / (mu + S)
// and every joint form below follows from those of the paper by bringing them over 4 NoL NoV.
//
// Cosines in [0,1], alpha in [0,1], ends included: finite and not negative there. Both cosines 0: at most 1e30.
#pragma once
#include "kernels/bsdf/distribution.hpp"
#include "kernels/bsdf/masking.hpp"
#include "kernels/math/error_function.hpp"
#include "kernels/math/trigonometric.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// Divides by what is 0 only where both directions lie in the horizon: V stays below 1e30 there, so that D V, with D
// at most 1 / (pi alpha^2), stays finite down to alpha = 1e-4.
template <class F>
TESSERA_INLINE F over_visible(F numerator, F denominator) {
  return numerator / max(denominator, F(1e-30));
}

// --------------------------------------------------------------------------------------------------------- profiles

// sin of the angle whose cosine is mu, times alpha: 1 / (alpha tan) = mu / this.
template <class F>
TESSERA_INLINE F scaled_sine(F mu, F alpha) {
  return alpha * sqrt(max(neg_mul_add(mu, mu, F(1)), F(0)));
}

/// S for Beckmann, exact.
template <class F>
TESSERA_INLINE F smith_root_Beckmann(F mu, F alpha) {
  // Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces, eq. 26, with a = mu / (alpha sin):
  // mu (1 + 2 Lambda) = mu erf(a) + alpha sin e^(-a^2) / sqrt(pi), a sum of positive terms.
  const F spread = scaled_sine(mu, alpha);
  // 1e-20: mu = 1 or alpha = 0, where a is infinite and S = mu. 6: e^-36 is nothing beside 1, and no denormal, which
  // would take a hundred cycles.
  const F a = min(mu / max(spread, F(1e-20)), F(6));
  return mul_add(mu, erf(a), spread * exp(-(a * a)) * F(0.564189583547756287));  // 1 / sqrt(pi)
}

/// S for Beckmann by a rational fit of G1: within 0.0032 of G1; G1 jumps by 6e-5, from above 1 to 1, at a = 1.6.
template <class F>
TESSERA_INLINE F smith_root_BeckmannRational(F mu, F alpha) {
  // Walter et al. 2007, eq. 27: G1 = (3.535 a + 2.181 a^2) / (1 + 2.276 a + 2.577 a^2) for a < 1.6, else 1; so
  // Lambda = (1 - 1.259 a + 0.396 a^2) / (a (3.535 + 2.181 a)), and mu / a = alpha sin.
  const F spread = scaled_sine(mu, alpha);
  const F a = min(mu / max(spread, F(1e-20)), F(1.6));
  const F numerator = mul_add(mul_add(F(0.396), a, F(-1.259)), a, F(1));
  const F twice_lambda_mu = F(2) * spread * numerator / mul_add(F(2.181), a, F(3.535));
  return mu + select(a < F(1.6), twice_lambda_mu, F(0));
}

/// Masking of one direction, G1 = 1 / (1 + Lambda).
template <class F>
TESSERA_INLINE F smith_G1(F mu, F root) {
  return over_visible(F(2) * mu, mu + root);
}
template <class F>
TESSERA_INLINE F G1_SmithGGX(F mu, F alpha) {
  return smith_G1(mu, smith_root_GGX(mu, alpha * alpha));
}
template <class F>
TESSERA_INLINE F G1_SmithBeckmann(F mu, F alpha) {
  return smith_G1(mu, smith_root_Beckmann(mu, alpha));
}
template <class F>
TESSERA_INLINE F G1_SmithBeckmannRational(F mu, F alpha) {
  return smith_G1(mu, smith_root_BeckmannRational(mu, alpha));
}

// ------------------------------------------------------------------------------------------------------ joint forms
// Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, section 5 on. Each takes the
// cosine and the root of either direction.

/// Masking and shadowing independent: G = G1(v) G1(l), eq. 98.
template <class F>
TESSERA_INLINE F V_separable(F NoV, F root_v, F NoL, F root_l) {
  return over_visible(F(1), (NoV + root_v) * (NoL + root_l));
}

/// Correlated by height: G = 1 / (1 + Lambda(v) + Lambda(l)), eq. 99.
template <class F>
TESSERA_INLINE F V_height_correlated(F NoV, F root_v, F NoL, F root_l) {
  const F masked_v = NoL * root_v;
  return over_visible(F(0.5), mul_add(NoV, root_l, masked_v));
}

/// How little masking and shadowing have to do with each other when v and l are phi apart in azimuth: 0 for phi = 0,
/// 0.93 for phi = pi. phi in [0, 2 pi], folded.
template <class F>
TESSERA_INLINE F decorrelation_vanGinneken(F phi) {
  // van Ginneken, Stavridi, Koenderink 1998, Diffuse and Specular Reflectance from Rough Surfaces.
  const F x = F(4.41) * min(phi, F(2 * pi) - phi);
  return x / (x + F(1));
}

/// The azimuth between v and l: along = l.v - NoL NoV, across = n.(v x l).
template <class F>
TESSERA_INLINE F azimuth_between(F along, F across) {
  return atan2(abs(across), along);
}

/// Correlated by direction: G = w G1(v) G1(l) + (1 - w) min(G1(v), G1(l)), w = decorrelation; eq. 100.
template <class F>
TESSERA_INLINE F V_direction_correlated(F low, F root_low, F high, F root_high, F decorrelation) {
  // low = the smaller cosine, whose G1 is the smaller. With a = low + S, b = high + S':
  // V = w / (a b) + (1 - w) / (2 a high)
  const F b = high + root_high;
  const F numerator = mul_add(F(1) - decorrelation, b, F(2) * high * decorrelation);
  return over_visible(numerator, F(2) * high * b * (low + root_low));
}

/// Correlated by height and direction: G = 1 / (1 + max(Lambda) + w min(Lambda)), eq. 101.
template <class F>
TESSERA_INLINE F V_height_direction_correlated(F low, F root_low, F high, F root_high, F decorrelation) {
  // low = the smaller cosine, whose Lambda is the larger.
  const F other = decorrelation * low * (root_high - high);
  return over_visible(F(0.5), mul_add(high, low + root_low, other));
}

// ------------------------------------------------------------------------------------------------- as the chart has
// them

template <class F>
TESSERA_INLINE F V_SmithGGXSeparable(F NoV, F NoL, F alpha) {
  const F alpha2 = alpha * alpha;
  return V_separable(NoV, smith_root_GGX(NoV, alpha2), NoL, smith_root_GGX(NoL, alpha2));
}
/// phi: azimuth between v and l.
template <class F>
TESSERA_INLINE F V_SmithGGXDirectionCorrelated(F NoV, F NoL, F phi, F alpha) {
  const F alpha2 = alpha * alpha, low = min(NoV, NoL), high = max(NoV, NoL);
  return V_direction_correlated(low, smith_root_GGX(low, alpha2), high, smith_root_GGX(high, alpha2),
                                decorrelation_vanGinneken(phi));
}
template <class F>
TESSERA_INLINE F V_SmithGGXHeightDirectionCorrelated(F NoV, F NoL, F phi, F alpha) {
  const F alpha2 = alpha * alpha, low = min(NoV, NoL), high = max(NoV, NoL);
  return V_height_direction_correlated(low, smith_root_GGX(low, alpha2), high, smith_root_GGX(high, alpha2),
                                       decorrelation_vanGinneken(phi));
}
template <class F>
TESSERA_INLINE F V_SmithBeckmannSeparable(F NoV, F NoL, F alpha) {
  return V_separable(NoV, smith_root_Beckmann(NoV, alpha), NoL, smith_root_Beckmann(NoL, alpha));
}
template <class F>
TESSERA_INLINE F V_SmithBeckmannCorrelated(F NoV, F NoL, F alpha) {
  return V_height_correlated(NoV, smith_root_Beckmann(NoV, alpha), NoL, smith_root_Beckmann(NoL, alpha));
}
template <class F>
TESSERA_INLINE F V_SmithBeckmannRationalSeparable(F NoV, F NoL, F alpha) {
  return V_separable(NoV, smith_root_BeckmannRational(NoV, alpha), NoL, smith_root_BeckmannRational(NoL, alpha));
}
template <class F>
TESSERA_INLINE F V_SmithBeckmannRationalCorrelated(F NoV, F NoL, F alpha) {
  return V_height_correlated(NoV, smith_root_BeckmannRational(NoV, alpha), NoL,
                             smith_root_BeckmannRational(NoL, alpha));
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

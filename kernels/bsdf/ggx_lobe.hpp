// The GGX specular lobe with height-correlated Smith masking, as the light loop evaluates it.
//
// With H = l + v not normalised, N = n.H (by linearity n.l + n.v) and T = |H - n N|^2:
//   D = alpha^2 |H|^4 / (pi (T + alpha^2 N^2)^2)        the stable form of distribution.hpp, scaled by |H|^2
//   V = 1 / (2 (NoL root(NoV) + NoV root(NoL)))
//   D V = alpha^2/(2 pi) |H|^4 / ((T + alpha^2 N^2)^2 (NoL root(NoV) + NoV root(NoL)))
// one division in all, and no reciprocal of |H|. NoV goes under the root that it multiplies:
//   NoV root(NoL) = sqrt(NoL^2 (NoV^2 - NoV^2 alpha^2) + NoV^2 alpha^2)
#pragma once
#include "kernels/bsdf/distribution.hpp"
#include "kernels/bsdf/masking.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// What depends on the surface and the eye only.
template <class F>
struct GGXLobe {
  F alpha2, half_alpha2_over_pi;
  F root_v;             // smith_root_GGX(NoV, alpha2)
  F slope2, intercept;  // (NoV smith_root_GGX(NoL, alpha2))^2 = NoL^2 slope2 + intercept
};

/// NoV in [1e-4,1], alpha in [0.002,1].
template <class F>
TESSERA_INLINE GGXLobe<F> ggx_lobe(F NoV, F alpha) {
  const F alpha2 = alpha * alpha, NoV2 = NoV * NoV, intercept = NoV2 * alpha2, slope2 = NoV2 - intercept;
  return {alpha2, alpha2 * F(0.5 / pi), smith_root_GGX(NoV, alpha2), slope2, intercept};
}

/// D V as a fraction, so that a caller who divides anyway divides once.
template <class F>
struct LobeFraction {
  F numerator, denominator;  // denominator at least 1e-36
};

/// D V for H = l + v: H2 = |H|^2, t = |H - n (n.H)|^2 + alpha^2 (n.H)^2 (where n.H < 0, H2), NoL in [0,2].
template <class F>
TESSERA_INLINE LobeFraction<F> DV_GGX_fraction(const GGXLobe<F>& lobe, F H2, F t, F NoL) {
  // Walter 2007, eq. 33 and Heitz 2014, eq. 99, fused as derived above.
  const F masked = mul_add(NoL, lobe.root_v, sqrt(mul_add(NoL * NoL, lobe.slope2, lobe.intercept)));
  // 1e-36: l = -v makes t and H2 vanish together. Where both directions are above the horizon by 1e-6 or more, t >=
  // alpha^2 |H|^2 keeps the product above it.
  return {lobe.half_alpha2_over_pi * (H2 * H2), max(t * t * masked, F(1e-36))};
}

/// D V of the same H with NoH = max(n.H, 0) and tangential2 = |H - n NoH|^2.
template <class F>
TESSERA_INLINE F DV_GGX(const GGXLobe<F>& lobe, F H2, F NoH, F tangential2, F NoL) {
  const LobeFraction<F> dv = DV_GGX_fraction(lobe, H2, mul_add(NoH, lobe.alpha2 * NoH, tangential2), NoL);
  return dv.numerator / dv.denominator;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

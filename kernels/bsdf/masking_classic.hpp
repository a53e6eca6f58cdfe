// Masking and shadowing that is cheaper, or older, than Smith's: as visibility V = G / (4 NoL NoV).
//
// Cosines in [0,1], alpha and roughness in [0,1], ends included: finite and not negative there. Where the model itself
// is infinite (both directions in the horizon; v.h = 0), at most 1e30.
#pragma once
#include "kernels/bsdf/masking_smith.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Height-correlated Smith without its roots: V = 0.5 / lerp(2 NoL NoV, NoL + NoV, alpha), exact for alpha = 0 and 1.
template <class F>
TESSERA_INLINE F V_SmithGGXCorrelatedFast(F NoV, F NoL, F alpha) {
  // Hammon 2017, PBR Diffuse Lighting for GGX+Smith Microsurfaces (slide "Smith for GGX, approximated").
  const F smooth = F(2) * NoV * NoL, rough = NoV + NoL;
  return over_visible(F(0.5), mul_add(alpha, rough - smooth, smooth));
}

// ------------------------------------------------------------------------ Schlick's fit, G1 = mu / (mu (1 - k) + k)

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering, eq. 19 with k in [0,1], separable.
template <class F>
TESSERA_INLINE F V_Schlick(F NoV, F NoL, F k) {
  const F rest = F(1) - k;
  return over_visible(F(0.25), mul_add(NoV, rest, k) * mul_add(NoL, rest, k));
}

/// k = alpha / 2, to follow GGX: Karis 2013, Real Shading in Unreal Engine 4, eq. 4 without its remapping.
template <class F>
TESSERA_INLINE F V_SchlickGGX(F NoV, F NoL, F alpha) {
  return V_Schlick(NoV, NoL, F(0.5) * alpha);
}

/// k = (r + 1)^2 / 8 of the perceptual roughness r: Karis 2013, eq. 4, "reduces hotness" of analytic lights. Too dark
/// at grazing angles for an environment; k = 1/8 even for r = 0, where nothing masks.
template <class F>
TESSERA_INLINE F V_SchlickGGXRemapped(F NoV, F NoL, F roughness) {
  const F plus_one = roughness + F(1);
  return V_Schlick(NoV, NoL, plus_one * plus_one * F(0.125));
}

/// k = alpha sqrt(2 / pi), to follow Beckmann: Schlick 1994, eq. 19.
template <class F>
TESSERA_INLINE F V_SchlickBeckmann(F NoV, F NoL, F alpha) {
  return V_Schlick(NoV, NoL, alpha * F(0.797884560802865356));
}

// --------------------------------------------------------------------------------------------- independent of alpha

/// V-shaped grooves: G = min(1, 2 NoH NoV / VoH, 2 NoH NoL / VoH).
template <class F>
TESSERA_INLINE F V_CookTorrance(F NoV, F NoL, F NoH, F VoH) {
  // Cook and Torrance 1982, A Reflectance Model for Computer Graphics (after Torrance and Sparrow 1967). Of the
  // two fractions that of the smaller cosine counts: V = NoH / (2 high max(2 NoH low, VoH)).
  const F low = min(NoV, NoL), high = max(NoV, NoL);
  return over_visible(NoH, F(2) * high * max(F(2) * NoH * low, VoH));
}

/// G = NoL NoV / max(NoL, NoV).
template <class F>
TESSERA_INLINE F V_Neumann(F NoV, F NoL) {
  // Neumann, Neumann, Szirmay-Kalos 1999, Compact Metallic Reflectance Models.
  return over_visible(F(0.25), max(NoV, NoL));
}

/// G = NoL NoV / VoH^2: the V-shaped groove's, without its minimum and its NoH.
template <class F>
TESSERA_INLINE F V_Kelemen(F VoH) {
  // Kelemen and Szirmay-Kalos 2001, A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling.
  return over_visible(F(0.25), VoH * VoH);
}

/// G = NoL NoV. Named by Hoffman 2013, Background: Physics and Math of Shading.
template <class F>
TESSERA_INLINE F V_Implicit(F /*NoV*/, F /*NoL*/) {
  return F(0.25);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

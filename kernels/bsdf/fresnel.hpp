// Fresnel reflectance, per channel. F0 = reflectance at normal incidence.
#pragma once
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// (1 - cosine)^5 by three multiplications.
template <class F>
TESSERA_INLINE F schlick_weight(F cosine) {
  const F m = F(1) - cosine;
  const F m2 = m * m;
  return m2 * m2 * m;
}

/// F0 and VoH in [0,1]. weight = (1 - VoH)^5, shared by the three channels.
template <class F>
TESSERA_INLINE F F_SchlickWeighted(F f0, F weight) {
  return mul_add(F(1) - f0, weight, f0);
}

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering, eq. 15; power by multiplication.
template <class F>
TESSERA_INLINE F F_Schlick(F f0, F VoH) {
  return F_SchlickWeighted(f0, schlick_weight(VoH));
}

/// Schlick's form for an environment, which reaches less than 1 at grazing angles on a rough surface: weight =
/// (1 - NoV)^5, roughness perceptual. Lagarde 2011, Adopting a physically based shading model.
template <class F>
TESSERA_INLINE F F_SchlickRoughness(F f0, F weight, F roughness) {
  return mul_add(max(F(1) - roughness, f0) - f0, weight, f0);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// How much of the light a diffuse lobe gets below a specular one: the factor kd of the diffuse lobe, one channel.
//
// All inputs in [0,1]; results too.
#pragma once
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// kd = (1 - F)(1 - metallic). Reciprocal if F is that of v.h, as with a light; not if F is that of n.v, as with an
/// environment.
template <class F>
TESSERA_INLINE F kd_Fresnel(F fresnel, F metallic) {
  return (F(1) - fresnel) * (F(1) - metallic);
}

/// kd = (1 - E(v))(1 - metallic), E = F0 A + B the specular lobe's directional albedo from the DFG table or a fit of
/// it. Exactly what the specular lobe leaves of light that arrives along v, so that a white base loses nothing; not
/// reciprocal.
template <class F>
TESSERA_INLINE F kd_AlbedoScaled(F f0, F A, F B, F metallic) {
  return max(F(1) - mul_add(f0, A, B), F(0)) * (F(1) - metallic);  // 0: a fitted A + B may exceed 1
}

/// kd = (1 - E(v))(1 - E(l)) / (1 - Eavg), times 1 - metallic: the reciprocal form, whose integral over l is the form
/// above. E_average = 2 integral E(mu) mu dmu.
template <class F>
TESSERA_INLINE F kd_Coupled(F E_v, F E_l, F E_average, F metallic) {
  // Kelemen and Szirmay-Kalos 2001, A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling.
  // 1e-6: a specular lobe that takes all leaves 0 / 0.
  return (F(1) - E_v) * (F(1) - E_l) / max(F(1) - E_average, F(1e-6)) * (F(1) - metallic);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

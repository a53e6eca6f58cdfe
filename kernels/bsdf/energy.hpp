// Energy that a single-scattering lobe loses: light that leaves a microfacet only to meet another.
#pragma once
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/math/vector.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// How an environment's radiance splits at a surface. All per channel, in [0,1].
template <class F>
struct EnvironmentSplit {
  Vec3<F> single;  // FssEss: weight of prefiltered radiance
  Vec3<F> all;     // FssEss + FmsEms: with the light that met several facets
};

/// One channel; A and B as the DFG table holds them, weight = (1 - NoV)^5.
template <class F>
TESSERA_INLINE void split_channel(F f0, F A, F B, F weight, F roughness, F* single, F* all) {
  // Fdez-Aguera 2019, A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting, section 3 and listing
  // 1 (which puts the roughness-dependent kS where the derivation has F0). FmsEms = FssEss Favg Ems / (1 - Favg Ems),
  // so that FssEss + FmsEms = FssEss / (1 - Favg Ems).
  const F kS = F_SchlickRoughness(f0, weight, roughness);
  *single = mul_add(kS, A, B);
  const F Ems = F(1) - (A + B);
  // What a facet sends on to another one: Favg Ems, with Favg = F0 + (1 - F0) / 21.
  const F again = mul_add(f0, Ems * F(20.0 / 21), Ems * F(1.0 / 21));
  *all = *single / (F(1) - again);
}

template <class F>
TESSERA_INLINE EnvironmentSplit<F> multiple_scattering_FdezAguera(const Vec3<F>& f0, F A, F B, F weight, F roughness) {
  EnvironmentSplit<F> split;
  split_channel(f0.x, A, B, weight, roughness, &split.single.x, &split.all.x);
  split_channel(f0.y, A, B, weight, roughness, &split.single.y, &split.all.y);
  split_channel(f0.z, A, B, weight, roughness, &split.single.z, &split.all.z);
  return split;
}

/// Weight of irradiance / pi in one channel: light that met several facets, and the albedo's share of what the lobe
/// leaves over.
template <class F>
TESSERA_INLINE F irradiance_weight(F single, F all, F albedo) {
  return mul_add(albedo, F(1) - all, all - single);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

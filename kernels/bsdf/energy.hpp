// Energy that a single-scattering lobe loses: light that leaves a microfacet only to meet another.
#pragma once
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/math/vector.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// How an environment's radiance splits at a surface. All per channel, in [0,1].
template <class F>
struct EnvironmentSplit {
  Vec3<F> single;    // FssEss: weight of prefiltered radiance
  Vec3<F> multiple;  // FmsEms: weight of irradiance / pi, from light that met several facets
};

/// One channel; A and B as the DFG table holds them, weight = (1 - NoV)^5.
template <class F>
TESSERA_INLINE void split_channel(F f0, F A, F B, F weight, F roughness, F* single, F* multiple) {
  // Fdez-Aguera 2019, A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting, section 3 and listing
  // 1 (which puts the roughness-dependent kS where the derivation has F0).
  const F kS = F_SchlickRoughness(f0, weight, roughness);
  *single = mul_add(kS, A, B);
  const F Ems = F(1) - (A + B);
  const F Favg = mul_add(F(1) - f0, F(1.0 / 21), f0);
  const F again = Favg * Ems;  // what a facet sends on to another one
  *multiple = *single * again / (F(1) - again);
}

template <class F>
TESSERA_INLINE EnvironmentSplit<F> multiple_scattering_FdezAguera(const Vec3<F>& f0, F A, F B, F weight, F roughness) {
  EnvironmentSplit<F> split;
  split_channel(f0.x, A, B, weight, roughness, &split.single.x, &split.multiple.x);
  split_channel(f0.y, A, B, weight, roughness, &split.single.y, &split.multiple.y);
  split_channel(f0.z, A, B, weight, roughness, &split.single.z, &split.multiple.z);
  return split;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// One light on one surface, from the scalars that the light loop has: the unit that the price of determinism is
// measured on.
#pragma once
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/bsdf/ggx_lobe.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// D V F n.l, arguments as DV_GGX and F_Schlick take them.
template <class F>
TESSERA_INLINE F specular_light(F H2, F NoH, F tangential2, F NoV, F NoL, F alpha, F F0, F VoH) {
  const F dv = DV_GGX(ggx_lobe(NoV, alpha), H2, NoH, tangential2, NoL);
  return dv * F_Schlick(F0, VoH) * NoL;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// Masking and shadowing, as visibility V = G / (4 NoL NoV): what multiplies D F in a specular lobe.
#pragma once
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// mu (1 + 2 Lambda(mu)) for GGX: the root in Smith's Lambda = (sqrt(1 + alpha^2 tan^2) - 1) / 2, times mu.
/// mu in [0,1], alpha2 = alpha^2. Depends on one direction only: hoist it for the eye.
template <class F>
TESSERA_INLINE F smith_root_GGX(F mu, F alpha2) {
  return sqrt(mul_add(mu * mu, F(1) - alpha2, alpha2));
}

/// Height-correlated Smith visibility for GGX. NoV, NoL in [0,1], not both 0; alpha in (0,1].
template <class F>
TESSERA_INLINE F V_SmithGGXCorrelated(F NoV, F NoL, F alpha) {
  // Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, eq. 99:
  // G = 1 / (1 + Lambda(v) + Lambda(l)); both fractions brought over 2 NoL NoV.
  const F alpha2 = alpha * alpha;
  const F masked_v = NoL * smith_root_GGX(NoV, alpha2);
  return F(0.5) / mul_add(NoV, smith_root_GGX(NoL, alpha2), masked_v);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

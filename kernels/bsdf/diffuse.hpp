// Diffuse lobes: BRDF values, cosine not included.
#pragma once
#include "kernels/bsdf/distribution.hpp"
#include "kernels/math/vector.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Lambert: the same radiance in every direction. albedo in [0,1].
template <class F>
TESSERA_INLINE Vec3<F> Fd_Lambert(const Vec3<F>& albedo) {
  return albedo * F(1 / pi);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

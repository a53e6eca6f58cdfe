// From G-buffer lanes to a point that can be shaded. What the planes hold is in GBufferView's ranges.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

template <class F>
TESSERA_INLINE Vec3<F> load_vector(const float* const (&planes)[3], std::uint32_t i) {
  return {load<F>(planes[0] + i), load<F>(planes[1] + i), load<F>(planes[2] + i)};
}

/// Finite and non-negative, whatever the sum became; -0 becomes +0.
template <class F>
TESSERA_INLINE Vec3<F> clamp_radiance(const Vec3<F>& radiance) {
  return {clamp(radiance.x, F(0), F(max_radiance)), clamp(radiance.y, F(0), F(max_radiance)),
          clamp(radiance.z, F(0), F(max_radiance))};
}

inline constexpr double dielectric_f0 = 0.04;            // ior 1.5
inline constexpr double min_punctual_roughness = 0.045;  // alpha = 0.002: a point light's highlight stays wider than a
                                                         // pixel, and alpha^4 far from the denormals

/// A surface's colours, in [0, 1]: at normal incidence, and of the diffuse part.
template <class F>
struct Reflectance {
  Vec3<F> f0, albedo;
};

template <class F>
TESSERA_INLINE Reflectance<F> load_reflectance(const GBufferView& g, std::uint32_t i) {
  const Vec3<F> base_color = load_vector<F>(g.base_color, i);
  const F metallic = load<F>(g.metallic + i);
  const F dielectric = F(1) - metallic;
  const F f0 = dielectric * F(dielectric_f0);
  return {
      {mul_add(base_color.x, metallic, f0), mul_add(base_color.y, metallic, f0), mul_add(base_color.z, metallic, f0)},
      base_color * dielectric};
}

/// Towards the eye, of any length. eye as ShadeArgs::eye.
template <class F>
TESSERA_INLINE Vec3<F> to_eye(const Vec3<F>& position, const float eye[4]) {
  const Vec3<F> e = {F(eye[0]), F(eye[1]), F(eye[2])};
  return eye[3] == 0.0f ? e : e - position;
}

/// n.v as V = G/(4 NoL NoV) can bear it: in [1e-4, 1].
template <class F>
TESSERA_INLINE F clamp_NoV(F nv) {
  return clamp(nv, F(1e-4), F(1));
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

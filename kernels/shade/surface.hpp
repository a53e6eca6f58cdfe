// From G-buffer lanes to a point that can be shaded. Whatever bits the planes hold, what leaves here is in range.
#pragma once
#include "kernels/bsdf/diffuse.hpp"
#include "kernels/bsdf/ggx_lobe.hpp"
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

template <class F>
struct Surface {
  Vec3<F> position;    // within +-max_coordinate
  Vec3<F> normal;      // unit; components within +-1 in any case
  Vec3<F> base_color;  // 0..1, as the five below
  F metallic, roughness, occlusion;
};

inline constexpr double max_coordinate = 1e12;  // metres; distances cubed stay finite
inline constexpr double max_radiance = 1e30;    // a sum of 1e8 of these is still finite

TESSERA_INLINE Float load_clamped(const float* plane, std::uint32_t i, double low, double high) {
  return clamp(load<Float>(plane + i), Float(low), Float(high));
}

TESSERA_INLINE Vec3<Float> load_clamped(float* const planes[3], std::uint32_t i, double low, double high) {
  return {load_clamped(planes[0], i, low, high), load_clamped(planes[1], i, low, high),
          load_clamped(planes[2], i, low, high)};
}

TESSERA_INLINE Surface<Float> load_surface(const GBufferView& g, std::uint32_t i) {
  return {load_clamped(g.position, i, -max_coordinate, max_coordinate),
          load_clamped(g.normal, i, -1, 1),
          load_clamped(g.base_color, i, 0, 1),
          load_clamped(g.metallic, i, 0, 1),
          load_clamped(g.roughness, i, 0, 1),
          load_clamped(g.occlusion, i, 0, 1)};
}

/// A surface seen from the eye: all that no light changes.
template <class F>
struct ShadingPoint {
  Vec3<F> position, n, v;
  Vec3<F> to_eye;  // v, of any length
  F to_eye_n;      // n.to_eye: both are there before a root is taken
  F nv;            // n.v as it is; negative where a shading normal turns away from the eye
  F NoV;           // in [1e-4,1]: keeps V = G/(4 NoL NoV) finite
  Vec3<F> f0;
  Vec3<F> albedo;  // of the diffuse part
  F roughness, occlusion;
};

inline constexpr double dielectric_f0 = 0.04;            // ior 1.5
inline constexpr double min_punctual_roughness = 0.045;  // alpha = 0.002: a point light's highlight stays wider than a
                                                         // pixel, and alpha^4 far from the denormals

/// eye as ShadeArgs::eye.
template <class F>
TESSERA_INLINE ShadingPoint<F> shading_point(const Surface<F>& s, const float eye[4]) {
  ShadingPoint<F> p;
  p.position = s.position;
  p.n = s.normal;
  const Vec3<F> e = {F(eye[0]), F(eye[1]), F(eye[2])};
  p.to_eye = eye[3] == 0.0f ? e : e - s.position;
  p.to_eye_n = dot(p.n, p.to_eye);
  p.v = normalize(p.to_eye);
  p.nv = dot(p.n, p.v);
  p.NoV = clamp(p.nv, F(1e-4), F(1));
  const F dielectric = F(1) - s.metallic;
  const F f0 = dielectric * F(dielectric_f0);
  p.f0 = {mul_add(s.base_color.x, s.metallic, f0), mul_add(s.base_color.y, s.metallic, f0),
          mul_add(s.base_color.z, s.metallic, f0)};
  p.albedo = s.base_color * dielectric;
  p.roughness = s.roughness;
  p.occlusion = s.occlusion;
  return p;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// Lights without extent: directional, point, spot.
//
// Domain, which whoever fills a LightView keeps: every field finite, |position| <= 1e12, direction of unit length,
// color and inverse_range_squared >= 0.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// 1/d^2 is exact down to a micrometre. The number keeps 1/d^3 (1e18) and E times the sharpest lobe (1e12 * 2e7) far
/// from overflow; nearer than that, the light's direction shrinks to zero, so a light at the point itself adds nothing.
inline constexpr double min_distance_squared = 1e-12;

/// What arrives from a light: color * attenuation is the irradiance (lux) of a surface that faces it.
template <class F>
struct Incident {
  Vec3<F> l;  // towards the light, unit
  F attenuation;
};

template <class F>
TESSERA_INLINE Vec3<F> broadcast(const float v[3]) {
  return {F(v[0]), F(v[1]), F(v[2])};
}

/// position within +-1e12: distances cubed then stay finite.
template <class F>
TESSERA_INLINE Incident<F> incident_light(const LightView& light, const Vec3<F>& position) {
  const Vec3<F> direction = broadcast<F>(light.direction);
  if (light.type == LightType::directional) return {-direction, F(1)};

  const Vec3<F> d = broadcast<F>(light.position) - position;
  const F d2 = max(dot(d, d), F(min_distance_squared));
  const F q = d2 * F(light.inverse_range_squared);
  const F window = max(neg_mul_add(q, q, F(1)), F(0));
  const F distance = sqrt(d2);
  Incident<F> in;
  if (light.falloff == Falloff::inverse_square) {
    // KHR_lights_punctual, Range property: max(min(1 - (d/range)^4, 1), 0) / d^2.
    const F inverse = F(1) / distance;
    in = {d * inverse, window * (inverse * inverse)};
  } else {
    // Karis 2013, Real Shading in Unreal Engine 4, eq. 9: sat(1 - (d/range)^4)^2 / (d^2 + 1). One division gives both
    // 1/d and 1/(d^2 + 1).
    const F d2_plus_1 = d2 + F(1);
    const F inverse = F(1) / (distance * d2_plus_1);
    in = {d * (inverse * d2_plus_1), window * window * (inverse * distance)};
  }
  if (light.type == LightType::spot) {
    // KHR_lights_punctual, Inner and Outer Cone Angles: the squared linear ramp in the cosine.
    const F cone = saturate(neg_mul_add(dot(in.l, direction), F(light.spot_scale), F(light.spot_offset)));
    in.attenuation = in.attenuation * (cone * cone);
  }
  return in;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

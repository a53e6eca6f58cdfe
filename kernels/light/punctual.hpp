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

template <class F>
TESSERA_INLINE Vec3<F> broadcast(const float v[3]) {
  return {F(v[0]), F(v[1]), F(v[2])};
}

/// A light's type and falloff at compile time: the light loop runs without asking. mixed: of several lights, no one of
/// these.
enum class LightKind { directional, point, point_plus_one, spot, spot_plus_one, mixed };
inline constexpr bool is_spot(LightKind kind) { return kind == LightKind::spot || kind == LightKind::spot_plus_one; }
inline constexpr bool is_plus_one(LightKind kind) {
  return kind == LightKind::point_plus_one || kind == LightKind::spot_plus_one;
}
TESSERA_INLINE LightKind kind_of(const LightView& light) {
  if (light.type == LightType::directional) return LightKind::directional;
  const bool plus_one = light.falloff == Falloff::windowed_plus_one;
  if (light.type == LightType::spot) return plus_one ? LightKind::spot_plus_one : LightKind::spot;
  return plus_one ? LightKind::point_plus_one : LightKind::point;
}

/// body.template operator()<kind>(), for a kind that a light has: not mixed.
template <class Body>
TESSERA_INLINE auto with_kind(LightKind kind, const Body& body) {
  switch (kind) {
    case LightKind::directional:
      return body.template operator()<LightKind::directional>();
    case LightKind::point:
      return body.template operator()<LightKind::point>();
    case LightKind::point_plus_one:
      return body.template operator()<LightKind::point_plus_one>();
    case LightKind::spot:
      return body.template operator()<LightKind::spot>();
    default:
      return body.template operator()<LightKind::spot_plus_one>();
  }
}

/// A light as a point sees it before any root is taken: enough to know whether it reaches the point at all.
template <class F>
struct Reach {
  Vec3<F> d;  // towards the light; its length is the distance
  F d2;       // |d|^2
  F window;   // of its range: 0 where the light ends
};

/// What arrives from a light. color * strength / divisor is the irradiance (lux) of a surface that faces it: the
/// division is left to the lobe, which divides anyway.
template <class F>
struct Incident {
  F inverse_length;     // l = d * inverse_length is towards the light, unit
  F strength, divisor;  // divisor >= 1
};

/// position within +-1e12: distances cubed then stay finite.
template <LightKind kind, class F>
TESSERA_INLINE Reach<F> light_reach(const LightView& light, const Vec3<F>& position) {
  Reach<F> reach;
  if constexpr (kind == LightKind::directional) {
    reach.d = -broadcast<F>(light.direction);
    reach.d2 = reach.window = F(1);
  } else {
    reach.d = broadcast<F>(light.position) - position;
    reach.d2 = max(dot(reach.d, reach.d), F(min_distance_squared));
    const F q = reach.d2 * F(light.inverse_range_squared);
    reach.window = max(neg_mul_add(q, q, F(1)), F(0));
  }
  return reach;
}

template <LightKind kind, class F>
TESSERA_INLINE Incident<F> incident_light(const LightView& light, const Reach<F>& reach) {
  Incident<F> in;
  in.inverse_length = in.strength = in.divisor = F(1);
  if constexpr (kind == LightKind::directional) return in;
  in.inverse_length = F(1) / sqrt(reach.d2);
  if constexpr (is_plus_one(kind)) {
    // Karis 2013, Real Shading in Unreal Engine 4, eq. 9: sat(1 - (d/range)^4)^2 / (d^2 + 1).
    in.strength = reach.window * reach.window;
    in.divisor = reach.d2 + F(1);
  } else {
    // KHR_lights_punctual, Range property: max(min(1 - (d/range)^4, 1), 0) / d^2.
    in.strength = reach.window * (in.inverse_length * in.inverse_length);
  }
  if constexpr (is_spot(kind)) {
    // KHR_lights_punctual, Inner and Outer Cone Angles: the squared linear ramp in the cosine.
    const F cosine = dot(reach.d, broadcast<F>(light.direction)) * in.inverse_length;
    const F cone = saturate(neg_mul_add(cosine, F(light.spot_scale), F(light.spot_offset)));
    in.strength = in.strength * (cone * cone);
  }
  return in;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

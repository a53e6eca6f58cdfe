// The light that punctual lights send along the eye's ray: BRDF times irradiance, summed over the lights.
#pragma once
#include "kernels/bsdf/diffuse.hpp"
#include "kernels/bsdf/ggx_lobe.hpp"
#include "kernels/interface.hpp"
#include "kernels/light/punctual.hpp"
#include "kernels/math/approx.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/shade/surface.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Light summed over the lights of one kind of reflection each, before the surface's own colours come in: they are the
/// same for all lights.
template <class F>
struct LightSums {
  Vec3<F> diffuse;   // E (1 - w): weight (1 - F0) albedo / pi
  Vec3<F> specular;  // E D V: weight F0
  Vec3<F> grazing;   // E D V w: weight 1 - F0;  w = (1 - VoH)^5, E = color * irradiance
};

/// What a surface brings into the sums: its place, its orientation to the eye, its roughness.
template <class F>
struct LitPoint {
  Vec3<F> position, n;
  F nv;                  // n.v
  Vec3<F> v_tangential;  // v - n (n.v)
  GGXLobe<F> lobe;
};

/// A light as seen from a point, as far as the root and the division that its distance takes.
template <class F>
struct LightRay {
  Vec3<F> d;                            // towards the light
  F nd;                                 // n.d
  F inverse_length, strength, divisor;  // as in Incident
};

/// Whether the light reaches any lane; only then there is a ray.
template <LightKind kind, class F>
TESSERA_INLINE bool find_ray(const LitPoint<F>& p, const LightView& light, LightRay<F>& ray) {
  if constexpr (kind == LightKind::mixed) {
    ray = {
        {F(0), F(0), F(0)}, F(0), F(0), F(0), F(0)};  // GCC 12 does not see through the lambda that none is used unset
    return with_kind(kind_of(light), [&]<LightKind one>() { return find_ray<one>(p, light, ray); });
  } else {
    const Reach<F> reach = light_reach<kind>(light, p.position);
    const F nd = dot(p.n, reach.d);
    if (!any(min(nd, reach.window) > F(0))) return false;  // behind, or out of range: every lane would add +0
    const Incident<F> in = incident_light<kind>(light, reach);
    ray = {reach.d, nd, in.inverse_length, in.strength, in.divisor};
    return true;
  }
}

template <LightKind kind, class F>
TESSERA_INLINE void add_light(const LitPoint<F>& p, const LightView& light, const LightRay<F>& ray,
                              LightSums<F>& sums) {
  const F nl = ray.nd * ray.inverse_length;
  const F NoL = max(nl, F(0));
  // H = l + v in two parts, along n and beside it. N min(alpha^2 N, N): where n.H < 0, no weight makes the part along n
  // smaller, as clamping NoH to 0 in D's formula does.
  const F N = nl + p.nv;
  const auto beside = [&](F n, F d, F v) { return mul_add(neg_mul_add(n, ray.nd, d), ray.inverse_length, v); };
  const Vec3<F> T = {beside(p.n.x, ray.d.x, p.v_tangential.x), beside(p.n.y, ray.d.y, p.v_tangential.y),
                     beside(p.n.z, ray.d.z, p.v_tangential.z)};
  const F T2 = dot(T, T);
  const F H2 = mul_add(N, N, T2);
  const LobeFraction<F> dv = DV_GGX_fraction(p.lobe, H2, mul_add(N, min(p.lobe.alpha2 * N, N), T2), NoL);

  // |l + v| = 2 cos of half the angle between them.
  const F weight = pow5(neg_mul_add(F(0.5), sqrt(H2), F(1)));
  const F strength = NoL * ray.strength;
  F diffuse, specular;
  if (is_plus_one(kind == LightKind::mixed ? kind_of(light) : kind)) {
    const F quotient = strength / (dv.denominator * ray.divisor);  // strength is at most 2: no overflow
    diffuse = quotient * dv.denominator;
    specular = quotient * dv.numerator;
  } else {
    diffuse = strength;
    specular = strength * (dv.numerator / dv.denominator);
  }
  const F diffuse_part = neg_mul_add(diffuse, weight, diffuse), grazing_part = specular * weight;
  const Vec3<F> color = broadcast<F>(light.color);
  const auto add = [&](Vec3<F>& sum, F part) {
    sum = {mul_add(color.x, part, sum.x), mul_add(color.y, part, sum.y), mul_add(color.z, part, sum.z)};
  };
  add(sums.diffuse, diffuse_part);
  add(sums.specular, specular);
  add(sums.grazing, grazing_part);
}

/// Lights one after another.
struct LightList {
  const LightView* lights;
  const std::uint32_t* indices;  // which of them; null: all
  std::uint32_t count;

  const LightView& operator[](std::uint32_t i) const { return lights[indices != nullptr ? indices[i] : i]; }
};
inline LightKind kind_of(const LightList& lights) {
  if (lights.count == 0) return LightKind::mixed;
  const LightKind kind = kind_of(lights[0]);
  for (std::uint32_t i = 1; i < lights.count; ++i)
    if (kind_of(lights[i]) != kind) return LightKind::mixed;
  return kind;
}

/// kind: kind_of(lights).
template <LightKind kind, class F>
TESSERA_INLINE LightSums<F> sum_lights(const LitPoint<F>& p, const LightList& lights) {
  const Vec3<F> zero = {F(0), F(0), F(0)};
  LightSums<F> sums = {zero, zero, zero};
  if (lights.count == 0) return sums;
  // A light's root and division are started before the light in front of it is added: that one's instructions do not
  // stand behind them.
  LightRay<F> next;
  bool next_lit = find_ray<kind>(p, lights[0], next);
  for (std::uint32_t i = 0; i < lights.count; ++i) {
    const LightRay<F> ray = next;
    const bool lit = next_lit;
    next_lit = i + 1 < lights.count && find_ray<kind>(p, lights[i + 1], next);
    if (lit) add_light<kind>(p, lights[i], ray, sums);
  }
  return sums;
}

/// Radiance towards the eye: the sums, and the surface's colours.
template <class F>
TESSERA_INLINE Vec3<F> reflect_lights(const LightSums<F>& sums, const Reflectance<F>& surface) {
  // (1 - F) lambert + F D V with F = F0 + (1 - F0) w, so that 1 - F = (1 - F0) (1 - w).
  const Vec3<F> lambert = Fd_Lambert(surface.albedo);
  const auto reflect = [&](F f0, F albedo, F diffuse, F specular, F grazing) {
    return mul_add(F(1) - f0, mul_add(albedo, diffuse, grazing), f0 * specular);
  };
  const Vec3<F>& f0 = surface.f0;
  return {reflect(f0.x, lambert.x, sums.diffuse.x, sums.specular.x, sums.grazing.x),
          reflect(f0.y, lambert.y, sums.diffuse.y, sums.specular.y, sums.grazing.y),
          reflect(f0.z, lambert.z, sums.diffuse.z, sums.specular.z, sums.grazing.z)};
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

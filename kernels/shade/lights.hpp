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

template <LightKind kind, class F>
TESSERA_INLINE void add_light(const LitPoint<F>& p, const LightView& light, LightSums<F>& sums) {
  const Reach<F> reach = light_reach<kind>(light, p.position);
  const F nd = dot(p.n, reach.d);
  if (!any(min(nd, reach.window) > F(0))) return;  // behind, or out of range: every lane would add +0

  const Incident<F> in = incident_light<kind>(light, reach);
  const F nl = nd * in.inverse_length;
  const F NoL = clamp(nl, F(0), F(1));
  // H = l + v in two parts, along n and beside it. N min(alpha^2 N, N): where n.H < 0, no weight makes the part along n
  // smaller, as clamping NoH to 0 in D's formula does.
  const F N = nl + p.nv;
  const auto beside = [&](F n, F d, F v) { return mul_add(neg_mul_add(n, nd, d), in.inverse_length, v); };
  const Vec3<F> T = {beside(p.n.x, reach.d.x, p.v_tangential.x), beside(p.n.y, reach.d.y, p.v_tangential.y),
                     beside(p.n.z, reach.d.z, p.v_tangential.z)};
  const F T2 = dot(T, T);
  const F H2 = mul_add(N, N, T2);
  const LobeFraction<F> dv = DV_GGX_fraction(p.lobe, H2, N * min(p.lobe.alpha2 * N, N), T2, NoL);

  // |l + v| = 2 cos of half the angle between them.
  const F weight = pow5(neg_mul_add(F(0.5), sqrt(H2), F(1)));
  const F strength = NoL * in.strength;
  F diffuse, specular;
  if constexpr (is_plus_one(kind)) {
    const F quotient = strength / (dv.denominator * in.divisor);  // strength is at most 1: no overflow
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

/// Over `count` lights, of the list if there is one.
template <class F>
TESSERA_INLINE LightSums<F> sum_lights(const LitPoint<F>& p, const LightView* lights, const std::uint32_t* list,
                                       std::uint32_t count) {
  const Vec3<F> zero = {F(0), F(0), F(0)};
  LightSums<F> sums = {zero, zero, zero};
  for (std::uint32_t i = 0; i < count; ++i) {
    const LightView& light = lights[list != nullptr ? list[i] : i];
    switch (kind_of(light)) {
      case LightKind::directional:
        add_light<LightKind::directional>(p, light, sums);
        break;
      case LightKind::point:
        add_light<LightKind::point>(p, light, sums);
        break;
      case LightKind::point_plus_one:
        add_light<LightKind::point_plus_one>(p, light, sums);
        break;
      case LightKind::spot:
        add_light<LightKind::spot>(p, light, sums);
        break;
      case LightKind::spot_plus_one:
        add_light<LightKind::spot_plus_one>(p, light, sums);
        break;
    }
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

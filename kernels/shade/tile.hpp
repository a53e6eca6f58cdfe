// The shading loop: G-buffer in, radiance out.
//
// Features chooses what is compiled in, never what comes out: a fragment gets the same bits from every instance that
// covers what it uses. Light that is missing adds exactly +0, and the parts are summed in one order.
#pragma once
#include "kernels/bsdf/diffuse.hpp"
#include "kernels/bsdf/energy.hpp"
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/bsdf/ggx_lobe.hpp"
#include "kernels/interface.hpp"
#include "kernels/light/punctual.hpp"
#include "kernels/math/approx.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/shade/environment_options.hpp"
#include "kernels/shade/lookups.hpp"
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

template <LightKind kind, class F>
TESSERA_INLINE void add_light(const ShadingPoint<F>& p, const GGXLobe<F>& lobe, const Vec3<F>& v_tangential,
                              const LightView& light, LightSums<F>& sums) {
  const Reach<F> reach = light_reach<kind>(light, p.position);
  const F nd = dot(p.n, reach.d);
  if (!any((nd > F(0)) & (reach.window > F(0)))) return;  // behind, or out of range: every lane would add +0

  const Incident<F> in = incident_light<kind>(light, reach);
  const F nl = nd * in.inverse_length;
  const F NoL = clamp(nl, F(0), F(1));
  // H = l + v in two parts, along n and beside it. N min(alpha^2 N, N): where n.H < 0, no weight makes the part along n
  // smaller, as clamping NoH to 0 in D's formula does.
  const F N = nl + p.nv;
  const auto beside = [&](F n, F d, F v) { return mul_add(neg_mul_add(n, nd, d), in.inverse_length, v); };
  const Vec3<F> T = {beside(p.n.x, reach.d.x, v_tangential.x), beside(p.n.y, reach.d.y, v_tangential.y),
                     beside(p.n.z, reach.d.z, v_tangential.z)};
  const F T2 = dot(T, T);
  const F H2 = mul_add(N, N, T2);
  const LobeFraction<F> dv = DV_GGX_fraction(lobe, H2, N * min(lobe.alpha2 * N, N), T2, NoL);

  // |l + v| = 2 cos of half the angle between them.
  const F weight = pow5(neg_mul_add(F(0.5), sqrt(H2), F(1)));
  const F strength = NoL * in.strength;
  const F inverse = F(1) / (is_plus_one(kind) ? dv.denominator * in.divisor : dv.denominator);
  const F diffuse = strength * (dv.denominator * inverse);
  const F specular = strength * (dv.numerator * inverse);
  const F diffuse_part = neg_mul_add(diffuse, weight, diffuse), grazing_part = specular * weight;
  const Vec3<F> color = broadcast<F>(light.color);
  const auto add = [&](Vec3<F>& sum, F part) {
    sum = {mul_add(color.x, part, sum.x), mul_add(color.y, part, sum.y), mul_add(color.z, part, sum.z)};
  };
  add(sums.diffuse, diffuse_part);
  add(sums.specular, specular);
  add(sums.grazing, grazing_part);
}

/// Radiance towards the eye from all punctual lights: sum of BRDF * irradiance. beside() is called with each light.
template <class F, class Beside>
TESSERA_INLINE Vec3<F> shade_lights(const ShadingPoint<F>& p, const ShadeArgs& args, const Beside& beside) {
  const F r = max(p.roughness, F(min_punctual_roughness));
  const GGXLobe<F> lobe = ggx_lobe(p.NoV, r * r);
  const Vec3<F> v_tangential = {neg_mul_add(p.n.x, p.nv, p.v.x), neg_mul_add(p.n.y, p.nv, p.v.y),
                                neg_mul_add(p.n.z, p.nv, p.v.z)};
  const Vec3<F> zero = {F(0), F(0), F(0)};
  LightSums<F> sums = {zero, zero, zero};
  for (std::uint32_t i = 0; i < args.light_count; ++i) {
    beside();
    const LightView& light = args.lights[args.light_list != nullptr ? args.light_list[i] : i];
    switch (kind_of(light)) {
      case LightKind::directional:
        add_light<LightKind::directional>(p, lobe, v_tangential, light, sums);
        break;
      case LightKind::point:
        add_light<LightKind::point>(p, lobe, v_tangential, light, sums);
        break;
      case LightKind::point_plus_one:
        add_light<LightKind::point_plus_one>(p, lobe, v_tangential, light, sums);
        break;
      case LightKind::spot:
        add_light<LightKind::spot>(p, lobe, v_tangential, light, sums);
        break;
      case LightKind::spot_plus_one:
        add_light<LightKind::spot_plus_one>(p, lobe, v_tangential, light, sums);
        break;
    }
  }
  // (1 - F) lambert + F D V with F = F0 + (1 - F0) w, so that 1 - F = (1 - F0) (1 - w).
  const Vec3<F> lambert = Fd_Lambert(p.albedo);
  const auto reflect = [&](F f0, F albedo, F diffuse, F specular, F grazing) {
    return mul_add(F(1) - f0, mul_add(albedo, diffuse, grazing), f0 * specular);
  };
  return {reflect(p.f0.x, lambert.x, sums.diffuse.x, sums.specular.x, sums.grazing.x),
          reflect(p.f0.y, lambert.y, sums.diffuse.y, sums.specular.y, sums.grazing.y),
          reflect(p.f0.z, lambert.z, sums.diffuse.z, sums.specular.z, sums.grazing.z)};
}

/// Radiance towards the eye from the environment: Karis 2013's split sum with Fdez-Aguera 2019's compensation.
TESSERA_INLINE Vec3<Float> shade_environment(const ShadingPoint<Float>& p, const EnvironmentLookups& lookups,
                                             const EnvironmentView& environment, const DfgView& dfg) {
  using F = Float;
  const EnvironmentBRDF<F> brdf = lookups.environment_brdf(dfg, p.NoV);
  const EnvironmentSplit<F> split =
      multiple_scattering_FdezAguera(p.f0, brdf.A, brdf.B, schlick_weight(p.NoV), p.roughness);
  const Vec3<F> specular = lookups.specular();
  const Vec3<F> diffuse = irradiance(environment.irradiance_sh, p.n);
  const auto reflect = [&](F single, F multiple, F albedo, F along_R, F around_n) {
    const F transmitted = albedo * (F(1) - single - multiple);
    return mul_add(single, along_R, (multiple + transmitted) * around_n) * p.occlusion;
  };
  return {reflect(split.single.x, split.multiple.x, p.albedo.x, specular.x, diffuse.x),
          reflect(split.single.y, split.multiple.y, p.albedo.y, specular.y, diffuse.y),
          reflect(split.single.z, split.multiple.z, p.albedo.z, specular.z, diffuse.z)};
}

/// Finite and non-negative, whatever the sum became; -0 becomes +0.
template <class F>
TESSERA_INLINE Vec3<F> clamp_radiance(const Vec3<F>& radiance) {
  return {clamp(radiance.x, F(0), F(max_radiance)), clamp(radiance.y, F(0), F(max_radiance)),
          clamp(radiance.z, F(0), F(max_radiance))};
}

/// The planes that every surface is read from.
TESSERA_INLINE void prefetch_surface(const GBufferView& g, std::size_t i) {
  for (int k = 0; k < 3; ++k) {
    prefetch(g.position[k] + i);
    prefetch(g.normal[k] + i);
    prefetch(g.base_color[k] + i);
  }
  prefetch(g.metallic + i);
  prefetch(g.roughness + i);
  prefetch(g.occlusion + i);
}

/// plain: the environment is looked up once along the mirror direction (environment_options.hpp).
template <std::uint32_t Features, bool plain>
inline void shade_tile(const ShadeArgs& args) {
  const GBufferView& g = args.gbuffer;
  for (std::uint32_t i = 0; i < args.count; i += Float::lanes) {
    // A cache line holds sixteen.
    if (args.fetch_ahead != 0 && i % 16 == 0) prefetch_surface(g, std::size_t{i} + args.fetch_ahead);
    const Surface<Float> surface = load_surface(g, i);
    const ShadingPoint<Float> point = shading_point(surface, args.eye);
    Vec3<Float> radiance = {Float(0), Float(0), Float(0)};
    if constexpr ((Features & feature_environment) && plain) {
      EnvironmentLookups lookups(point, args.environment, args.dfg);
      std::uint32_t gathered = 0;
      if constexpr (Features & feature_lights) {
        radiance = shade_lights(point, args, [&] {
          if (gathered < EnvironmentLookups::count) lookups.gather(gathered++);
        });
      }
      while (gathered < EnvironmentLookups::count) lookups.gather(gathered++);
      radiance = radiance + shade_environment(point, lookups, args.environment, args.dfg);
    } else {
      if constexpr (Features & feature_lights) radiance = shade_lights(point, args, [] {});
      if constexpr (Features & feature_environment) radiance = radiance + shade_environment_options(point, args);
    }
    if constexpr (Features & feature_emissive) radiance = radiance + load_clamped(g.emissive, i, 0, max_radiance);
    if constexpr (Features & feature_unlit)
      radiance = select<Float>(load<Float>(g.unlit + i) > Float(0.5), surface.base_color, radiance);
    radiance = clamp_radiance(radiance);
    store(args.radiance[0] + i, radiance.x);
    store(args.radiance[1] + i, radiance.y);
    store(args.radiance[2] + i, radiance.z);
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

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
#include "kernels/light/environment.hpp"
#include "kernels/light/punctual.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/shade/environment_options.hpp"
#include "kernels/shade/surface.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Radiance towards the eye from all punctual lights: sum of BRDF * irradiance.
template <class F>
TESSERA_INLINE Vec3<F> shade_lights(const ShadingPoint<F>& p, const LightView* lights, std::uint32_t count) {
  const F r = max(p.roughness, F(min_punctual_roughness));
  const GGXLobe<F> lobe = ggx_lobe(p.NoV, r * r);
  const Vec3<F> diffuse = Fd_Lambert(p.albedo);
  Vec3<F> radiance = {F(0), F(0), F(0)};
  for (std::uint32_t i = 0; i < count; ++i) {
    const Incident<F> in = incident_light(lights[i], p.position);
    const F nl = dot(p.n, in.l);
    const F NoL = clamp(nl, F(0), F(1));
    const F irradiance = NoL * in.attenuation;
    if (!any(irradiance > F(0))) continue;  // behind, or out of range: every lane would add +0

    const Vec3<F> H = in.l + p.v;
    const F H2 = dot(H, H);
    // Clamping n.H here makes the tangential part all of H where n.H < 0, as clamping NoH to 0 in D's formula does.
    const F NoH = max(nl + p.nv, F(0));
    const Vec3<F> T = {neg_mul_add(p.n.x, NoH, H.x), neg_mul_add(p.n.y, NoH, H.y), neg_mul_add(p.n.z, NoH, H.z)};
    const F DV = DV_GGX(lobe, H2, NoH, dot(T, T), NoL);

    const F VoH = F(0.5) * sqrt(H2);  // |l + v| = 2 cos of half the angle between them
    const F weight = schlick_weight(VoH);
    const auto reflect = [&](F f0, F lambert, float color, F sum) {
      // (1 - fresnel) lambert + fresnel D V
      const F brdf = mul_add(F_SchlickWeighted(f0, weight), DV - lambert, lambert);
      return mul_add(brdf, irradiance * F(color), sum);
    };
    radiance = {reflect(p.f0.x, diffuse.x, lights[i].color[0], radiance.x),
                reflect(p.f0.y, diffuse.y, lights[i].color[1], radiance.y),
                reflect(p.f0.z, diffuse.z, lights[i].color[2], radiance.z)};
  }
  return radiance;
}

/// Radiance towards the eye from the environment: Karis 2013's split sum with Fdez-Aguera 2019's compensation.
template <class F>
TESSERA_INLINE Vec3<F> shade_environment(const ShadingPoint<F>& p, const EnvironmentView& environment,
                                         const DfgView& dfg) {
  F A, B;
  sample_dfg(dfg, p.NoV, p.roughness, A, B);
  const EnvironmentSplit<F> split = multiple_scattering_FdezAguera(p.f0, A, B, schlick_weight(p.NoV), p.roughness);

  const Vec3<F> R = p.n * (p.nv + p.nv) - p.v;
  const Vec3<F> specular = sample_cube(environment.specular, R, p.roughness * F(environment.specular.levels - 1));
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

template <std::uint32_t Features>
inline void shade_tile(const ShadeArgs& args) {
  const GBufferView& g = args.gbuffer;
  for (std::uint32_t i = 0; i < args.count; i += Float::lanes) {
    const Surface<Float> surface = load_surface(g, i);
    const ShadingPoint<Float> point = shading_point(surface, args.eye);
    Vec3<Float> radiance = {Float(0), Float(0), Float(0)};
    if constexpr (Features & feature_lights) radiance = shade_lights(point, args.lights, args.light_count);
    if constexpr (Features & feature_environment)
      radiance = radiance + (is_plain(args.environment_shading, args.environment)
                                 ? shade_environment(point, args.environment, args.dfg)
                                 : shade_environment_options(point, args));
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

// Radiance from the environment with everything that EnvironmentShading and EnvironmentView can ask for. The plain
// form, one lookup along the mirror direction, is in tile.hpp.
#pragma once
#include "kernels/bsdf/dfg_fit.hpp"
#include "kernels/bsdf/energy.hpp"
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/interface.hpp"
#include "kernels/light/environment.hpp"
#include "kernels/math/approx.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/shade/stretch.hpp"
#include "kernels/shade/surface.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Whether shade_environment of tile.hpp has all that is asked for.
inline bool is_plain(const EnvironmentShading& shading, const EnvironmentView& environment) {
  return shading.lobe == EnvironmentLobe::mirror && shading.fresnel == EnvironmentFresnel::roughness &&
         !shading.specular_occlusion && shading.albedo == EnvironmentAlbedo::table && environment.lod_curve == 0.0f &&
         environment.irradiance.texels == nullptr && environment.specular.format == CubeFormat::rgba16_float;
}

/// Occlusion of the specular lobe where `occlusion` of the hemisphere is open. Lagarde and de Rousiers 2014, "Moving
/// Frostbite to PBR", listing 26 (from Gotanda's); their roughness is alpha. In [0, 1].
template <class F>
TESSERA_INLINE F specular_occlusion(F NoV, F occlusion, F alpha) {
  const F exponent = exp2(mul_sub(alpha, F(-16), F(1)));
  return saturate(pow(NoV + occlusion, exponent) - F(1) + occlusion);
}

/// Mean radiance over the specular lobe.
template <class Texels, class F>
TESSERA_INLINE Vec3<F> sample_lobe(const ShadingPoint<F>& p, const EnvironmentView& environment, EnvironmentLobe lobe) {
  switch (lobe) {
    case EnvironmentLobe::taps2:
      return sample_along_axis<Texels, 2>(environment, p);
    case EnvironmentLobe::taps4:
      return sample_along_axis<Texels, 4>(environment, p);
    case EnvironmentLobe::points8:
      return sample_points<Texels>(environment, p);
    default:
      break;
  }
  const Vec3<F> mirrored = p.n * (p.nv + p.nv) - p.v;
  const Vec3<F> axis =
      lobe == EnvironmentLobe::shifted ? dominant_direction(p.n, mirrored, p.roughness * p.roughness) : mirrored;
  return sample_cube<Texels>(environment.specular, axis, specular_level(environment, p.roughness));
}

/// A and B of the environment BRDF.
template <class F>
TESSERA_INLINE EnvironmentBRDF<F> environment_albedo(const ShadingPoint<F>& p, const DfgView& dfg,
                                                     EnvironmentAlbedo form) {
  if (form == EnvironmentAlbedo::table) {
    EnvironmentBRDF<F> brdf;
    sample_dfg(dfg, p.NoV, p.roughness, brdf.A, brdf.B);
    return brdf;
  }
  const EnvironmentFit<F> fitted =
      form == EnvironmentAlbedo::fit ? dfg_fit(p.NoV, p.roughness) : dfg_fit_small(p.NoV, p.roughness);
  return {fitted.A, fitted.B};
}

/// Radiance towards the eye from the environment: split sum (Karis 2013) with Fdez-Aguera 2019's compensation. Not
/// inlined: one copy for each format of the cube serves all feature sets.
template <class Texels, class F>
[[gnu::noinline]] Vec3<F> shade_environment_stored_as(const ShadingPoint<F>& p, const ShadeArgs& args) {
  const EnvironmentShading& shading = args.environment_shading;
  const EnvironmentBRDF<F> brdf = environment_albedo(p, args.dfg, shading.albedo);
  // Without the grazing weight, kS is F0.
  const F weight = shading.fresnel == EnvironmentFresnel::f0 ? F(0) : schlick_weight(p.NoV);
  const EnvironmentSplit<F> split = multiple_scattering_FdezAguera(p.f0, brdf.A, brdf.B, weight, p.roughness);

  const F open =
      shading.specular_occlusion ? specular_occlusion(p.NoV, p.occlusion, p.roughness * p.roughness) : p.occlusion;
  const Vec3<F> specular = sample_lobe<Texels>(p, args.environment, shading.lobe) * open;
  const Vec3<F> diffuse = (args.environment.irradiance.texels ? sample_cube_uniform(args.environment.irradiance, p.n, 0)
                                                              : irradiance(args.environment.irradiance_sh, p.n)) *
                          p.occlusion;
  const auto reflect = [&](F single, F multiple, F albedo, F along, F around_n) {
    const F transmitted = albedo * (F(1) - single - multiple);
    return mul_add(single, along, (multiple + transmitted) * around_n);
  };
  return {reflect(split.single.x, split.multiple.x, p.albedo.x, specular.x, diffuse.x),
          reflect(split.single.y, split.multiple.y, p.albedo.y, specular.y, diffuse.y),
          reflect(split.single.z, split.multiple.z, p.albedo.z, specular.z, diffuse.z)};
}

template <class F>
TESSERA_INLINE Vec3<F> shade_environment_options(const ShadingPoint<F>& p, const ShadeArgs& args) {
  return args.environment.specular.format == CubeFormat::rgb9_e5 ? shade_environment_stored_as<Rgb9e5Texels>(p, args)
                                                                 : shade_environment_stored_as<HalfTexels>(p, args);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

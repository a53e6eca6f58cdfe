// Light from the environment with everything that EnvironmentShading and EnvironmentView can ask for, as stages. The
// plain form, one lookup along the mirror direction, is in stages.hpp and tile.hpp.
#pragma once
#include "kernels/bsdf/dfg_fit.hpp"
#include "kernels/bsdf/energy.hpp"
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/interface.hpp"
#include "kernels/light/environment.hpp"
#include "kernels/math/approx.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/shade/stages.hpp"
#include "kernels/shade/stretch.hpp"
#include "kernels/shade/surface.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Whether the plain form has all that is asked for.
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

/// What the stages of a block leave beside what the plain form needs.
struct OptionsBlock {
  // LobeView; the rest of it is cheap.
  alignas(64) float tangent[3][block_size], sin_v[block_size], hx[block_size], hz[block_size], root_v[block_size];
  alignas(64) float lx[block_size], ly[block_size], lz[block_size], alpha[block_size];  // LobePoint
  alignas(64) float level[block_size], weight[block_size], sum[block_size];  // of a tap; of the taps' weights
};

// ------------------------------------------------------------------------------------------------- specular lobe

template <class F>
[[gnu::noinline]] void find_lobe(const Block& block, OptionsBlock& options) {
  for (int i = 0; i < block.count; i += F::lanes) {
    const LobeView<F> w = lobe_view(load_vector<F>(block.n, i), load_vector<F>(block.v, i), load<F>(block.nv + i),
                                    load<F>(block.roughness + i));
    store_vector(options.tangent, i, w.tangent);
    store(options.sin_v + i, w.sin_v);
    store(options.hx + i, w.hx);
    store(options.hz + i, w.hz);
    store(options.root_v + i, w.root_v);
  }
}
template <class F>
TESSERA_INLINE LobeView<F> load_lobe(const Block& block, const OptionsBlock& options, int i) {
  const F r = load<F>(block.roughness + i);
  return {load_vector<F>(block.n, i),
          load_vector<F>(options.tangent, i),
          clamp_NoV(load<F>(block.nv + i)),
          load<F>(options.sin_v + i),
          r * r,
          load<F>(options.hx + i),
          load<F>(options.hz + i),
          load<F>(options.root_v + i)};
}

/// Point k of the lobe. What follows from it is a stage of its own, as its root and division stand in the way.
template <class Taps, class F>
[[gnu::noinline]] void find_point(int k, const Block& block, OptionsBlock& options) {
  for (int i = 0; i < block.count; i += F::lanes) {
    const LobePoint<F> point = lobe_point(Taps(), load_lobe<F>(block, options, i), k);
    store(options.lx + i, point.lx);
    store(options.ly + i, point.ly);
    store(options.lz + i, point.lz);
    store(options.alpha + i, point.alpha);
  }
}

/// Where the tap at that point meets the cube.
template <class Taps, class F>
[[gnu::noinline]] void find_tap(const EnvironmentView& environment, int k, Block& block, OptionsBlock& options) {
  const int faces = cube_face_texels(environment.specular.size, environment.specular.levels);
  for (int i = 0; i < block.count; i += F::lanes) {
    const LobePoint<F> point = {load<F>(options.lx + i), load<F>(options.ly + i), load<F>(options.lz + i),
                                load<F>(options.alpha + i)};
    const Tap<F> tap = tap_at(Taps(), load_lobe<F>(block, options, i), point, k);
    store_point(block, i, cube_point_of_any(tap.axis, faces));
    store(options.level + i, specular_level(environment, tap.r));
    store(options.weight + i, tap.weight);
  }
}

/// The same of the one lookup of other lobes.
template <class F>
[[gnu::noinline]] void find_axis(const EnvironmentView& environment, EnvironmentLobe lobe, Block& block,
                                 OptionsBlock& options) {
  const int faces = cube_face_texels(environment.specular.size, environment.specular.levels);
  for (int i = 0; i < block.count; i += F::lanes) {
    const Vec3<F> n = load_vector<F>(block.n, i);
    const F nv = load<F>(block.nv + i), r = load<F>(block.roughness + i);
    const Vec3<F> mirrored = n * (nv + nv) - load_vector<F>(block.v, i);
    store_point(
        block, i,
        cube_point_of_any(lobe == EnvironmentLobe::shifted ? dominant_direction(n, mirrored, r * r) : mirrored, faces));
    store(options.level + i, specular_level(environment, r));
  }
}

template <class Texels, class F>
[[gnu::noinline]] void find_lookup(const CubeView& cube, Block& block, const OptionsBlock& options) {
  for (int i = 0; i < block.count; i += F::lanes)
    find_footprint<Texels>(cube, clamp_level(cube, load<F>(options.level + i)), i, block);
}

/// Adds a tap to the lobe's mean; with the last one it is complete.
template <class Texels>
[[gnu::noinline]] void read_tap(const CubeView& cube, bool first, bool last, Block& block, OptionsBlock& options) {
  for (int i = 0; i < block.count; i += Float::lanes) {
    const Vec3<Float> fine = read_footprint(Texels{}, cube, block.cube_fine, i);
    const Vec3<Float> radiance = fine + read_footprint(Texels{}, cube, block.cube_coarse, i);
    const Float weight = load<Float>(options.weight + i);
    Vec3<Float> sum = radiance * weight;
    Float weights = weight;
    if (!first) {
      const Vec3<Float> before = load_vector<Float>(block.specular, i);
      sum = {mul_add(weight, radiance.x, before.x), mul_add(weight, radiance.y, before.y),
             mul_add(weight, radiance.z, before.z)};
      weights = load<Float>(options.sum + i) + weight;
    }
    if (last)
      sum = sum * (Float(1) / max(weights, Float(1e-20)));  // all below the horizon: black
    else
      store(options.sum + i, weights);
    store_vector(block.specular, i, sum);
  }
}

/// Mean radiance over the specular lobe, from taps.
template <class Texels, class Taps>
inline void sample_taps(const EnvironmentView& environment, Block& block, OptionsBlock& options) {
  find_lobe<Wide>(block, options);
  for (int k = 0; k < Taps::taps; ++k) {
    find_point<Taps, Wide>(k, block, options);
    find_tap<Taps, Wide>(environment, k, block, options);
    find_lookup<Texels, Wide>(environment.specular, block, options);
    read_tap<Texels>(environment.specular, k == 0, k == Taps::taps - 1, block, options);
  }
}

/// Mean radiance over the specular lobe.
template <class Texels>
inline void sample_lobe(const ShadeArgs& args, Block& block, OptionsBlock& options) {
  const EnvironmentView& environment = args.environment;
  const EnvironmentLobe lobe = args.environment_shading.lobe;
  if (lobe == EnvironmentLobe::taps2) return sample_taps<Texels, AxisTaps<2>>(environment, block, options);
  if (lobe == EnvironmentLobe::taps4) return sample_taps<Texels, AxisTaps<4>>(environment, block, options);
  if (lobe == EnvironmentLobe::points8) return sample_taps<Texels, DiscTaps>(environment, block, options);
  find_axis<Wide>(environment, lobe, block, options);
  find_lookup<Texels, Wide>(environment.specular, block, options);
  read_cube<Texels>(args, block);
}

// ------------------------------------------------------------------------------------------------------ the rest

/// A and B of the environment BRDF, without a table.
[[gnu::noinline]] inline void fit_dfg(EnvironmentAlbedo form, Block& block) {
  for (int i = 0; i < block.count; i += Float::lanes) {
    const Float NoV = clamp_NoV(load<Float>(block.nv + i)), r = load<Float>(block.roughness + i);
    const EnvironmentFit<Float> fitted = form == EnvironmentAlbedo::fit ? dfg_fit(NoV, r) : dfg_fit_small(NoV, r);
    store(block.A + i, fitted.A);
    store(block.B + i, fitted.B);
  }
}

/// Irradiance from a cube: its level 0.
[[gnu::noinline]] inline void read_irradiance(const CubeView& cube, Block& block) {
  for (int i = 0; i < block.count; i += Float::lanes)
    store_vector(block.irradiance, i, sample_cube_uniform(cube, load_vector<Float>(block.n, i), 0));
}

/// Everything that shade_environment_options() reads.
inline void sample_environment_options(const ShadeArgs& args, Block& block, OptionsBlock& options) {
  const EnvironmentView& environment = args.environment;
  if (args.environment_shading.albedo == EnvironmentAlbedo::table) {
    find_dfg_footprints<Wide>(args, block);
    read_dfg(args, block);
  } else {
    fit_dfg(args.environment_shading.albedo, block);
  }
  if (environment.specular.format == CubeFormat::rgb9_e5)
    sample_lobe<Rgb9e5Texels>(args, block, options);
  else
    sample_lobe<HalfTexels>(args, block, options);
  if (environment.irradiance.texels != nullptr)
    read_irradiance(environment.irradiance, block);
  else
    find_irradiance(block);
}

/// Radiance towards the eye from the environment: split sum (Karis 2013) with Fdez-Aguera 2019's compensation. i counts
/// the block's fragments.
template <bool lights>
TESSERA_INLINE Vec3<Float> shade_environment_options(const ShadeArgs& args, const Block& block, int i) {
  const EnvironmentShading& shading = args.environment_shading;
  const std::uint32_t at = block.first + std::uint32_t(i);
  const Reflectance<Float> surface = block_reflectance<lights, Float>(args.gbuffer, block, i);
  const Float NoV = clamp_NoV(load<Float>(block.nv + i)), r = load<Float>(block.roughness + i);
  // Without the grazing weight, kS is F0.
  const Float weight = shading.fresnel == EnvironmentFresnel::f0 ? Float(0) : schlick_weight(NoV);
  const EnvironmentSplit<Float> split =
      multiple_scattering_FdezAguera(surface.f0, load<Float>(block.A + i), load<Float>(block.B + i), weight, r);
  const Float occlusion = load<Float>(args.gbuffer.occlusion + at);
  const Float open = shading.specular_occlusion ? specular_occlusion(NoV, occlusion, r * r) : occlusion;
  const Vec3<Float> specular = load_vector<Float>(block.specular, i) * open;
  const Vec3<Float> diffuse = load_vector<Float>(block.irradiance, i) * occlusion;
  const auto reflect = [&](Float single, Float all, Float albedo, Float along, Float around_n) {
    return mul_add(single, along, irradiance_weight(single, all, albedo) * around_n);
  };
  return {reflect(split.single.x, split.all.x, surface.albedo.x, specular.x, diffuse.x),
          reflect(split.single.y, split.all.y, surface.albedo.y, specular.y, diffuse.y),
          reflect(split.single.z, split.all.z, surface.albedo.z, specular.z, diffuse.z)};
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// The shading loop: G-buffer in, radiance out.
//
// Features chooses what is compiled in, never what comes out: a fragment gets the same bits from every instance that
// covers what it uses. Light that is missing adds exactly +0, and the parts are summed in one order.
#pragma once
#include "kernels/bsdf/energy.hpp"
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/interface.hpp"
#include "kernels/light/environment.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/shade/environment_options.hpp"
#include "kernels/shade/film.hpp"
#include "kernels/shade/stages.hpp"
#include "kernels/shade/surface.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Adds the radiance towards the eye from the environment: Karis 2013's split sum with Fdez-Aguera 2019's compensation.
/// i counts the block's fragments.
template <bool lights, class F>
TESSERA_INLINE void add_environment(const GBufferView& g, const Block& block, int i, Vec3<F>& radiance) {
  const std::uint32_t at = block.first + std::uint32_t(i);
  const Reflectance<F> surface = block_reflectance<lights, F>(g, block, i);
  const F weight = schlick_weight(clamp_NoV(load<F>(block.nv + i)));
  const EnvironmentSplit<F> split = multiple_scattering_FdezAguera(
      surface.f0, load<F>(block.A + i), load<F>(block.B + i), weight, load<F>(block.roughness + i));
  const Vec3<F> specular = load_vector<F>(block.specular, i);
  const Vec3<F> diffuse = load_vector<F>(block.irradiance, i);
  const F occlusion = load<F>(g.occlusion + at);
  const auto reflect = [&](F single, F all, F albedo, F along_R, F around_n, F& sum) {
    const F around = irradiance_weight(single, all, albedo) * around_n;
    sum = mul_add(mul_add(single, along_R, around), occlusion, sum);
  };
  reflect(split.single.x, split.all.x, surface.albedo.x, specular.x, diffuse.x, radiance.x);
  reflect(split.single.y, split.all.y, surface.albedo.y, specular.y, diffuse.y, radiance.y);
  reflect(split.single.z, split.all.z, surface.albedo.z, specular.z, diffuse.z, radiance.z);
}

/// The last stage: all that a block sends to the eye, summed.
template <std::uint32_t Features, bool plain, class F>
inline void finish(const ShadeArgs& args, const Block& block) {
  constexpr bool lights = (Features & feature_lights) != 0;
  const GBufferView g = args.gbuffer;
  const FilmWriter film(args.film);
  for (int i = 0; i < block.count; i += F::lanes) {
    const std::uint32_t at = block.first + std::uint32_t(i);
    // A cache line holds sixteen.
    if (args.fetch_ahead != 0 && i % 16 == 0) prefetch_surface(g, std::size_t{at} + args.fetch_ahead);
    Vec3<F> radiance = {F(0), F(0), F(0)};
    if constexpr (lights) radiance = load_vector<F>(block.lit, i);
    if constexpr ((Features & feature_environment) && plain)
      add_environment<lights>(g, block, i, radiance);
    else if constexpr (Features & feature_environment)
      radiance = radiance + shade_environment_options<lights>(args, block, i);
    if constexpr (Features & feature_emissive) radiance = radiance + load_vector<F>(g.emissive, at);
    if constexpr (Features & feature_unlit)
      radiance = select<F>(load<F>(g.unlit + at) > F(0.5), load_vector<F>(g.base_color, at), radiance);
    radiance = clamp_radiance(radiance);
    if (film) {
      film.store(at, radiance);
    } else {
      store(args.radiance[0] + at, radiance.x);
      store(args.radiance[1] + at, radiance.y);
      store(args.radiance[2] + at, radiance.z);
    }
  }
}

/// plain: the environment is looked up once along the mirror direction (environment_options.hpp). light_count, and not
/// that of args, says how many lights there are for these fragments.
template <std::uint32_t Features, bool plain>
inline void shade_tile(const ShadeArgs& args, std::uint32_t light_count) {
  constexpr bool lights = Features & feature_lights, environment = Features & feature_environment;
  constexpr bool mirror = environment && plain;
  const LightList list = {args.lights, args.light_list, light_count};
  const LightKind kind = lights ? kind_of(list) : LightKind::mixed;
  Block block;
  set_eye(args, block);
  if constexpr (environment)
    for (int c = 0; c < 3; ++c) block.harmonics[c] = irradiance_polynomial<float>(args.environment.irradiance_sh, c);
  OptionsBlock options;
  for (std::uint32_t first = 0; first < args.count; first += block_size) {
    const int left = static_cast<int>(args.count - first);
    start_block(args.gbuffer, first, min(block_size, (left + Wide::lanes - 1) / Wide::lanes * Wide::lanes), block);
    if constexpr (lights || environment) find_directions<mirror>(args, block);
    if constexpr (mirror) {
      find_footprints<Wide>(args, block);
      find_irradiance(block);
      read_dfg(args, block);
    } else if constexpr (environment) {
      sample_environment_options(args, block, options);
    }
    if constexpr (lights) shade_lights<environment, mirror>(args, list, kind, block);
    if constexpr (mirror) read_cube<HalfTexels>(args, block);
    if constexpr (plain)
      finish<Features, plain, Wide>(args, block);
    else
      finish<Features, plain, Float>(args, block);
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

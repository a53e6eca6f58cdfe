// Shading in stages. A tile is shaded a block of fragments at a time, and each stage goes over the whole block before
// the next begins, leaving in memory what that needs. All of a fragment's shading is a chain of over a thousand
// instructions that mostly wait for each other, and a core looks for independent ones among the next sixty or so: in a
// stage's short loop it finds those of the fragments that follow.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/light/environment.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/shade/lights.hpp"
#include "kernels/shade/surface.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

inline constexpr int block_size = 64;
static_assert(block_size % Wide::lanes == 0);

/// Bilinear footprints of a block's fragments on a cube.
struct Footprints {
  alignas(64) std::int32_t texel[block_size];  // BilinearFootprint::above
  alignas(64) float weight[4][block_size];

  template <class F>
  TESSERA_INLINE void set(int i, const BilinearFootprint<F>& f) {
    store(texel + i, f.above);
    store(weight[0] + i, f.w00);
    store(weight[1] + i, f.w01);
    store(weight[2] + i, f.w10);
    store(weight[3] + i, f.w11);
  }
  /// Half texels themselves: two in the footprint's upper row, two in the lower one.
  TESSERA_INLINE void gather(int i, const CubeView& cube, Float (&above)[4], Float (&below)[4]) const {
    gather_quads(words(cube), texel + i, 2 * std::ptrdiff_t{cube_pitch(cube.size, cube.levels)}, above, below);
  }
  /// Asks for the half texels of the lanes from i on.
  TESSERA_INLINE void prefetch(int i, int lanes, const CubeView& cube) const {
    const float* const above = words(cube);
    const float* const below = above + 2 * std::ptrdiff_t{cube_pitch(cube.size, cube.levels)};
    for (int k = i; k < i + lanes; ++k) {
      tessera::TESSERA_ISA::prefetch(above + std::ptrdiff_t{2} * texel[k]);
      tessera::TESSERA_ISA::prefetch(below + std::ptrdiff_t{2} * texel[k]);
    }
  }
  static const float* words(const CubeView& cube) { return reinterpret_cast<const float*>(cube.texels); }
  TESSERA_INLINE BilinearFootprint<Float> weights(int i) const {
    BilinearFootprint<Float> f;
    f.w00 = load<Float>(weight[0] + i);
    f.w01 = load<Float>(weight[1] + i);
    f.w10 = load<Float>(weight[2] + i);
    f.w11 = load<Float>(weight[3] + i);
    return f;
  }
};

/// Of a block's fragments on the environment BRDF's table.
struct DfgFootprints {
  alignas(64) std::int32_t node[block_size], below[block_size];
  alignas(64) float right[block_size];

  template <class F>
  TESSERA_INLINE void set(int i, const DfgFootprint<F>& f) {
    store(node + i, f.node);
    store(below + i, f.below);
    store(right + i, f.right);
  }
};

/// Some fragments of a tile on their way through the stages.
struct Block {
  // The same for all blocks of a call.
  float eye[4];                              // ShadeArgs::eye, in the range of positions
  IrradiancePolynomial<float> harmonics[3];  // of the environment

  std::uint32_t first;  // of the tile's fragments
  int count;            // a multiple of Wide::lanes; there may be fewer fragments in the last lanes

  // Of the G-buffer, from `first` on.
  const float *n[3], *roughness;

  // What each stage leaves. On multiples of 256 bytes, as planes of a G-buffer are: then a load never agrees in its
  // last twelve bits with a store of an iteration before, for which a core might take it.
  alignas(256) float v[3][block_size], nv[block_size];         // towards the eye, unit; n.v
  alignas(64) float f0[3][block_size], albedo[3][block_size];  // Reflectance; where there are lights
  alignas(64) std::int32_t cube_face[block_size];              // CubePoint
  alignas(64) float cube_s[block_size], cube_t[block_size];
  Footprints cube_fine, cube_coarse;
  DfgFootprints dfg;
  alignas(64) float A[block_size], B[block_size];  // EnvironmentBRDF
  alignas(64) float lit[3][block_size];            // radiance of punctual lights
  alignas(64) float irradiance[3][block_size];     // E(n) / pi
  alignas(64) float specular[3][block_size];       // prefiltered radiance, its mean over the lobe
};

TESSERA_INLINE void set_eye(const ShadeArgs& args, Block& block) {
  for (int k = 0; k < 3; ++k) block.eye[k] = clamp(args.eye[k], float(-max_coordinate), float(max_coordinate));
  block.eye[3] = args.eye[3];
}
TESSERA_INLINE void start_block(const GBufferView& g, std::uint32_t first, int count, Block& block) {
  block.first = first;
  block.count = count;
  for (int k = 0; k < 3; ++k) block.n[k] = g.normal[k] + first;
  block.roughness = g.roughness + first;
}

template <class F>
TESSERA_INLINE Vec3<F> load_vector(const float (&planes)[3][block_size], int i) {
  return {load<F>(planes[0] + i), load<F>(planes[1] + i), load<F>(planes[2] + i)};
}
template <class F>
TESSERA_INLINE void store_vector(float (&planes)[3][block_size], int i, const Vec3<F>& x) {
  store(planes[0] + i, x.x);
  store(planes[1] + i, x.y);
  store(planes[2] + i, x.z);
}

template <class F>
TESSERA_INLINE void store_point(Block& block, int i, const CubePoint<F>& point) {
  store(block.cube_face + i, point.face);
  store(block.cube_s + i, point.s);
  store(block.cube_t + i, point.t);
}

/// As the stage of the lights left it, or, without lights, from the planes.
template <bool lights, class F>
TESSERA_INLINE Reflectance<F> block_reflectance(const GBufferView& g, const Block& block, int i) {
  if constexpr (lights) return {load_vector<F>(block.f0, i), load_vector<F>(block.albedo, i)};
  return load_reflectance<F>(g, block.first + std::uint32_t(i));
}

/// Towards the eye, for the fragments from i on; and, if asked for, where the mirror direction meets the cube.
template <bool mirror, class F>
TESSERA_INLINE void find_direction(const GBufferView& g, const float (&eye)[4], int faces, int i, Block& block) {
  const Vec3<F> n = load_vector<F>(block.n, i);
  const Vec3<F> eyewards = to_eye(load_vector<F>(g.position, block.first + std::uint32_t(i)), eye);
  const F along_n = dot(n, eyewards);
  if constexpr (mirror) {
    // Of any length: this does not wait for v.
    const F twice = along_n + along_n;
    const Vec3<F> mirrored = {mul_sub(n.x, twice, eyewards.x), mul_sub(n.y, twice, eyewards.y),
                              mul_sub(n.z, twice, eyewards.z)};
    store_point(block, i, cube_point(mirrored, faces));
  }
  // A point within a micrometre of the eye has a shorter v.
  const F inverse_length = F(1) / sqrt(max(dot(eyewards, eyewards), F(1e-12)));
  store_vector(block.v, i, eyewards * inverse_length);
  store(block.nv + i, along_n * inverse_length);
}
/// Of all fragments. A root and two divisions one after the other: two vectors side by side even where others go alone.
template <bool mirror>
[[gnu::noinline]] void find_directions(const ShadeArgs& args, Block& block) {
  const GBufferView g = args.gbuffer;
  const float eye[4] = {block.eye[0], block.eye[1], block.eye[2], block.eye[3]};
  const CubeView& cube = args.environment.specular;
  const int faces = mirror ? cube_face_texels(cube.size, cube.levels) : 0;
  int i = 0;
  for (; i + Pair<Float>::lanes <= block.count; i += Pair<Float>::lanes)
    find_direction<mirror, Pair<Float>>(g, eye, faces, i, block);
  if (i < block.count) find_direction<mirror, Float>(g, eye, faces, i, block);
}

// -------------------------------------------------------------------------------------------------- environment

template <class F>
TESSERA_INLINE DfgPosition<F> block_dfg_position(const DfgView& dfg, const Block& block, int i) {
  return dfg_position(dfg, clamp_NoV(load<F>(block.nv + i)), load<F>(block.roughness + i));
}
template <class F>
[[gnu::noinline]] void find_dfg_footprints(const ShadeArgs& args, Block& block) {
  const DfgView dfg = args.dfg;
  for (int i = 0; i < block.count; i += F::lanes)
    block.dfg.set(i, dfg_footprint(dfg, block_dfg_position<F>(dfg, block, i)));
}

/// Of the block's point of the cube, for the fragments from i on.
template <class Texels, class F>
TESSERA_INLINE void find_footprint(const CubeView& cube, F level, int i, Block& block) {
  const CubePoint<F> point = {load_int<IntOf<F>>(block.cube_face + i), load<F>(block.cube_s + i),
                              load<F>(block.cube_t + i)};
  const CubeLookup<F> lookup = cube_lookup<Texels>(cube, point, level);
  block.cube_fine.set(i, lookup.fine);
  block.cube_coarse.set(i, lookup.coarse);
}

/// On the table, and on the cube by roughness.
template <class F>
[[gnu::noinline]] void find_footprints(const ShadeArgs& args, Block& block) {
  const CubeView cube = args.environment.specular;
  const DfgView dfg = args.dfg;
  for (int i = 0; i < block.count; i += F::lanes) {
    // Roots and a division: the cube's footprints are something to do until they are there.
    const DfgPosition<F> at = block_dfg_position<F>(dfg, block, i);
    find_footprint<HalfTexels>(cube, load<F>(block.roughness + i) * F(cube.levels - 1), i, block);
    block.dfg.set(i, dfg_footprint(dfg, at));
  }
}

/// From the harmonics, a channel at a time: its constants stay in registers.
[[gnu::noinline]] inline void find_irradiance(Block& block) {
  for (int c = 0; c < 3; ++c) {
    const IrradiancePolynomial<Float> p = broadcast<Float>(block.harmonics[c]);
    for (int i = 0; i < block.count; i += Float::lanes)
      store(block.irradiance[c] + i, irradiance(p, load_vector<Float>(block.n, i)));
  }
}

[[gnu::noinline]] inline void read_dfg(const ShadeArgs& args, Block& block) {
  const DfgView dfg = args.dfg;
  for (int i = 0; i < block.count; i += Float::lanes) {
    Float words[4];
    gather_quads(dfg_origin(dfg), block.dfg.node + i, words);
    const Float NoV = clamp_NoV(load<Float>(block.nv + i));
    const EnvironmentBRDF<Float> read =
        blend_dfg(load_int<Int>(block.dfg.below + i), load<Float>(block.dfg.right + i), words);
    // In either case at once: joined, the two would pass through the stack (GCC 12).
    const auto leave = [&](const EnvironmentBRDF<Float>& brdf) {
      store(block.A + i, brdf.A);
      store(block.B + i, brdf.B);
    };
    if (dfg.warped)
      leave(DfgWarpedAxes::value(read.A, read.B, NoV));
    else
      leave(read);
  }
}

/// Radiance in a level of the cube.
TESSERA_INLINE Vec3<Float> read_footprint(HalfTexels, const CubeView& cube, const Footprints& footprints, int i) {
  Float above[4], below[4];
  footprints.gather(i, cube, above, below);
  return blend(footprints.weights(i), decode_texels(above), decode_texels(below));
}
TESSERA_INLINE Vec3<Float> read_footprint(Rgb9e5Texels texels, const CubeView& cube, const Footprints& footprints,
                                          int i) {
  const Int above = load_int<Int>(footprints.texel + i), below = above + Int(cube_pitch(cube.size, cube.levels));
  return blend(footprints.weights(i), cube_texels<Float>(texels, cube, above), cube_texels<Float>(texels, cube, below));
}

template <class Texels>
[[gnu::noinline]] void read_cube(const ShadeArgs& args, Block& block) {
  const CubeView cube = args.environment.specular;
  for (int i = 0; i < block.count; i += Float::lanes) {
    const Vec3<Float> fine = read_footprint(Texels{}, cube, block.cube_fine, i);
    store_vector(block.specular, i, fine + read_footprint(Texels{}, cube, block.cube_coarse, i));
  }
}

// -------------------------------------------------------------------------------------------------------- lights

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

/// environment: its light comes after this, mirror: by reading the cube at the block's footprints. kind:
/// kind_of(lights).
template <bool environment, bool mirror, LightKind kind>
[[gnu::noinline]] void shade_lights(const ShadeArgs& args, const LightList& lights, Block& block) {
  const GBufferView g = args.gbuffer;
  const CubeView cube = args.environment.specular;
  for (int i = 0; i < block.count; i += Float::lanes) {
    const std::uint32_t at = block.first + std::uint32_t(i);
    LitPoint<Float> p;
    p.position = load_vector<Float>(g.position, at);
    p.n = load_vector<Float>(block.n, i);
    const Vec3<Float> v = load_vector<Float>(block.v, i);
    p.nv = load<Float>(block.nv + i);
    p.v_tangential = {neg_mul_add(p.n.x, p.nv, v.x), neg_mul_add(p.n.y, p.nv, v.y), neg_mul_add(p.n.z, p.nv, v.z)};
    const Float r = max(load<Float>(block.roughness + i), Float(min_punctual_roughness));
    p.lobe = ggx_lobe(clamp_NoV(p.nv), r * r);
    // Of the stages, this one leaves the load ports idle; texels of the finer level mostly come from far away.
    if constexpr (mirror) block.cube_fine.prefetch(i, Float::lanes, cube);
    const LightSums<Float> sums = sum_lights<kind>(p, lights);
    const Reflectance<Float> surface = load_reflectance<Float>(g, at);
    if constexpr (environment) {
      store_vector(block.f0, i, surface.f0);
      store_vector(block.albedo, i, surface.albedo);
    }
    store_vector(block.lit, i, reflect_lights(sums, surface));
  }
}

template <bool environment, bool mirror>
TESSERA_INLINE void shade_lights(const ShadeArgs& args, const LightList& lights, LightKind kind, Block& block) {
  if (kind == LightKind::mixed) return shade_lights<environment, mirror, LightKind::mixed>(args, lights, block);
  with_kind(kind, [&]<LightKind one>() { shade_lights<environment, mirror, one>(args, lights, block); });
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

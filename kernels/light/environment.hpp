// Image-based light at a point: radiance from a cubemap with mips, irradiance from spherical harmonics, and the
// environment BRDF from its table.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/light/cube_texels.hpp"
#include "kernels/light/dfg_lookup.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Where a direction meets the cube: `faces` times the face's number, and sc/ma, tc/ma in [-1, 1] (OpenGL 4.6, table
/// 8.19; ties go to x, then y), which rounding may leave by 2^-23. No footprint minds: they reach half a texel further.
template <class F>
struct CubePoint {
  IntOf<F> face;
  F s, t;
};

/// d finite, up to 1e37.
template <class F>
TESSERA_INLINE CubePoint<F> cube_point(const Vec3<F>& d, int faces = 1) {
  using I = IntOf<F>;
  const F ax = abs(d.x), ay = abs(d.y), az = abs(d.z);
  const auto major_x = (ax >= ay) & (ax >= az);
  const auto major_y = ay >= az;
  const F axis = select(major_x, d.x, select(major_y, d.y, d.z));
  const auto negative = axis < F(0);
  // +X: (-z, -y)   -X: (z, -y)   +Y: (x, z)   -Y: (x, -z)   +Z: (x, -y)   -Z: (-x, -y)
  const F z_or_minus_z = select(negative, d.z, -d.z);
  const F sc = select(major_x, z_or_minus_z, select(major_y | !negative, d.x, -d.x));
  const F tc = select(major_x | !major_y, -d.y, -z_or_minus_z);
  const F scale = F(1) / max(abs(axis), F(1e-30));  // d = 0 is in the middle of a face
  const I first = select(major_x, I(0), select(major_y, I(2 * faces), I(4 * faces)));
  return {select(negative, first + I(faces), first), sc * scale, tc * scale};
}

/// Any bits give a point of the cube.
template <class F>
TESSERA_INLINE CubePoint<F> cube_point_of_any(const Vec3<F>& d, int faces = 1) {
  const CubePoint<F> p = cube_point(d, faces);
  return {p.face, clamp(p.s, F(-1), F(1)), clamp(p.t, F(-1), F(1))};
}

template <class F>
inline constexpr int mantissa_bits = 23;
template <>
inline constexpr int mantissa_bits<double> = 52;

/// Two texels of a row, the two below them, and what each counts for.
template <class F>
struct BilinearFootprint {
  IntOf<F> above;  // index of the left one; those below are a row on
  F w00, w01, w10, w11;
};

/// A place in a level, in texels from the centre of the border's first one.
template <class F>
struct LevelPoint {
  F x, y;
};
/// In a level of 2 half texels along a face.
template <class F>
TESSERA_INLINE LevelPoint<F> level_point(const CubePoint<F>& p, F half) {
  const F centre = half + F(0.5);  // texel 0's centre is at 1/2 in the face and at 3/2 with the border: s n + 1/2
  return {mul_add(p.s, half, centre), mul_add(p.t, half, centre)};
}
/// The same place in the next coarser level.
template <class F>
TESSERA_INLINE LevelPoint<F> coarser(const LevelPoint<F>& p) {
  return {mul_add(p.x, F(0.5), F(0.25)), mul_add(p.y, F(0.5), F(0.25))};
}

/// The bilinear footprint, times weight (of the texel format's texel_scale), in a level whose first texel has the index
/// `start`. The border makes it seamless: no footprint leaves its face.
template <class F>
TESSERA_INLINE BilinearFootprint<F> cube_footprint(const LevelPoint<F>& p, IntOf<F> start, int pitch, F weight) {
  using I = IntOf<F>;
  const I i = truncate_to_int(p.x), j = truncate_to_int(p.y);
  const F fx = p.x - to_float(i), fy = p.y - to_float(j);

  BilinearFootprint<F> f;
  f.above = j * I(pitch) + (start + i);
  const F wy1 = fy * weight, wy0 = weight - wy1;
  f.w01 = fx * wy0;
  f.w00 = wy0 - f.w01;
  f.w11 = fx * wy1;
  f.w10 = wy1 - f.w11;
  return f;
}

template <class F>
TESSERA_INLINE Vec3<F> blend(const BilinearFootprint<F>& f, const TexelPair<F>& above, const TexelPair<F>& below) {
  const auto channel = [&](F a, F b, F c, F d) {
    return mul_add(f.w11, d, mul_add(f.w10, c, mul_add(f.w01, b, f.w00 * a)));
  };
  return {channel(above.left.x, above.right.x, below.left.x, below.right.x),
          channel(above.left.y, above.right.y, below.left.y, below.right.y),
          channel(above.left.z, above.right.z, below.left.z, below.right.z)};
}

template <class Texels = HalfTexels, class F>
TESSERA_INLINE Vec3<F> sample_footprint(const CubeView& cube, const BilinearFootprint<F>& f) {
  const IntOf<F> next_row(cube_pitch(cube.size, cube.levels));
  const TexelPair<F> above = cube_texels<F>(Texels{}, cube, f.above);
  const TexelPair<F> below = cube_texels<F>(Texels{}, cube, f.above + next_row);
  return blend(f, above, below);
}

template <class F>
TESSERA_INLINE F clamp_level(const CubeView& cube, F lod) {
  return clamp(lod, F(0), F(cube.levels - 1));
}

/// Footprints in a level and in the next coarser one: their sum is the trilinear lookup.
template <class F>
struct CubeLookup {
  BilinearFootprint<F> fine, coarse;
};

/// p: from cube_point(direction, cube_face_texels) or cube_point_of_any(); level: from 0 to the last one.
template <class Texels = HalfTexels, class F>
TESSERA_INLINE CubeLookup<F> cube_lookup(const CubeView& cube, const CubePoint<F>& p, F level) {
  using I = IntOf<F>;
  const int pitch = cube_pitch(cube.size, cube.levels);
  const F whole = F(texel_scale<Texels, F>);
  CubeLookup<F> lookup;
  if (cube.levels == 1) {
    lookup.fine = lookup.coarse = cube_footprint(level_point(p, F(cube.size) * F(0.5)), p.face, pitch, whole);
    lookup.coarse.w00 = lookup.coarse.w01 = lookup.coarse.w10 = lookup.coarse.w11 = F(0);
    return lookup;
  }
  const I fine = min(truncate_to_int(level), I(cube.levels - 2));  // at the last level: all weight on the coarser one
  const F w = (level - to_float(fine)) * whole;

  const F half = from_bits(bits(F(cube.size) * F(0.5)) - (fine << mantissa_bits<F>));  // exact
  const I n = truncate_to_int(half + half);
  // cube_level_start() of the coarser level, which is never level 0, and of the finer one, which may be.
  const int below = (cube.size + 2) * pitch;
  const I coarse_start = p.face + (fine + fine - n + I(below + cube.size));
  const I fine_start = select(fine > I(0), coarse_start - n - I(2), p.face);
  const LevelPoint<F> at = level_point(p, half);
  lookup.fine = cube_footprint(at, fine_start, pitch, whole - w);
  lookup.coarse = cube_footprint(coarser(at), coarse_start, pitch, w);
  return lookup;
}

/// A level that all lanes are looked up in, and what it counts for.
struct WholeLevel {
  int start;  // cube_level_start
  float half, weight;
};
struct UniformLookup {
  WholeLevel fine, coarse;  // coarse counts for nothing where lod is whole: then there may be no such level
};
inline UniformLookup uniform_lookup(const CubeView& cube, float lod) {
  const float level = clamp(lod, 0.0f, float(cube.levels - 1));
  const std::int32_t fine = truncate_to_int(level);
  const float w = level - to_float(fine);
  const auto whole = [&](int k, float weight) {
    return WholeLevel{cube_level_start(cube.size, cube.levels, k), float(cube.size >> k) * 0.5f, weight};
  };
  return {whole(fine, 1.0f - w), whole(fine + 1, w)};
}
/// p: from cube_point(direction, cube_face_texels).
template <class F>
TESSERA_INLINE BilinearFootprint<F> cube_footprint(const CubeView& cube, const CubePoint<F>& p,
                                                   const WholeLevel& level) {
  return cube_footprint(level_point(p, F(level.half)), p.face + IntOf<F>(level.start),
                        cube_pitch(cube.size, cube.levels), F(level.weight * texel_scale<HalfTexels, F>));
}

/// Radiance along `direction` at level `lod`: bilinear in a face, linear between levels, seamless across faces. The
/// direction needs no unit length (1e-37 < length < 1e37); lod is clamped to the levels there are. Any bits give a
/// texel of the cube: never a read outside it, and a finite result as its texels are. Cube size at most 4096. Texels
/// must be what the cube's format says.
template <class Texels = HalfTexels, class F>
inline Vec3<F> sample_cube(const CubeView& cube, const Vec3<F>& direction, F lod) {
  const CubePoint<F> point = cube_point_of_any(direction, cube_face_texels(cube.size, cube.levels));
  const CubeLookup<F> lookup = cube_lookup<Texels>(cube, point, clamp_level(cube, lod));
  return sample_footprint<Texels>(cube, lookup.fine) + sample_footprint<Texels>(cube, lookup.coarse);
}

/// As above with one lod for all lanes: a whole level is read once.
template <class F>
inline Vec3<F> sample_cube_uniform(const CubeView& cube, const Vec3<F>& direction, float lod) {
  const CubePoint<F> p = cube_point_of_any(direction, cube_face_texels(cube.size, cube.levels));
  const UniformLookup lookup = uniform_lookup(cube, lod);
  const Vec3<F> a = sample_footprint(cube, cube_footprint(cube, p, lookup.fine));
  if (!(lookup.coarse.weight > 0.0f)) return a;
  return a + sample_footprint(cube, cube_footprint(cube, p, lookup.coarse));
}

/// E(n) / pi in one channel, for unit n: a polynomial of the second degree in n, with x^2 + y^2 + z^2 = 1 in place of
/// z^2 (Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", section 3.2, have
/// it as a 4 x 4 matrix). By Horner's rule it takes eight multiplications with an addition each.
template <class F>
struct IrradiancePolynomial {
  F xx, xy, xz, x;
  F yy, yz, y;
  F z, one;
};

/// Of nine coefficients (EnvironmentView::irradiance_sh).
template <class F>
TESSERA_INLINE IrradiancePolynomial<F> irradiance_polynomial(const float sh[9][3], int channel) {
  double c[9];
  for (int k = 0; k < 9; ++k) c[k] = double(sh[k][channel]);
  // c6 (3 z^2 - 1) + c8 (x^2 - y^2)
  return {F(c[8] - 3 * c[6]), F(c[4]), F(c[7]), F(c[3]), F(-c[8] - 3 * c[6]), F(c[5]), F(c[1]), F(c[2]),
          F(c[0] + 2 * c[6])};
}

template <class F>
TESSERA_INLINE IrradiancePolynomial<F> broadcast(const IrradiancePolynomial<float>& p) {
  return {F(p.xx), F(p.xy), F(p.xz), F(p.x), F(p.yy), F(p.yz), F(p.y), F(p.z), F(p.one)};
}

/// Clamped to >= 0: a bright sun makes the truncated series negative on its far side.
template <class F>
TESSERA_INLINE F irradiance(const IrradiancePolynomial<F>& p, const Vec3<F>& n) {
  const F along_x = mul_add(n.z, p.xz, mul_add(n.y, p.xy, mul_add(n.x, p.xx, p.x)));
  const F along_y = mul_add(n.z, p.yz, mul_add(n.y, p.yy, p.y));
  return max(mul_add(n.x, along_x, mul_add(n.y, along_y, mul_add(n.z, p.z, p.one))), F(0));
}

/// The node that DfgPosition counts from: linear axes reach into the border on both sides, warped ones begin at the
/// first node.
TESSERA_INLINE const float* dfg_origin(const DfgView& dfg) {
  const int first = dfg.warped ? dfg_pitch(dfg.size) + 1 : 0;
  return reinterpret_cast<const float*>(dfg.nodes + std::ptrdiff_t{dfg_node_shorts} * first);
}

/// In nodes from dfg_origin(), never below 0. NoV and r (perceptual) in [0, 1].
template <class F>
TESSERA_INLINE DfgPosition<F> dfg_position(const DfgView& dfg, F NoV, F r) {
  const F size = F(dfg.size);
  if (dfg.warped) return DfgWarpedAxes::position(NoV, r, size);
  return {mul_add(NoV, size, F(0.5)), mul_add(r, size, F(0.5))};  // node 0 is at 1/2, and at 3/2 with the border
}

/// A node, the one below it, and their neighbours to the right.
template <class F>
struct DfgFootprint {
  IntOf<F> node;   // the upper left one
  IntOf<F> below;  // what the lower nodes count for, and in the low sixteen bits the upper ones: of dfg_whole
  F right;         // what the right nodes count for, of 1
};
inline constexpr int dfg_whole = (1 << 15) - 1;

/// Bilinear. The border clamps to the table's edge.
template <class F>
TESSERA_INLINE DfgFootprint<F> dfg_footprint(const DfgView& dfg, const DfgPosition<F>& at) {
  using I = IntOf<F>;
  const I i = truncate_to_int(at.x), y = round_to_int(at.y * F(dfg_whole + 1));
  const I below = y & I(dfg_whole);
  return {(y >> 15) * I(dfg_pitch(dfg.size)) + i, (below << 16) + (I(dfg_whole) - below), at.x - to_float(i)};
}

/// What the table holds at a footprint: A and B, or on warped axes what gives them. words: of both upper nodes.
TESSERA_INLINE EnvironmentBRDF<Float> blend_dfg(Int below, Float right, const Float (&words)[4]) {
  const auto channel = [&](Float left_word, Float right_word) {
    // Exact: sixteen bits times fifteen, and differences of such.
    const Int l = dot_halves(bits(left_word), below), r = dot_halves(bits(right_word), below);
    const Float sum = mul_add(right, to_float(r - l), to_float(l));
    return mul_add(sum, Float(dfg_step / dfg_whole), Float(dfg_middle));
  };
  return {channel(words[0], words[2]), channel(words[1], words[3])};
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

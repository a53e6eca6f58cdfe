// Image-based light at a point: radiance from a cubemap with mips, irradiance from spherical harmonics, and the
// environment BRDF from its table.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Where a direction meets the cube: the face, and sc/ma, tc/ma in [-1, 1] (OpenGL 4.6, table 8.19; ties go to x, then
/// y).
template <class F>
struct CubePoint {
  IntOf<F> face;
  F s, t;
};

template <class F>
TESSERA_INLINE CubePoint<F> cube_point(const Vec3<F>& d) {
  const F ax = abs(d.x), ay = abs(d.y), az = abs(d.z);
  const auto major_x = (ax >= ay) & (ax >= az);
  const auto major_y = ay >= az;
  const F axis = select(major_x, d.x, select(major_y, d.y, d.z));
  const auto negative = axis < F(0);
  // +X: (-z, -y)   -X: (z, -y)   +Y: (x, z)   -Y: (x, -z)   +Z: (x, -y)   -Z: (-x, -y)
  const F z_or_minus_z = select(negative, d.z, -d.z);
  const F sc = select(major_x, z_or_minus_z, select(major_y | !negative, d.x, -d.x));
  const F tc = select(major_x | !major_y, -d.y, -z_or_minus_z);
  const F scale = F(1) / abs(axis);
  const IntOf<F> first = select(major_x, IntOf<F>(0), select(major_y, IntOf<F>(2), IntOf<F>(4)));
  return {select(negative, first + IntOf<F>(1), first), sc * scale, tc * scale};
}

template <class F>
inline constexpr int mantissa_bits = 23;
template <>
inline constexpr int mantissa_bits<double> = 52;

/// Three channels of the texel with this index (counted from level 0).
template <class F>
TESSERA_INLINE Vec3<F> cube_texel(const CubeView& cube, IntOf<F> index) {
  const IntPair rgba = gather_pairs(cube.texels, index << 3);
  return {half_to_float(rgba.low & Int(0xffff)), half_to_float(shift_right_logical(rgba.low, 16)),
          half_to_float(rgba.high & Int(0xffff))};
}
// One lane at a time: the same texel for tests and set-up.
template <class F>
inline Vec3<F> cube_texel_scalar(const CubeView& cube, std::int64_t index) {
  const std::uint16_t* texel = cube.texels + 4 * index;
  return {F(half_to_float(std::int32_t(texel[0]))), F(half_to_float(std::int32_t(texel[1]))),
          F(half_to_float(std::int32_t(texel[2])))};
}
template <>
inline Vec3<float> cube_texel<float>(const CubeView& cube, std::int32_t index) {
  return cube_texel_scalar<float>(cube, index);
}
template <>
inline Vec3<double> cube_texel<double>(const CubeView& cube, std::int64_t index) {
  return cube_texel_scalar<double>(cube, index);
}

/// Bilinear lookup, times weight, in the level of n = (float) ni texels along a face whose first texel has the index
/// `start`. The border makes it seamless: no footprint leaves its face.
template <class F>
TESSERA_INLINE Vec3<F> sample_cube_bilinear(const CubeView& cube, const CubePoint<F>& p, F n, IntOf<F> ni,
                                            IntOf<F> start, F weight) {
  using I = IntOf<F>;
  const F half = n * F(0.5);
  const F centre = half + F(0.5);  // texel 0's centre is at 1/2 in the face and at 3/2 with the border: s n + 1/2
  const F limit = n + F(0.5);
  const F x = clamp(mul_add(p.s, half, centre), F(0.5), limit);  // NaN becomes 1/2
  const F y = clamp(mul_add(p.t, half, centre), F(0.5), limit);
  const I i = truncate_to_int(x), j = truncate_to_int(y);
  const F fx = x - to_float(i), fy = y - to_float(j);

  const I row = ni + I(2);
  const I first = start + (p.face * row + j) * row + i;
  const F wy1 = fy * weight, wy0 = weight - wy1;
  const F w01 = fx * wy0, w00 = wy0 - w01;
  const F w11 = fx * wy1, w10 = wy1 - w11;
  const Vec3<F> t00 = cube_texel<F>(cube, first), t01 = cube_texel<F>(cube, first + I(1));
  const Vec3<F> t10 = cube_texel<F>(cube, first + row), t11 = cube_texel<F>(cube, first + row + I(1));
  const auto blend = [&](F a, F b, F c, F d) { return mul_add(w11, d, mul_add(w10, c, mul_add(w01, b, w00 * a))); };
  return {blend(t00.x, t01.x, t10.x, t11.x), blend(t00.y, t01.y, t10.y, t11.y), blend(t00.z, t01.z, t10.z, t11.z)};
}

/// A level for each lane.
template <class F>
TESSERA_INLINE Vec3<F> sample_cube_level(const CubeView& cube, const CubePoint<F>& p, IntOf<F> level, F weight) {
  using I = IntOf<F>;
  const F n = from_bits(bits(F(cube.size)) - (level << mantissa_bits<F>));  // size >> level, exactly
  const I ni = truncate_to_int(n), size = I(cube.size);
  // cube_level_offset: 6 times the sum over k < level of ((size >> k) + 2)^2.
  const I start = ((size - ni) * (size + ni + I(6)) << 3) + level * I(24);
  return sample_cube_bilinear(cube, p, n, ni, start, weight);
}

/// One level for all lanes.
template <class F>
TESSERA_INLINE Vec3<F> sample_cube_whole_level(const CubeView& cube, const CubePoint<F>& p, int level, float weight) {
  using I = IntOf<F>;
  const int n = cube.size >> level;
  const int start = 8 * (cube.size - n) * (cube.size + n + 6) + 24 * level;
  return sample_cube_bilinear(cube, p, F(n), I(n), I(start), F(weight));
}

/// Radiance along `direction` at level `lod`: bilinear in a face, linear between levels, seamless across faces. The
/// direction needs no unit length (1e-37 < length < 1e37); lod is clamped to the levels there are. Any bits give a
/// texel of the cube: never a read outside it, and a finite result as its texels are. Cube size at most 4096.
template <class F>
inline Vec3<F> sample_cube(const CubeView& cube, const Vec3<F>& direction, F lod) {
  using I = IntOf<F>;
  const CubePoint<F> p = cube_point(direction);
  const F level = clamp(lod, F(0), F(cube.levels - 1));
  const I fine = truncate_to_int(level);
  const I coarse = select(fine < I(cube.levels - 1), fine + I(1), fine);
  const F w = level - to_float(fine);
  const Vec3<F> a = sample_cube_level(cube, p, fine, F(1) - w);
  const Vec3<F> b = sample_cube_level(cube, p, coarse, w);
  return a + b;
}

/// As above with one lod for all lanes: a whole level is read once.
template <class F>
inline Vec3<F> sample_cube_uniform(const CubeView& cube, const Vec3<F>& direction, float lod) {
  const CubePoint<F> p = cube_point(direction);
  const float level = clamp(lod, 0.0f, float(cube.levels - 1));
  const std::int32_t fine = truncate_to_int(level);
  const float w = level - to_float(fine);
  const Vec3<F> a = sample_cube_whole_level(cube, p, fine, 1.0f - w);
  if (!(w > 0.0f)) return a;
  return a + sample_cube_whole_level(cube, p, fine + 1, w);
}

/// E(n) / pi from nine coefficients (EnvironmentView::irradiance_sh), n a unit vector. Clamped to >= 0: a bright sun
/// makes the truncated series negative on its far side.
template <class F>
inline Vec3<F> irradiance(const float sh[9][3], const Vec3<F>& n) {
  const F xy = n.x * n.y, yz = n.y * n.z, xz = n.x * n.z;
  const F zz = mul_sub(F(3) * n.z, n.z, F(1));
  const F xx_yy = difference_of_products(n.x, n.x, n.y, n.y);
  const auto channel = [&](int c) {
    const F linear = mul_add(F(sh[3][c]), n.x, mul_add(F(sh[2][c]), n.z, mul_add(F(sh[1][c]), n.y, F(sh[0][c]))));
    const F mixed = mul_add(F(sh[7][c]), xz, mul_add(F(sh[5][c]), yz, mul_add(F(sh[4][c]), xy, linear)));
    return max(mul_add(F(sh[8][c]), xx_yy, mul_add(F(sh[6][c]), zz, mixed)), F(0));
  };
  const F r = channel(0), g = channel(1), b = channel(2);
  return {r, g, b};
}

/// A and B of the environment BRDF: integral of the specular lobe = F0 A + F90 B. NoV and r (perceptual) in [0, 1];
/// bilinear, clamped to the table's edge.
template <class F>
inline void sample_dfg(const DfgView& dfg, F NoV, F r, F& A, F& B) {
  using I = IntOf<F>;
  const F size = F(dfg.size), last = F(dfg.size - 1);
  const F x = clamp(mul_sub(NoV, size, F(0.5)), F(0), last);
  const F y = clamp(mul_sub(r, size, F(0.5)), F(0), last);
  const I i = truncate_to_int(min(x, F(dfg.size - 2))), j = truncate_to_int(min(y, F(dfg.size - 2)));
  const F w1 = x - to_float(i), v1 = y - to_float(j);
  const F w0 = F(1) - w1, v0 = F(1) - v1;
  const F w00 = v0 * w0, w01 = v0 * w1, w10 = v1 * w0, w11 = v1 * w1;
  const I index = (j * I(dfg.size) + i) << 1;
  const I below = index + I(2 * dfg.size);
  const auto channel = [&](int c) {
    const float* texels = dfg.texels + c;
    const F a = F(gather(texels, index)), b = F(gather(texels + 2, index));
    const F d = F(gather(texels, below)), e = F(gather(texels + 2, below));
    return mul_add(w11, e, mul_add(w10, d, mul_add(w01, b, w00 * a)));
  };
  A = channel(0);
  B = channel(1);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

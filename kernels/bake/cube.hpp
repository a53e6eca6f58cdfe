// From an equirectangular picture, or other faces, to the faces of a cube.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/light/environment.hpp"
#include "kernels/math/approx.hpp"
#include "kernels/math/vector.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// The direction (not unit) through (s, t) in [-1, 1]^2 of a face: the inverse of cube_point.
template <class F>
inline Vec3<F> face_direction(int face, F s, F t) {
  const F one = F(1);
  switch (face) {
    case 0:
      return {one, -t, -s};
    case 1:
      return {-one, -t, s};
    case 2:
      return {s, one, t};
    case 3:
      return {s, -one, -t};
    case 4:
      return {s, -t, one};
    default:
      return {-s, -t, -one};
  }
}

/// Four texels of packed RGB, at columns i0 and i1 of the rows that begin with texels row0 and row1, blended.
template <class F>
inline Vec3<F> blend_texels(const float* rgb, IntOf<F> row0, IntOf<F> row1, IntOf<F> i0, IntOf<F> i1, F fx, F fy) {
  using I = IntOf<F>;
  const I a = (row0 + i0) * I(3), b = (row0 + i1) * I(3), c = (row1 + i0) * I(3), e = (row1 + i1) * I(3);
  const auto channel = [&](int k) {
    const float* texels = rgb + k;
    const F above = lerp(gather(texels, a), gather(texels, b), fx);
    const F below = lerp(gather(texels, c), gather(texels, e), fx);
    return lerp(above, below, fy);
  };
  const F red = channel(0), green = channel(1), blue = channel(2);
  return {red, green, blue};
}

/// Bilinear lookup along d (finite, not zero, need not be unit). Wraps around in u, clamps at the poles.
template <class F>
inline Vec3<F> sample_equirect(const EquirectView& source, const Vec3<F>& d) {
  using I = IntOf<F>;
  const F around = atan2(d.z, d.x);
  const F from_pole = atan2(sqrt(mul_add(d.x, d.x, d.z * d.z)), d.y);  // acos(y) loses the poles' digits
  const F width = F(source.width), height = F(source.height);
  const F x = clamp(mul_add(around * F(0.15915494309189535), width, width * F(0.5) - F(0.5)), F(-0.5), width - F(0.5));
  const F y = clamp(mul_sub(from_pole * F(0.3183098861837907), height, F(0.5)), F(0), height - F(1));

  const F x0 = floor(x);
  const F fx = x - x0;
  const I left = truncate_to_int(x0);  // -1 .. width - 1
  const I i0 = select(left < I(0), I(source.width - 1), left);
  const I i1 = select(left + I(1) < I(source.width), left + I(1), I(0));
  const I j0 = truncate_to_int(y);
  const F fy = y - to_float(j0);
  const I j1 = min(j0 + I(1), I(source.height - 1));

  return blend_texels(source.texels, j0 * I(source.width), j1 * I(source.width), i0, i1, fx, fy);
}

/// Bilinear lookup along d (finite, not zero, need not be unit) in the face that it meets, clamped at the face's edge.
template <class F>
inline Vec3<F> sample_faces(const CubeFacesView& source, const Vec3<F>& d) {
  using I = IntOf<F>;
  const CubePoint<F> p = cube_point(d);
  const F half = F(source.size) * F(0.5), middle = half - F(0.5), last = F(source.size - 1);
  const F x = clamp(mul_add(p.s, half, middle), F(0), last);
  const F y = clamp(mul_add(p.t, half, middle), F(0), last);
  const I i0 = truncate_to_int(x), j0 = truncate_to_int(y), end = I(source.size - 1);
  const I i1 = min(i0 + I(1), end), j1 = min(j0 + I(1), end);
  const F fx = x - to_float(i0), fy = y - to_float(j0);
  const I size = I(source.size);
  return blend_texels(source.texels, (p.face * size + j0) * size, (p.face * size + j1) * size, i0, i1, fx, fy);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// Radiance convolved with a lobe: one texel of a prefiltered cube per lane.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/light/environment.hpp"
#include "kernels/math/vector.hpp"

namespace tessera::TESSERA_ISA {
namespace {

template <class F>
struct Frame {
  Vec3<F> tangent, bitangent, normal;
};

/// A right-handed frame about the unit vector n. Duff et al. 2017, "Building an orthonormal basis, revisited".
template <class F>
inline Frame<F> frame_about(const Vec3<F>& n) {
  const F sign = copy_sign(F(1), n.z);
  const F a = F(-1) / (sign + n.z);
  const F b = n.x * n.y * a;
  const F sx = sign * n.x;
  return {{mul_add(sx * n.x, a, F(1)), sign * b, -sx}, {b, mul_add(n.y * n.y, a, sign), -n.y}, n};
}

/// The weighted sum over the lobe's points of radiance around the unit vector n. Filtered importance sampling (Krivanek
/// and Colbert 2008, "Real-time shading with filtered importance sampling"): each point reads the mip level whose
/// texels are as large as the part of the sphere that it stands for.
template <class F>
inline Vec3<F> prefilter(const CubeView& radiance, const LobeSamples& lobe, const Vec3<F>& n) {
  const Frame<F> frame = frame_about(n);
  Vec3<F> sum{F(0), F(0), F(0)};
  for (int k = 0; k < lobe.count; ++k) {
    const F x = F(lobe.x[k]), y = F(lobe.y[k]), z = F(lobe.z[k]);
    const Vec3<F> l{mul_add(z, n.x, mul_add(y, frame.bitangent.x, x * frame.tangent.x)),
                    mul_add(z, n.y, mul_add(y, frame.bitangent.y, x * frame.tangent.y)),
                    mul_add(z, n.z, mul_add(y, frame.bitangent.z, x * frame.tangent.z))};
    const Vec3<F> sample = sample_cube_uniform(radiance, l, lobe.lod[k]);
    const F weight = F(lobe.weight[k]);
    sum = {mul_add(weight, sample.x, sum.x), mul_add(weight, sample.y, sum.y), mul_add(weight, sample.z, sum.z)};
  }
  return sum;
}

/// The lobe n = v = r of GGX around n, evaluated exactly at each source: D(h) n.l up to a factor, with cos(theta_h)^2 =
/// (1 + n.l) / 2. Products and sums are rounded apart: fused they would be no nearer, and on instruction sets without a
/// fused multiply-add this loop, most of a bake's work, would take four times as long.
template <class F>
inline Vec3<F> sum_points(const PointSources& points, const Vec3<F>& n) {
  const F alpha2 = F(points.alpha2), rest = (F(1) - alpha2) * F(0.25);
  Vec3<F> sum{F(0), F(0), F(0)};
  F total = F(0);
  for (int k = 0; k < points.count; ++k) {
    const Vec3<F> apart{n.x - F(points.x[k]), n.y - F(points.y[k]), n.z - F(points.z[k])};
    // 2 (1 - n.l), which keeps its digits near the axis
    const F distance2 = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
    const F NoL = max(F(1) - distance2 * F(0.5), F(0));
    const F t = distance2 * rest + alpha2;
    const F weight = NoL / (t * t);
    sum = {sum.x + weight * F(points.red[k]), sum.y + weight * F(points.green[k]), sum.z + weight * F(points.blue[k])};
    if (points.solid_angle) total = total + weight * F(points.solid_angle[k]);
  }
  if (points.solid_angle) return {sum.x / total, sum.y / total, sum.z / total};
  return sum * F(points.scale);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

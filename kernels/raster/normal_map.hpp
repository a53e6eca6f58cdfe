// Tangent frames and normal maps, as glTF 2.0 means them: +X of the texture to the right, +Y up in the image (so
// against v, which points down), +Z out of the surface.
#pragma once
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// v scaled so that its largest component is 1: for vectors whose length may be anything (small triangles, small UVs).
/// Zero and non-finite vectors become zero or not finite.
template <class F>
inline Vec3<F> scale_to_one(const Vec3<F>& v) {
  const F largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
  const F divisor = select(largest > F(0), largest, F(1));
  return {v.x / divisor, v.y / divisor, v.z / divisor};
}

/// Normal of the triangle's plane on its front; (0, 0, 1) if it has none.
template <class F>
inline Vec3<F> geometric_normal(const Vec3<F>& edge1, const Vec3<F>& edge2) {
  return normalize(cross(scale_to_one(edge1), scale_to_one(edge2)), Vec3<F>{F(0), F(0), F(1)});
}

template <class F>
struct TangentFrame {
  Vec3<F> tangent, bitangent, normal;
};

/// The frame of vertices that carry tangents. Interpolated normal and tangent stay unnormalised, as in the frame that
/// bakers assume (Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", appendix A; MikkTSpace).
template <class F>
inline TangentFrame<F> frame_from_tangent(const Vec3<F>& normal, const Vec3<F>& tangent, F handedness) {
  return {tangent, cross(normal, tangent) * copy_sign(F(1), handedness), normal};
}

/// The frame of a triangle whose vertices carry none: the direction in which u grows, made perpendicular to the unit
/// normal. edge_i = p_i - p_0, and du_i, dv_i likewise. Without a direction (UVs without area) the tangents are zero.
///
/// Derivation. edge_i = du_i Pu + dv_i Pv, so that with D = du1 dv2 - du2 dv1
///     Pu = (edge1 dv2 - edge2 dv1) / D,
/// of which only the direction matters: the sign of D. The image is seen upright, not mirrored, when u grows to the
/// right and v downwards; then D < 0 for a triangle counter-clockwise in the world, and up is cross(normal, tangent).
template <class F>
inline TangentFrame<F> frame_from_uv(const Vec3<F>& normal, const Vec3<F>& edge1, const Vec3<F>& edge2, F du1, F dv1,
                                     F du2, F dv2) {
  const F area = difference_of_products(du1, dv2, du2, dv1);
  const F sign = select(area < F(0), F(-1), select(area > F(0), F(1), F(0)));
  const Vec3<F> along = scale_to_one(Vec3<F>{difference_of_products(edge1.x, dv2, edge2.x, dv1),
                                             difference_of_products(edge1.y, dv2, edge2.y, dv1),
                                             difference_of_products(edge1.z, dv2, edge2.z, dv1)});
  const F lean = dot(normal, along);
  const Vec3<F> flat{neg_mul_add(normal.x, lean, along.x), neg_mul_add(normal.y, lean, along.y),
                     neg_mul_add(normal.z, lean, along.z)};
  const Vec3<F> tangent = normalize(flat, Vec3<F>{F(0), F(0), F(0)}) * sign;
  return {tangent, cross(normal, tangent) * -sign, normal};
}

/// The frame's normal turned by a normal map's texel (0..1 each); `unperturbed` (unit) where the frame has no tangent
/// or the result no direction. scale is normalTexture.scale.
template <class F>
inline Vec3<F> perturb_normal(const TangentFrame<F>& frame, F red, F green, F blue, F scale,
                              const Vec3<F>& unperturbed) {
  const F x = mul_sub(F(2), red, F(1)) * scale;
  const F y = mul_sub(F(2), green, F(1)) * scale;
  const F z = mul_sub(F(2), blue, F(1));
  const Vec3<F> turned{mul_add(z, frame.normal.x, mul_add(y, frame.bitangent.x, x * frame.tangent.x)),
                       mul_add(z, frame.normal.y, mul_add(y, frame.bitangent.y, x * frame.tangent.y)),
                       mul_add(z, frame.normal.z, mul_add(y, frame.bitangent.z, x * frame.tangent.z))};
  const Vec3<F> normal = normalize(turned, unperturbed);
  const MaskOf<F> framed = dot(frame.tangent, frame.tangent) > F(0);
  return select<F>(framed, normal, unperturbed);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

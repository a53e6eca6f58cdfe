// Where on its triangle a point of the window lies, from nothing but the world positions and the view: no set-up is
// stored, vertices behind the eye need no clipping, and orthographic views (w = 1) are no special case.
//
// Derivation. A vertex is (x, y, w) in homogeneous window coordinates. The point sum b_i p_i of the triangle is seen at
// (px, py) when sum b_i x_i = px sum b_i w_i, and likewise for y: with x'_i = x_i - px w_i and y'_i = y_i - py w_i,
//     sum b_i x'_i = 0,  sum b_i y'_i = 0:   b is along the cross product  n = (x'_0, x'_1, x'_2) x (y'_0, y'_1, y'_2).
// Scaled to sum 1, b are perspective-correct barycentrics. The sign of n_0 + n_1 + n_2 is that of det(x y w) / w at the
// point: negative for triangles seen from the front, as y points down.
// n is bilinear in px and py, so that its derivatives are exact: dx'_i/dpx = -w_i, and the quotient rule gives b's.
// (The homogeneous formulation is that of Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates",
// 1997.)
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

template <class F>
struct Barycentrics {
  F b0, b1, b2;                  // within [0, 1], summing to 1
  F b1_dx, b1_dy, b2_dx, b2_dy;  // change per pixel to the right, and down; b0's is minus the sum of the others'
  MaskOf<F> back;                // the triangle is seen from behind
};

template <class F>
TESSERA_INLINE F transform_row(const float row[4], const Vec3<F>& p) {
  return mul_add(F(row[0]), p.x, mul_add(F(row[1]), p.y, mul_add(F(row[2]), p.z, F(row[3]))));
}

/// The window point (px, py), in pixels, on the triangle of these world positions. Total: a triangle without area, or
/// whose numbers overflow, answers with its centroid and no change.
template <class F>
TESSERA_INLINE Barycentrics<F> barycentrics(const ViewTransform& view, const Vec3<F> (&p)[3], F px, F py) {
  F x[3], y[3], w[3];
  for (int i = 0; i < 3; ++i) {
    w[i] = transform_row(view.w, p[i]);
    x[i] = neg_mul_add(px, w[i], transform_row(view.x, p[i]));
    y[i] = neg_mul_add(py, w[i], transform_row(view.y, p[i]));
  }
  F n[3], n_dx[3], n_dy[3];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = difference_of_products(x[j], y[k], x[k], y[j]);
    n_dx[i] = difference_of_products(w[k], y[j], w[j], y[k]);
    n_dy[i] = difference_of_products(w[j], x[k], w[k], x[j]);
  }
  Barycentrics<F> b;
  b.back = n[0] + n[1] + n[2] > F(0);
  const F sign = select(b.back, F(1), F(-1));
  // Coverage is decided with vertices snapped to 1/256 pixel, so that a covered point can lie that far outside: its
  // negative weights count as none.
  const F m0 = max(n[0] * sign, F(0));
  const F m1 = max(n[1] * sign, F(0));
  const F m2 = max(n[2] * sign, F(0));
  const F sum = m0 + m1 + m2;
  const auto valid = (sum >= F(1e-37)) & (sum <= F(1e37));  // its reciprocal is normal; false for NaN
  const F scale = F(1) / sum;                               // used where valid: nothing waits for the comparisons
  const F third = F(1.0 / 3.0);
  b.b0 = select(valid, m0 * scale, third);
  b.b1 = select(valid, m1 * scale, third);
  b.b2 = select(valid, m2 * scale, third);
  const F slope = scale * sign;
  const F sum_dx = n_dx[0] + n_dx[1] + n_dx[2];
  const F sum_dy = n_dy[0] + n_dy[1] + n_dy[2];
  b.b1_dx = select(valid, neg_mul_add(b.b1, sum_dx, n_dx[1]) * slope, F(0));
  b.b1_dy = select(valid, neg_mul_add(b.b1, sum_dy, n_dy[1]) * slope, F(0));
  b.b2_dx = select(valid, neg_mul_add(b.b2, sum_dx, n_dx[2]) * slope, F(0));
  b.b2_dy = select(valid, neg_mul_add(b.b2, sum_dy, n_dy[2]) * slope, F(0));
  return b;
}

template <class F>
TESSERA_INLINE F interpolate(const Barycentrics<F>& b, F a0, F a1, F a2) {
  return mul_add(b.b2, a2, mul_add(b.b1, a1, b.b0 * a0));
}

template <class F>
TESSERA_INLINE Vec3<F> interpolate(const Barycentrics<F>& b, const Vec3<F> (&a)[3]) {
  return {interpolate(b, a[0].x, a[1].x, a[2].x), interpolate(b, a[0].y, a[1].y, a[2].y),
          interpolate(b, a[0].z, a[1].z, a[2].z)};
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// GGX, the distribution of microfacet normals that the renderer uses; the others stand in distribution_other.hpp. D(h)
// is a density over the hemisphere of h around n: integral D(h) n.h dh = 1.
#pragma once
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

inline constexpr double pi = 3.14159265358979323846;

/// sin^2 of the angle between two unit vectors, accurate for small angles too (1 - NoH^2 loses all digits there).
/// The tangential part of h is h - n (n.h). Rounding n.h, or an n whose length is off by e, moves that vector along n,
/// to which it is orthogonal; so such an error enters squared: 1e-7 becomes 1e-14, beside alpha^2 >= 1e-8.
template <class F>
TESSERA_INLINE F sin2_between(const Vec3<F>& n, const Vec3<F>& h) {
  const F NoH = dot(n, h);
  const Vec3<F> tangential = {neg_mul_add(n.x, NoH, h.x), neg_mul_add(n.y, NoH, h.y), neg_mul_add(n.z, NoH, h.z)};
  return dot(tangential, tangential);
}

/// GGX. sin2 = 1 - NoH^2 taken from the vectors (sin2_between), NoH in [0,1], alpha in [0,1]. Maximum 1/(pi alpha^2),
/// uncapped. alpha = 0 has no density: returns 0 at its peak too.
template <class F>
TESSERA_INLINE F D_GGX(F NoH, F sin2, F alpha) {
  // Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces, eq. 33, with
  // NoH^2 (alpha^2 - 1) + 1 = sin^2 + (alpha NoH)^2, a sum of positive terms: no cancellation.
  const F scaled = alpha * NoH;
  const F t = mul_add(scaled, scaled, sin2);
  const F ratio = alpha / max(t, F(1e-37));  // 1e-37: keeps 0/0 from alpha = 0 out; legitimate t is >= alpha^2
  return ratio * ratio * F(1 / pi);
}

/// GGX as most programs write it, from the cosine alone: NoH^2 (alpha^2 - 1) + 1 cancels for small alpha near the peak.
/// A point of the chart, not for rendering.
template <class F>
TESSERA_INLINE F D_GGX_naive(F NoH, F alpha) {
  // Walter et al. 2007, eq. 33, literally.
  const F alpha2 = alpha * alpha;
  const F t = NoH * NoH * (alpha2 - F(1)) + F(1);
  return alpha2 / max(F(pi) * t * t, F(1e-37));  // 1e-37: the cancelled sum is 0 where alpha < 2.4e-4
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

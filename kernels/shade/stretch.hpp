// Prefiltered radiance over the GGX lobe as it is. Prefiltered levels hold lobes that are round, seen along the normal
// (n = v = r); the true lobe is stretched along the plane of incidence the more, the more grazing the view, and cut off
// by the horizon. Both are recovered by laying several round lobes, each narrower than the whole, where the visible
// microfacets reflect to.
//
// Heitz 2018, "Sampling the GGX distribution of visible normals": in the space where the ellipsoid of slopes is a
// hemisphere, visible normals project uniformly onto a disc, of which the lower half is squeezed to 1 - s .. 1 with s =
// (1 + n.v') / 2. A point (x, y) of the disc gives the facet h, and the light l that it reflects to v has the weight
// G2(v, l) / G1(v): what is left of the BRDF times cosine over the density of l.
//
// In the plane of incidence (x = 0), with v' = (hx, hz) the stretched view, a = (hx z - hz y, hx y + hz z), z =
// sqrt(1 - y^2), and b = (alpha a.x, a.z), not normalised:
//   l = 2 (v.b) b / |b|^2 - v
// Across the plane, x moves l by 2 (v.h) alpha / |b| = 2 alpha (v.b) / |b|^2 per unit of x; a round lobe of alpha'
// moves it by 2 alpha'. So alpha' = alpha (v.b) / |b|^2, at the width of the disc's chord.
#pragma once
#include "kernels/bsdf/masking.hpp"
#include "kernels/interface.hpp"
#include "kernels/light/environment.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/shade/surface.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// The level of prefiltered radiance for a roughness in [0, 1].
template <class F>
TESSERA_INLINE F specular_level(const EnvironmentView& environment, F r) {
  const F linear = r * F(environment.specular.levels - 1);
  return mul_add(linear * F(environment.lod_curve), F(1) - r, linear);
}

/// Off-specular peak: Lagarde and de Rousiers 2014, "Moving Frostbite to PBR", listing 22, whose roughness is alpha.
/// Not unit.
template <class F>
TESSERA_INLINE Vec3<F> dominant_direction(const Vec3<F>& n, const Vec3<F>& reflected, F alpha) {
  const F smoothness = F(1) - alpha;
  const F along = smoothness * (sqrt(smoothness) + alpha);
  return lerp(n, reflected, along);
}

/// v in the frame of its plane of incidence, and what all points of the lobe share.
template <class F>
struct LobeView {
  Vec3<F> n, tangent;  // v = sin_v tangent + NoV n
  F NoV, sin_v, alpha;
  F hx, hz;  // v', unit
  F root_v;  // Smith's root of NoV
};

/// n and v unit, nv = n.v, r (perceptual) in [0, 1].
template <class F>
TESSERA_INLINE LobeView<F> lobe_view(const Vec3<F>& n, const Vec3<F>& v, F nv, F r) {
  LobeView<F> w;
  w.n = n;
  const Vec3<F> across = v - n * nv;
  w.tangent = across * (F(1) / sqrt(max(dot(across, across), F(1e-20))));  // v = n: any direction, even none
  w.NoV = clamp_NoV(nv);
  w.sin_v = sqrt(max(neg_mul_add(w.NoV, w.NoV, F(1)), F(0)));
  w.alpha = r * r;
  const F x = w.alpha * w.sin_v;
  const F scale = F(1) / sqrt(mul_add(x, x, w.NoV * w.NoV));  // NoV >= 1e-4
  w.hx = x * scale;
  w.hz = w.NoV * scale;
  w.root_v = smith_root_GGX(w.NoV, w.alpha * w.alpha);
  return w;
}
/// s of the disc.
template <class F>
TESSERA_INLINE F upper_part(const LobeView<F>& w) {
  return mul_add(w.hz, F(0.5), F(0.5));
}

/// G2(v, l) / G1(v) at n.l; 0 below the horizon. Heitz 2014, eq. 99 over eq. 43.
template <class F>
TESSERA_INLINE F visible_weight(const LobeView<F>& w, F nl) {
  const F NoL = max(nl, F(0));
  const F masked = mul_add(NoL, w.root_v, w.NoV * smith_root_GGX(NoL, w.alpha * w.alpha));
  return NoL * (w.NoV + w.root_v) / max(masked, F(1e-20));  // 1e-20: a mirror at the horizon has neither
}

/// A point of the lobe: it reflects v to l = lx tangent + ly bitangent + lz n, and stands for a round lobe of alpha.
template <class F>
struct LobePoint {
  F lx, ly, lz, alpha;
};

/// A round lobe of those that make up the whole: radiance is looked up along `axis` (not unit) at roughness `r`.
template <class F>
struct Tap {
  Vec3<F> axis;
  F r, weight;
};

/// A wide round lobe reaches below the horizon of the surface, where the lobe that it stands for has nothing: its axis
/// leans towards the normal, by lean alpha^2.
template <class F>
TESSERA_INLINE Tap<F> leaning_tap(const Vec3<F>& n, const Vec3<F>& l, F alpha, F lean, F weight) {
  const F a = min(alpha, F(1));
  const F leaning = a * a * lean;
  return {lerp(l, n, leaning), sqrt(a), weight};
}

// Points in the plane of incidence: the nodes of Gauss-Chebyshev quadrature of the second kind, which is exact for the
// disc's chords. alpha' of a tap is width alpha (v.b)/|b|^2 (1 - narrowing y^2). The three constants are fitted against
// the brute-force integral over three environments, r 0.2 to 1 and n.v 0.05 to 0.95: the mean error is 0.24 of the
// mirror direction's with 4 taps (0.21 of it at n.v below 0.5 and r to 0.6), 0.33 (0.39) with 2.
template <int count>
struct AxisTaps;
template <>
struct AxisTaps<2> {
  static constexpr int taps = 2;
  static constexpr float node[1] = {0.5f}, weight[1] = {1.0f};
  static constexpr double width = 1.21, narrowing = 0.225, lean = 0.85;
};
template <>
struct AxisTaps<4> {
  static constexpr int taps = 4;
  static constexpr float node[2] = {0.30901699f, 0.80901699f}, weight[2] = {0.90450850f, 0.34549150f};
  static constexpr double width = 1.07, narrowing = 0.4, lean = 0.7;
};

/// Point k along the lobe's long axis; ly is 0. The nodes spread with the sine of the view angle: seen along the normal
/// the lobe is round and all taps are one.
template <int count, class F>
TESSERA_INLINE LobePoint<F> lobe_point(AxisTaps<count>, const LobeView<F>& w, int k) {
  using Set = AxisTaps<count>;
  const F s = upper_part(w);
  const F middle = F(1) - s, reach = s * w.sin_v, wide = w.alpha * F(Set::width);
  const F node = F(k & 1 ? -Set::node[k >> 1] : Set::node[k >> 1]);
  const F y = mul_add(reach, node, middle), y2 = y * y;
  const F z = sqrt(max(F(1) - y2, F(0)));
  const F bx = w.alpha * mul_sub(w.hx, z, w.hz * y);
  const F bz = max(mul_add(w.hx, y, w.hz * z), F(0));
  const F per_b2 = F(1) / max(mul_add(bx, bx, bz * bz), F(1e-30));
  const F vb = max(mul_add(w.sin_v, bx, w.NoV * bz), F(0)) * per_b2;
  const F lx = mul_sub(vb + vb, bx, w.sin_v), lz = mul_sub(vb + vb, bz, w.NoV);
  return {lx, F(0), lz, wide * vb * neg_mul_add(y2, F(Set::narrowing), F(1))};
}
template <int count, class F>
TESSERA_INLINE Tap<F> tap_at(AxisTaps<count>, const LobeView<F>& w, const LobePoint<F>& p, int k) {
  using Set = AxisTaps<count>;
  const Vec3<F> l = {mul_add(w.n.x, p.lz, w.tangent.x * p.lx), mul_add(w.n.y, p.lz, w.tangent.y * p.lx),
                     mul_add(w.n.z, p.lz, w.tangent.z * p.lx)};
  return leaning_tap(w.n, l, p.alpha, F(Set::lean), F(Set::weight[k >> 1]) * visible_weight(w, p.lz));
}

// Points of the whole disc, in pairs (+-x, y); fitted with the two constants to the same integrals as the taps above:
// the mean error is 0.24 of the mirror direction's, 0.22 at grazing angles.
struct DiscTaps {
  static constexpr int taps = 8;
  static constexpr float x[4] = {0.154f, 0.575f, 0.015f, 0.324f}, y[4] = {0.0f, 0.118f, 0.698f, -0.620f};
  static constexpr double share = 1.6, lean = 1.0;
};

/// Point k of eight, each read at the width that it stands for: filtered importance sampling (Krivanek and Colbert
/// 2008) at run time, over prefiltered radiance. The density of l at a point is G1(v) D / (4 n.v) with D = |b|^4 / (pi
/// alpha^2), the round lobe's at its peak 1 / (4 pi alpha'^2): N points share the lobe at alpha' = alpha / |b|^2
/// sqrt(c (n.v + root(n.v)) / 2N).
template <class F>
TESSERA_INLINE LobePoint<F> lobe_point(DiscTaps, const LobeView<F>& w, int k) {
  const F share = w.alpha * sqrt((w.NoV + w.root_v) * F(DiscTaps::share / (2 * DiscTaps::taps)));
  const F s = upper_part(w);
  const F x = F(k & 1 ? -DiscTaps::x[k >> 1] : DiscTaps::x[k >> 1]);
  const F inside = F(1) - x * x;
  const F y = mul_add(s, F(DiscTaps::y[k >> 1]), (F(1) - s) * sqrt(inside));
  const F z = sqrt(max(neg_mul_add(y, y, inside), F(0)));
  const F bx = w.alpha * mul_sub(w.hx, z, w.hz * y), by = w.alpha * x;
  const F bz = max(mul_add(w.hx, y, w.hz * z), F(0));
  const F per_b2 = F(1) / max(mul_add(bx, bx, mul_add(by, by, bz * bz)), F(1e-30));
  const F vb = max(mul_add(w.sin_v, bx, w.NoV * bz), F(0)) * per_b2;
  const F twice = vb + vb;
  return {mul_sub(twice, bx, w.sin_v), twice * by, mul_sub(twice, bz, w.NoV), share * per_b2};
}
template <class F>
TESSERA_INLINE Tap<F> tap_at(DiscTaps, const LobeView<F>& w, const LobePoint<F>& p, int) {
  const Vec3<F> bitangent = cross(w.n, w.tangent);
  const Vec3<F> l = {mul_add(w.n.x, p.lz, mul_add(bitangent.x, p.ly, w.tangent.x * p.lx)),
                     mul_add(w.n.y, p.lz, mul_add(bitangent.y, p.ly, w.tangent.y * p.lx)),
                     mul_add(w.n.z, p.lz, mul_add(bitangent.z, p.ly, w.tangent.z * p.lx))};
  return leaning_tap(w.n, l, p.alpha, F(DiscTaps::lean), visible_weight(w, p.lz));
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

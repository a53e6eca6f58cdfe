// Fresnel reflectance beside Schlick's form: cheaper powers, corrections for metals, and the exact equations. Per
// channel; F0 = reflectance at normal incidence and VoH in [0,1]. Results are in [0,1] unless said otherwise.
#pragma once
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/math/approx.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Schlick's form with (1 - VoH)^5 as the exponential of a parabola. At VoH = 1 the weight is 1.7e-4, not 0.
template <class F>
TESSERA_INLINE F F_SchlickGaussian(F f0, F VoH) {
  // Karis 2013, Real Shading in Unreal Engine 4, eq. 5.
  return F_SchlickWeighted(f0, exp2((F(-5.55473) * VoH - F(6.98316)) * VoH));
}

/// The same with one term: (1 - VoH)^5 as 2^(-8.35 VoH).
template <class F>
TESSERA_INLINE F F_SchlickGaussianSingle(F f0, F VoH) {
  // Lagarde 2012, Spherical Gaussian approximation for Blinn-Phong, Phong and Fresnel.
  return F_SchlickWeighted(f0, exp2(F(-8.35) * VoH));
}

/// Schlick's form that fades out below F0 = 2 %, which no real material has: a way to switch the lobe off.
template <class F>
TESSERA_INLINE F F_SchlickTwoPercent(F f0, F f0_green, F VoH) {
  // Unreal Engine 4, F_Schlick in BRDF.ush, after Karis 2013.
  const F weight = schlick_weight(VoH);
  return mul_add(F(1) - weight, f0, min(F(50) * f0_green, F(1)) * weight);
}

/// Schlick's form for rough surfaces under an environment; roughness perceptual.
template <class F>
TESSERA_INLINE F F_SchlickRough(F f0, F NoV, F roughness) {
  return F_SchlickRoughness(f0, schlick_weight(NoV), roughness);
}

/// Schlick with a correction for metals: the reflectance at 82 degrees (cosine 1/7) is F82. Not below 0.
template <class F>
TESSERA_INLINE F F_Schlick82(F f0, F f82, F VoH) {
  // Hoffman 2019, Fresnel Equations Considered Harmful, eq. 6, a choice of parameters for the error term of Lazanyi &
  // Szirmay-Kalos 2005: a VoH (1 - VoH)^6, largest at 1/7.
  constexpr double peak = 1.0 / 7, rest = 6.0 / 7, weight5 = rest * rest * rest * rest * rest;
  const F schlick_at_peak = mul_add(F(1) - f0, F(weight5), f0);
  const F a = (schlick_at_peak - f82) * F(1 / (peak * weight5 * rest));
  const F m = F(1) - VoH;
  const F m2 = m * m;
  const F m6 = m2 * m2 * m2;
  return saturate(neg_mul_add(a * VoH, m6, F_Schlick(f0, VoH)));
}

/// Schlick with the error term a VoH (1 - VoH)^power, both fitted to one metal. Clamped to [0,1].
template <class F>
TESSERA_INLINE F F_LazanyiSzirmayKalos(F f0, F a, F power, F VoH) {
  // Lazanyi & Szirmay-Kalos 2005, Fresnel Term Approximations for Metals, eq. 5; its leading term is Schlick's with the
  // F0 of a complex index.
  const F m = max(F(1) - VoH, F(0));
  return saturate(neg_mul_add(a * VoH, pow(m, power), F_Schlick(f0, VoH)));
}

/// Exact, unpolarised, from eta - 1: for an index near 1 the difference has digits that the index has lost.
template <class F>
TESSERA_INLINE F dielectric_reflectance(F eta_minus_1, F VoH) {
  // Cook & Torrance 1982, A Reflectance Model for Computer Graphics, eq. 16: g^2 = eta^2 + c^2 - 1.
  // (g - c)/(g + c) and the second factor by differences that do not cancel: g^2 - c^2 = eta^2 - 1 =: d, so
  // g - c = d / (g + c).
  const F d = eta_minus_1 * (eta_minus_1 + F(2));
  const F g2 = mul_add(VoH, VoH, d);
  const F g = sqrt(max(g2, F(0)));
  const F sum = max(g + VoH, F(1e-18));
  const F A = d / (sum * sum);
  // (c (g + c) - 1) / (c (g - c) + 1), and c (g - c) = c d / (g + c)
  const F B = mul_sub(VoH, sum, F(1)) / mul_add(VoH, d / sum, F(1));
  const F reflectance = F(0.5) * (A * A) * mul_add(B, B, F(1));
  return select((g2 <= F(0)) & (d < F(0)), F(1), min(reflectance, F(1)));
}

/// Exact, unpolarised, for a dielectric seen from outside or within; eta = index behind over index before it, in
/// (0,10]. 1 for total internal reflection; 0 at every angle where there is no interface (eta = 1).
template <class F>
TESSERA_INLINE F F_Dielectric(F eta, F VoH) {
  return dielectric_reflectance(eta - F(1), VoH);
}

/// Exact for the dielectric that has this F0 < 1: eta = (1 + sqrt F0) / (1 - sqrt F0).
template <class F>
TESSERA_INLINE F F_CookTorrance(F f0, F VoH) {
  // Cook & Torrance 1982, section 4, as eta - 1 = 2 sqrt F0 (1 + sqrt F0) / (1 - F0): no digits lost at either end.
  // 1 - 2^-20: F0 = 1 has no finite index.
  const F bounded = min(f0, F(1 - 0x1p-20));
  const F root = sqrt(bounded);
  return dielectric_reflectance(F(2) * root * (F(1) + root) / (F(1) - bounded), VoH);
}

/// Exact for the dielectric that has this F0, from its square root with no index in between. At F0 = 0 nothing is
/// reflected but at VoH = 0, where everything is.
template <class F>
TESSERA_INLINE F F_Gotanda(F f0, F VoH) {
  // Gotanda 2014, Designing Reflectance Models for New Consoles, the Fresnel term in sqrt F0: with s = sqrt F0,
  // p = 1 + s, m = 1 - s and q = p alpha, where alpha^2 = 1 - (m/p)^2 (1 - c^2), the two polarisations reflect
  // ((p^2 c - m q) / (p^2 c + m q))^2 and ((q - m c) / (q + m c))^2.
  // Without the differences, which cancel for small F0 and at grazing angles: p^2 - m^2 = 4 s gives
  // q^2 = 4 s + m^2 c^2, and both numerators have 4 s as a factor.
  const F c = max(VoH, F(1e-18));  // 0 / 0 at VoH = 0 where F0 is 0 or 1
  const F s = sqrt(f0), p = F(1) + s;
  // What rounding took from the root: near F0 = 1 it is a large part of 1 - s.
  const F rest = neg_mul_add(s, s, f0), m = neg_mul_add(F(0.5), rest, F(1) - s);
  const F p2 = p * p, mc = m * c, four_s = F(4) * s;
  const F q = sqrt(mul_add(mc, mc, four_s));
  const F perpendicular = mul_add(p2, c, m * q), parallel = q + mc;
  const F Rs = four_s * mul_sub(F(2) * mul_add(s, s, F(1)), c * c, m * m) / (perpendicular * perpendicular);
  const F Rp = four_s / (parallel * parallel);
  return min(F(0.5) * mul_add(Rs, Rs, Rp * Rp), F(1));
}

/// Exact, unpolarised, for a metal of relative index eta + i k; eta in (0,10], k in [0,20].
template <class F>
TESSERA_INLINE F F_Conductor(F eta, F k, F VoH) {
  // Born & Wolf, Principles of Optics, section 14.2; as Lagarde 2013, Memo on Fresnel equations.
  // t0 = eta^2 - k^2 - sin^2, a2b2 = a^2 + b^2 with (a + i b)^2 = t0 + 2 i eta k.
  const F c2 = VoH * VoH;
  const F s2 = F(1) - c2;
  const F t0 = mul_sub(eta, eta, mul_add(k, k, s2));
  const F two_eta_k = F(2) * eta * k;
  const F a2b2 = sqrt(mul_add(t0, t0, two_eta_k * two_eta_k));
  // a^2 = (a2b2 + t0) / 2, without cancellation where t0 < 0: (a2b2 + t0)(a2b2 - t0) = (2 eta k)^2
  const F larger = a2b2 + abs(t0);
  const F a2 = F(0.5) * select(t0 < F(0), two_eta_k * two_eta_k / max(larger, F(1e-37)), larger);
  const F cross = F(2) * VoH * sqrt(max(a2, F(0)));
  const F Rs = (a2b2 + c2 - cross) / max(a2b2 + c2 + cross, F(1e-37));
  const F across = cross * s2, along = mul_add(c2, a2b2, s2 * s2);
  const F Rp = Rs * (along - across) / max(along + across, F(1e-37));
  return saturate(F(0.5) * (Rs + Rp));
}

/// The complex index that has reflectance r at normal incidence and an edge tint g, both in [0,1): then the exact
/// equations. r is clamped to 0.9999.
template <class F>
TESSERA_INLINE F F_Gulbrandsen(F r_in, F g, F VoH) {
  // Gulbrandsen 2014, Artist Friendly Metallic Fresnel, eq. 2, 11 and 12.
  const F r = min(r_in, F(0.9999));
  const F root = sqrt(r);
  const F eta = mul_add(g, (F(1) - r) / (F(1) + r), (F(1) - g) * ((F(1) + root) / (F(1) - root)));
  const F up = eta + F(1), down = eta - F(1);
  const F k2 = max((r * up * up - down * down) / (F(1) - r), F(0));
  return F_Conductor(eta, sqrt(k2), VoH);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

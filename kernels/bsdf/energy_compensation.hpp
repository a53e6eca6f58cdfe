// Compensation for what single scattering loses: light that leaves a microfacet only to meet another. Each method
// exists in two forms:
//   f_NAME      for a light: value of the compensated lobe, given the value of the single-scattering lobe (D V F);
//   split_NAME  for an environment: weight of the prefiltered radiance and of irradiance / pi, given A and B of the
//               environment BRDF (integral of the lobe = F0 A + B, so E = A + B).
// F0 in [0,1], one channel; Schlick's Fresnel. NoV, NoL, alpha in [0,1]. All outputs are finite and >= 0 there.
#pragma once
#include "kernels/bsdf/distribution.hpp"
#include "kernels/bsdf/energy.hpp"
#include "kernels/bsdf/energy_loss.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// One channel of EnvironmentSplit.
template <class F>
struct ChannelSplit {
  F single, multiple;
};

/// Cosine-weighted mean of Schlick's Fresnel: 2 integral F(mu) mu dmu = F0 + (1 - F0) / 21, exactly.
template <class F>
TESSERA_INLINE F Favg_Schlick(F f0) {
  return mul_add(F(1) - f0, F(1.0 / 21), f0);
}

// ------------------------------------------------------------------------------------------------- no compensation

template <class F>
TESSERA_INLINE F f_SingleScattering(F single) {
  return single;
}

template <class F>
TESSERA_INLINE ChannelSplit<F> split_SingleScattering(F f0, F A, F B) {
  return {mul_add(f0, A, B), F(0)};
}

// ------------------------------------------------------------------------------------------------- Kulla and Conty

/// Share of the lost light that returns after further bounces: each costs Favg, of what is left Eavg leaves.
/// Kulla, Conty 2017, Revisiting Physically Based Shading at Imageworks, with the series begun at the second facet, as
/// Hill 2018, A Multi-Faceted Exploration (part 2), corrected it: Favg^2 Eavg / (1 - Favg (1 - Eavg)).
template <class F>
TESSERA_INLINE F Fms_KullaConty(F f0, F Emsavg) {
  const F Favg = Favg_Schlick(f0);
  // 1e-6: Favg = 1 and Eavg = 0, which no GGX reaches (Eavg >= 0.409).
  return Favg * Favg * (F(1) - Emsavg) / max(neg_mul_add(Favg, Emsavg, F(1)), F(1e-6));
}

/// The same as the slides had it at first, the series begun at the first facet: Favg Eavg / (1 - Favg (1 - Eavg)).
template <class F>
TESSERA_INLINE F Fms_KullaConty_slides(F f0, F Emsavg) {
  const F Favg = Favg_Schlick(f0);
  return Favg * (F(1) - Emsavg) / max(neg_mul_add(Favg, Emsavg, F(1)), F(1e-6));
}

/// fms = Ems(v) Ems(l) / (pi (1 - Eavg)): reciprocal, and returns what was lost whatever v. Kulla, Conty 2017.
template <class F>
TESSERA_INLINE F fms_KullaConty(F Ems_v, F Ems_l, F Emsavg) {
  // 1e-37: alpha = 0, where all three vanish.
  return Ems_v * (Ems_l / max(Emsavg, F(1e-37))) * F(1 / pi);
}

template <class F>
TESSERA_INLINE F f_KullaConty(F single, F f0, F NoV, F NoL, F alpha) {
  const EmsPolynomial<F> p = ems_polynomial(alpha);
  const F Emsavg = Emsavg_GGX_polynomial(alpha);
  return mul_add(Fms_KullaConty(f0, Emsavg), fms_KullaConty(ems_at(p, NoV, alpha), ems_at(p, NoL, alpha), Emsavg),
                 single);
}

template <class F>
TESSERA_INLINE F f_KullaConty_slides(F single, F f0, F NoV, F NoL, F alpha) {
  const EmsPolynomial<F> p = ems_polynomial(alpha);
  const F Emsavg = Emsavg_GGX_polynomial(alpha);
  return mul_add(Fms_KullaConty_slides(f0, Emsavg),
                 fms_KullaConty(ems_at(p, NoV, alpha), ems_at(p, NoL, alpha), Emsavg), single);
}

/// Ems from a table (Ems_GGX_lookup).
template <class F>
TESSERA_INLINE F f_KullaConty_lookup(const float* texels, int size, F single, F f0, F NoV, F NoL, F alpha) {
  const F Emsavg = Emsavg_GGX(alpha);
  const F v = Ems_GGX_lookup(texels, size, NoV, alpha), l = Ems_GGX_lookup(texels, size, NoL, alpha);
  return mul_add(Fms_KullaConty(f0, Emsavg), fms_KullaConty(v, l, Emsavg), single);
}

/// Environment: the integral of the lobe over l, Fms Ems(v), with Ems = 1 - (A + B).
template <class F>
TESSERA_INLINE ChannelSplit<F> split_KullaConty(F f0, F A, F B, F alpha) {
  return {mul_add(f0, A, B), Fms_KullaConty(f0, Emsavg_GGX(alpha)) * max(F(1) - (A + B), F(0))};
}

// -------------------------------------------------------------------------------------------------------- Turquin

/// Turquin 2019, Practical Multiple Scattering Compensation for Microfacet Models: the lobe's own shape, scaled by
/// 1 + F0 (1 - E) / E. Not reciprocal, for E is taken at v.
template <class F>
TESSERA_INLINE F scale_Turquin(F f0, F Ems) {
  // E >= 0.306 for GGX; 1e-3 keeps other arguments from dividing by 0.
  return mul_add(f0, Ems / max(F(1) - Ems, F(1e-3)), F(1));
}

template <class F>
TESSERA_INLINE F f_Turquin(F single, F f0, F NoV, F alpha) {
  return single * scale_Turquin(f0, Ems_GGX(NoV, alpha));
}

template <class F>
TESSERA_INLINE F f_Turquin_lookup(const float* texels, int size, F single, F f0, F NoV, F alpha) {
  return single * scale_Turquin(f0, Ems_GGX_lookup(texels, size, NoV, alpha));
}

template <class F>
TESSERA_INLINE ChannelSplit<F> split_Turquin(F f0, F A, F B) {
  return {mul_add(f0, A, B) * scale_Turquin(f0, max(F(1) - (A + B), F(0))), F(0)};
}

// ----------------------------------------------------------------------------------------------------------- Hill

/// Share of the lost light that returns, by powers of F0: each bounce of the random walk multiplies by Schlick's
/// Fresnel, a polynomial of degree 1 in F0, so that the sum over bounces is a series in F0 whose coefficients depend on
/// the angle and the roughness and are precomputed from walks. Hill 2019, A Multi-Faceted Exploration (part 4); the
/// coefficients are an own fit: 1 - (1 - F0) (t0 + t1 F0 + t2 F0^2), each t of degree 3 in sqrt(NoV) and roughness
/// together; within 5e-3 (mean 6e-4) in Fms Ems of 150,000 walks each at 90 places x 10 F0.
template <class F>
TESSERA_INLINE F Fms_Hill(F f0, F NoV, F alpha) {
  constexpr double t[3][10] = {
      {-0.0484193, 2.96472, -2.81202, 0.892422, 1.05756, -1.96375, 0.912039, -0.312212, 0.289995, 0.0263826},
      {-0.241626, 1.18686, 1.01798, -1.04577, 0.535583, -1.68785, 0.871522, 1.224, -0.518677, -0.455216},
      {-0.0900434, 0.738135, -0.743663, 0.0755003, 0.0655605, -2.40385, 2.54351, 0.916867, 0.129099, -0.493353}};
  const F x = sqrt(saturate(NoV)), r = sqrt(saturate(alpha));
  F sum = F(0);
  for (int k = 2; k >= 0; --k) {
    // Ordered as x^i r^j: i = 0: 1 r r2 r3; i = 1: 1 r r2; i = 2: 1 r; i = 3: 1.
    const double* c = t[k];
    const F c0 = mul_add(mul_add(mul_add(F(c[3]), r, F(c[2])), r, F(c[1])), r, F(c[0]));
    const F c1 = mul_add(mul_add(F(c[6]), r, F(c[5])), r, F(c[4]));
    const F c2 = mul_add(F(c[8]), r, F(c[7]));
    const F term = mul_add(mul_add(mul_add(F(c[9]), x, c2), x, c1), x, c0);
    sum = mul_add(sum, f0, term);
  }
  return saturate(neg_mul_add(F(1) - f0, sum, F(1)));
}

/// As Kulla-Conty's lobe, with the series in place of Fms. The series knows v alone: not reciprocal but at F0 = 1.
template <class F>
TESSERA_INLINE F f_Hill(F single, F f0, F NoV, F NoL, F alpha) {
  const EmsPolynomial<F> p = ems_polynomial(alpha);
  const F lobe = fms_KullaConty(ems_at(p, NoV, alpha), ems_at(p, NoL, alpha), Emsavg_GGX_polynomial(alpha));
  return mul_add(Fms_Hill(f0, NoV, alpha), lobe, single);
}

template <class F>
TESSERA_INLINE ChannelSplit<F> split_Hill(F f0, F A, F B, F NoV, F alpha) {
  return {mul_add(f0, A, B), Fms_Hill(f0, NoV, alpha) * max(F(1) - (A + B), F(0))};
}

// ---------------------------------------------------------------------------------------------------- Fdez-Aguera

/// Fdez-Aguera 2019, A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting, section 3, with F0 as
/// the derivation has it.
template <class F>
TESSERA_INLINE ChannelSplit<F> split_FdezAguera(F f0, F A, F B) {
  const F single = mul_add(f0, A, B), Ems = max(F(1) - (A + B), F(0)), Favg = Favg_Schlick(f0);
  return {single, Ems * single * Favg / max(neg_mul_add(Favg, Ems, F(1)), F(1e-6))};
}

/// The same with the roughness-dependent kS of the published listing (energy.hpp: what the renderer's shading uses).
template <class F>
TESSERA_INLINE ChannelSplit<F> split_FdezAguera_kS(F f0, F A, F B, F NoV, F roughness) {
  F single, all;
  split_channel(f0, A, B, schlick_weight(NoV), roughness, &single, &all);
  return {single, all - single};
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

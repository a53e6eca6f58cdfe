// The energy-preserving form of Oren and Nayar's model. Portsmouth, Kutz, Hill 2025, EON: A Practical Energy-Preserving
// Rough Diffuse BRDF (JCGT 14, 1).
//
// Fujii's single-scattering lobe has the directional albedo E(mu) = A (1 + r G(mu) / pi), A = 1 / (1 + c1 r), and the
// average A (1 + c2 r); so what it loses, 1 - E = A r (c1 - G / pi), and 1 - average = A r (c1 - c2), and the lobe of
// light that met several facets, (1 - E)(1 - E') / (pi (1 - average)), is
//   A r (c1 - G / pi)(c1 - G' / pi) / (pi (c1 - c2))
// with neither a cancellation nor a 0 / 0 at r = 0, which the published code guards with an epsilon.
//
// Cosines in [0,1] (LoV in [-1,1]), albedo and roughness in [0,1], ends included: finite and not negative there.
#pragma once
#include "kernels/bsdf/diffuse.hpp"
#include "kernels/math/trigonometric.hpp"

namespace tessera::TESSERA_ISA {
namespace {

inline constexpr double fujii_c1 = 0.5 - 2 / (3 * pi), fujii_c2 = 2.0 / 3 - 28 / (15 * pi);

/// c1 - G(mu) / pi exactly; 0 at the horizon.
template <class F>
TESSERA_INLINE F fujii_loss(F mu) {
  // The paper's listing 1, E_FON_exact, with (1 - sin^3) / mu = mu (1 + sin + sin^2) / (1 + sin).
  const F sine = sqrt(max(neg_mul_add(mu, mu, F(1)), F(0)));
  const F series = mul_add(mul_add(sine, sine, sine + F(1)) / (sine + F(1)), mu, F(-1));
  const F G = sine * mul_add(F(2.0 / 3), series, neg_mul_add(sine, mu, acos(mu)));
  return max(neg_mul_add(G, F(1 / pi), F(fujii_c1)), F(0));
}

/// The same by a polynomial, within 6.1e-4; 0 where that is negative, near the horizon.
template <class F>
TESSERA_INLINE F fujii_loss_fit(F mu) {
  // The paper's listing 1, E_FON_approx.
  const F x = F(1) - mu;
  F G = mul_add(F(0.0714429953), x, F(-0.332181442));
  G = mul_add(G, x, F(0.491881867));
  G = mul_add(G, x, F(0.0571085289));
  return max(neg_mul_add(G, x, F(fujii_c1)), F(0));
}

/// What a channel's albedo multiplies: f = single albedo + multiple albedo^2 average / (1 - albedo (1 - average)).
template <class F>
struct EONLobes {
  F single, multiple, average;
};

template <class F>
TESSERA_INLINE EONLobes<F> eon_lobes(F roughness, F NoV, F NoL, F LoV, F loss_v, F loss_l) {
  const F A = F(1) / mul_add(F(fujii_c1), roughness, F(1));
  // Fujii's change to Oren and Nayar: s / max(NoL, NoV) where s > 0, s itself where light and eye face each other.
  const F s = neg_mul_add(NoL, NoV, LoV);
  const F s_over_t = select(s > F(0), over_larger_cosine(s, NoV, NoL), s);
  const F shape = max(mul_add(roughness, s_over_t, F(1)), F(0));  // negative by rounding only, for unit vectors
  return {A * shape * F(1 / pi), A * roughness * (loss_v * loss_l) * F(1 / (pi * (fujii_c1 - fujii_c2))),
          A * mul_add(F(fujii_c2), roughness, F(1))};
}

/// One channel. albedo = that of a single facet.
template <class F>
TESSERA_INLINE F eon_channel(const EONLobes<F>& lobes, F albedo) {
  const F kept = albedo * albedo * lobes.average / neg_mul_add(albedo, F(1) - lobes.average, F(1));
  return mul_add(albedo, lobes.single, kept * lobes.multiple);
}

/// One channel, with the fitted directional albedo. A white surface returns 1 within 3e-4.
template <class F>
TESSERA_INLINE F Fd_EON(F albedo, F roughness, F NoV, F NoL, F LoV) {
  return eon_channel(eon_lobes(roughness, NoV, NoL, LoV, fujii_loss_fit(NoV), fujii_loss_fit(NoL)), albedo);
}

/// One channel, with the exact directional albedo: white stays white.
template <class F>
TESSERA_INLINE F Fd_EONExact(F albedo, F roughness, F NoV, F NoL, F LoV) {
  return eon_channel(eon_lobes(roughness, NoV, NoL, LoV, fujii_loss(NoV), fujii_loss(NoL)), albedo);
}

/// The single-scattering part alone, for albedo 1: Fujii 2012, A Tiny Improvement of Oren-Nayar Reflectance Model.
template <class F>
TESSERA_INLINE F Fd_Fujii(F roughness, F NoV, F NoL, F LoV) {
  return eon_lobes(roughness, NoV, NoL, LoV, F(0), F(0)).single;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

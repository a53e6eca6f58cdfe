// Diffuse lobes: BRDF values, cosine not included.
//
// Cosines in [0,1] (LoV in [-1,1]), albedo and roughness in [0,1], ends included: finite and not negative there.
#pragma once
#include "kernels/bsdf/distribution.hpp"
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/math/vector.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Lambert: the same radiance in every direction. albedo in [0,1].
template <class F>
TESSERA_INLINE Vec3<F> Fd_Lambert(const Vec3<F>& albedo) {
  return albedo * F(1 / pi);
}

// The following are proportional to the albedo: they return the value for albedo 1.

/// (1 + (f90 - 1)(1 - NoL)^5)(1 + (f90 - 1)(1 - NoV)^5) / pi.
template <class F>
TESSERA_INLINE F burley_lobe(F f90, F NoV, F NoL) {
  const F rise = f90 - F(1);
  const F light = mul_add(rise, schlick_weight(NoL), F(1)), view = mul_add(rise, schlick_weight(NoV), F(1));
  return light * view * F(1 / pi);
}

/// Burley 2012. roughness perceptual; LoH = cosine between l (or v) and the half vector. Reflects more than it receives
/// for rough surfaces at grazing angles.
template <class F>
TESSERA_INLINE F Fd_Burley(F roughness, F NoV, F NoL, F LoH) {
  // Burley 2012, Physically-Based Shading at Disney, section 5.3: FD90 = 0.5 + 2 roughness LoH^2.
  return burley_lobe(mul_add(F(2) * roughness, LoH * LoH, F(0.5)), NoV, NoL);
}

/// Burley's lobe renormalised, so that with a specular lobe over it little more than 1 comes back.
template <class F>
TESSERA_INLINE F Fd_Frostbite(F roughness, F NoV, F NoL, F LoH) {
  // Lagarde and de Rousiers 2014, Moving Frostbite to Physically Based Rendering, listing 2: energyBias = 0.5 r,
  // energyFactor = lerp(1, 1 / 1.51, r).
  const F f90 = roughness * mul_add(F(2) * LoH, LoH, F(0.5));
  return burley_lobe(f90, NoV, NoL) * mul_add(roughness, F(1 / 1.51 - 1), F(1));
}

// What Oren and Nayar's cos(phi) sin(alpha) tan(beta) is in cosines: s / max(NoL, NoV), s = LoV - NoL NoV.
template <class F>
TESSERA_INLINE F over_larger_cosine(F s, F NoV, F NoL) {
  return s / max(max(NoV, NoL), F(1e-10));  // 1e-10: both in the horizon, where s / 0 has no limit
}

/// Oren and Nayar's qualitative model: facets are Lambertian V-shaped grooves, whose slope angle has the standard
/// deviation sigma, radians, [0, pi/2). No light between facets: loses 38 % of the energy at sigma = 1.
template <class F>
TESSERA_INLINE F Fd_OrenNayar(F sigma, F NoV, F NoL, F LoV) {
  // Oren and Nayar 1994, Generalization of Lambert's Reflectance Model, eq. 30.
  const F sigma2 = sigma * sigma;
  const F A = F(1) - F(0.5) * sigma2 / (sigma2 + F(0.33)), B = F(0.45) * sigma2 / (sigma2 + F(0.09));
  const F s = max(neg_mul_add(NoL, NoV, LoV), F(0));
  return mul_add(B, over_larger_cosine(s, NoV, NoL), A) * F(1 / pi);
}

/// Ashikhmin and Shirley's diffuse lobe under a specular one of reflectance F0; what Fresnel's weight takes away is
/// taken from either direction, so that it is reciprocal. For albedo 1.
template <class F>
TESSERA_INLINE F Fd_AshikhminShirley(F f0, F NoV, F NoL) {
  // Ashikhmin and Shirley 2000, An Anisotropic Phong BRDF Model, eq. 5. 1 - (1 - x)^5 = x (5 - 10 x + 10 x^2 - 5 x^3 +
  // x^4): no cancellation for small x = cosine / 2.
  const auto entering = [](F cosine) {
    const F x = F(0.5) * cosine;
    return x * mul_add(mul_add(mul_add(x - F(5), x, F(10)), x, F(-10)), x, F(5));
  };
  return (F(1) - f0) * entering(NoV) * entering(NoL) * F(28 / (23 * pi));
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// The environment BRDF: the directional albedo of the GGX lobe with height-correlated Smith masking, split by the
// weights of F0 and F90 in Schlick's Fresnel term, A = integral of D V (1 - Fc) n.l and B = integral of D V Fc n.l.
//
// With half-vectors by their slopes, h ~ (alpha p, 1), the integral over light directions becomes, for v in the xz
// plane,
//     E = integral over p of G2(v, l) (v.h) / (n.v n.h) P(p) dp,   P(p) = 1 / (pi (1 + |p|^2)^2).
// Light above the horizon, n.l > 0, means |alpha p|^2 - 2 tan(theta_v) alpha p.x < 1: a disc that holds the origin, so
// that along each azimuth phi the integral runs from 0 to R(phi) in closed form and meets no discontinuity.
// |p| = tan(psi), psi = 2 atan(t) makes every term rational in t:
//     E = 1/pi integral dphi integral over t of  G2 (v.h~) 16 t / (n.v (1 + t^2)^3),  h~ = (2 alpha t cos phi, ., 1 -
//     t^2)
// (both half circles in phi). Gauss-Legendre in t and in phi, nodes crowded to where n.l vanishes (t's upper end) and
// to phi = pi/2, where R changes fastest at grazing angles.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

struct QuadratureNode {
  float x, weight;
};

// 16-point Gauss-Legendre on [0, 1] through x -> 1 - (1 - x)^3, and 8-point through x -> sin(pi/2 x^2) = |cos(phi)|,
// its weight for one quarter turn as a fraction of the half circle. Against 400 x 200 points the table's nodes (128 x
// 128) err by at most 2.4e-6 in A and 7.2e-6 in B; in float by 1e-7 more.
inline constexpr QuadratureNode dfg_radial[16] = {
    {0.015814491215844217f, 0.040298146961025433f},  {0.080854802032433115f, 0.088276400096411453f},
    {0.18831521922902583f, 0.12420254698994876f},    {0.32385231254158697f, 0.14401397815284825f},
    {0.47064635523825893f, 0.14683913345491398f},    {0.61256613634369317f, 0.13484816816133979f},
    {0.73686954362575818f, 0.11247281557635518f},    {0.83587782820771106f, 0.085185453195976008f},
    {0.9073516390230536f, 0.058185186211563045f},    {0.95365503651562678f, 0.035340160484751311f},
    {0.98009933719467446f, 0.018633382261822793f},   {0.99302535471390441f, 0.0081914218333843901f},
    {0.99817082233678378f, 0.002796066710079276f},   {0.99969674686042154f, 0.00064428166221945182f},
    {0.99997871730721843f, 7.1714380304062559e-05f}, {0.99999985116239243f, 1.1438670569991468e-06f}};
inline constexpr QuadratureNode dfg_azimuth[8] = {
    {0.00061924537402488044f, 0.0010049499256588044f}, {0.016235242282782295f, 0.01130437977295156f},
    {0.08828911256925541f, 0.037210909065728201f},     {0.25886164850736487f, 0.074038753308845615f},
    {0.52267184673636735f, 0.10730313838033537f},      {0.79189658813044617f, 0.11964241387321549f},
    {0.9543979979931273f, 0.099886137453735674f},      {0.99809362383619871f, 0.049609318219529588f}};

template <class F>
struct Dfg {
  F A, B;
};

/// NoV in (0, 1], r = perceptual roughness in (0, 1].
template <class F>
inline Dfg<F> integrate_dfg(F NoV, F r) {
  const F alpha = r * r, alpha2 = alpha * alpha;
  const F sin_v = sqrt(max(neg_mul_add(NoV, NoV, F(1)), F(0)));
  const F tan_v = sin_v / NoV;
  const F rest = F(1) - alpha2;
  const F lambda_v = sqrt(mul_add(rest, NoV * NoV, alpha2));
  F A = F(0), B = F(0);
  for (int k = 0; k < 16; ++k) {
    const QuadratureNode azimuth = dfg_azimuth[k & 7];
    const F cosine = F(k < 8 ? azimuth.x : -azimuth.x);
    const F shift = tan_v * cosine;
    const F root = sqrt(mul_add(shift, shift, F(1)));
    // shift + root, without cancellation on the far side.
    const F radius = (k < 8 ? shift + root : F(1) / (root - shift)) / alpha;
    // tan(psi / 2) <= 1; alpha below 1e-19 makes the radius infinite, and infinity / infinity.
    const F limit = saturate(F(1) / (F(1) / radius + sqrt(mul_add(F(1) / radius, F(1) / radius, F(1)))));
    F ring_a = F(0), ring_b = F(0);
    for (const QuadratureNode& node : dfg_radial) {
      const F t = limit * F(node.x);
      const F across = F(2) * alpha * t;
      const F hz = (F(1) - t) * (F(1) + t);
      const F scale = F(1) / sqrt(mul_add(across, across, hz * hz));
      const F VoH_unscaled = mul_add(across * cosine, sin_v, hz * NoV);
      const F VoH = VoH_unscaled * scale;
      const F NoL = max(mul_sub(F(2) * VoH, hz * scale, NoV), F(0));
      const F lambda_l = sqrt(mul_add(rest, NoL * NoL, alpha2));
      const F q = mul_add(t, t, F(1));
      // G2 = 2 NoL NoV / (NoL lambda_v + NoV lambda_l); its NoV is that of the derivation's denominator.
      const F weight =
          F(16) * F(node.weight) * t * NoL * VoH_unscaled / (q * q * q * mul_add(NoL, lambda_v, NoV * lambda_l));
      const F m = max(F(1) - VoH, F(0));
      const F m2 = m * m;
      const F fresnel = m2 * m2 * m;
      ring_a = mul_add(weight, F(1) - fresnel, ring_a);
      ring_b = mul_add(weight, fresnel, ring_b);
    }
    const F ring = limit * F(azimuth.weight);
    A = mul_add(ring, ring_a, A);
    B = mul_add(ring, ring_b, B);
  }
  return {A, B};
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

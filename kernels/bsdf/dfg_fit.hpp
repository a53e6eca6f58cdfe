// The environment BRDF (A, B), integral of the specular lobe = F0 A + F90 B, without a table: published fits and two of
// our own. All take NoV and perceptual roughness in [0,1] (anything else is clamped) and return A, B >= 0, finite.
#pragma once
#include "kernels/math/approx.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

template <class F>
struct EnvironmentFit {
  F A, B;
};

/// Fitted to Blinn-Phong with Treyarch's gloss; with gloss = 1 - roughness, as renderers took it over.
template <class F>
TESSERA_INLINE EnvironmentFit<F> dfg_Lazarov(F NoV, F roughness) {
  // Lazarov 2013, Getting More Physical in Call of Duty: Black Ops II, "Environment BRDF" (the listing at its end).
  const F c = saturate(NoV), g = F(1) - saturate(roughness);
  const F a0 = mul_add(g * F(1 / 0.96), min(g * F(0.475), exp2(F(-9.28) * c)),
                       mul_add(g, F((0.0275 - 0.25 * 0.04) / 0.96), F((0.015 - 0.75 * 0.04) / 0.96)));
  const F a1 = mul_add(g, F(0.25), F(0.75));
  return {max(a1 - a0, F(0)), max(a0, F(0))};
}

/// Lazarov's form fitted to Karis's G.
template <class F>
TESSERA_INLINE EnvironmentFit<F> dfg_Karis(F NoV, F roughness) {
  // Karis 2014, Physically Based Shading on Mobile, EnvBRDFApprox.
  const F c = saturate(NoV), r = saturate(roughness);
  const F x = F(1) - r;
  const F y = mul_add(r, F(-0.0275), F(0.0425)), z = mul_add(r, F(-0.572), F(1.04)), w = mul_add(r, F(0.022), F(-0.04));
  const F a004 = mul_add(min(x * x, exp2(F(-9.28) * c)), x, y);
  return {max(mul_add(F(-1.04), a004, z), F(0)), max(mul_add(F(1.04), a004, w), F(0))};
}

/// Quotients of biquadratic polynomials in n.v and alpha.
template <class F>
TESSERA_INLINE EnvironmentFit<F> dfg_MaterialX(F NoV, F roughness) {
  // MaterialX 1.38, mx_microfacet_specular.glsl, mx_ggx_dir_albedo_analytic: "rational quadratic fit to Monte Carlo
  // data for GGX directional albedo".
  constexpr float k[4][9] = {{0.1003f, -0.6303f, 9.748f, -2.038f, 29.34f, -8.245f, -26.44f, 19.99f, -5.448f},
                             {0.9345f, -2.323f, 2.229f, -3.748f, 1.424f, -0.7684f, 1.436f, 0.2913f, 0.6286f},
                             {1.0f, -1.765f, 8.263f, 11.53f, 28.96f, -7.507f, -36.11f, 15.86f, 33.37f},
                             {1.0f, 0.2281f, 15.94f, -55.83f, 13.08f, 41.26f, 54.9f, 300.2f, -285.1f}};
  const F x = saturate(NoV), r = saturate(roughness), y = r * r;
  const F terms[9] = {F(1), x, y, x * y, x * x, y * y, x * x * y, x * y * y, (x * x) * (y * y)};
  F sum[4];
  for (int i = 0; i < 4; ++i) {
    sum[i] = F(k[i][0]);
    for (int j = 1; j < 9; ++j) sum[i] = mul_add(F(k[i][j]), terms[j], sum[i]);
  }
  return {saturate(sum[0] / sum[2]), saturate(sum[1] / sum[3])};
}

// Our own. In the ratio of n.v to alpha, x = (n.v - c alpha) / (n.v + c alpha), A and B change as much at small alpha
// as at large (dfg_lookup.hpp tells why), and polynomials reach them:
//     1 - A - B = (1 - x)/2 P(x, 2 alpha - 1),   B = (1 - n.v)^5 Q(x, 2 r - 1).
// Row i of a list holds the coefficients of x^i, by powers of the other variable. Least squares reweighted (Lawson)
// towards both bounds, on 2200 points of Chebyshev and uniform grids over n.v in [1e-3,1], r in [0.02,1].
inline constexpr float dfg_loss_fine[9][5] = {
    {5.67718029e-01f, 6.52637541e-01f, 1.98645085e-01f, -1.06942542e-01f, -1.51947159e-02f},
    {9.31627810e-01f, 1.11961687e+00f, 3.83184195e-01f, -2.40650192e-01f, -9.06859860e-02f},
    {5.96906304e-01f, 1.26487410e+00f, 7.30455637e-01f, -2.78839231e-01f, -3.11823815e-01f},
    {2.97964483e-01f, 1.98750103e+00f, 1.60756421e+00f, -3.91672134e-01f, -7.87516057e-01f},
    {2.81826973e-01f, 2.67806530e+00f, 1.37626719e+00f, -1.38975322e+00f, -1.02968609e+00f},
    {-9.30810571e-02f, -3.80255282e-01f, -3.60355616e+00f, -3.48214388e+00f, -2.83143133e-01f},
    {-1.64967668e+00f, -8.02820206e+00f, -1.06272135e+01f, -4.14475107e+00f, 5.35437644e-01f},
    {-2.35783839e+00f, -1.01385927e+01f, -1.00747318e+01f, -2.20644236e+00f, 3.46778095e-01f},
    {-1.01689589e+00f, -3.97769690e+00f, -3.36487746e+00f, -3.99890959e-01f, 5.98010328e-03f}};
inline constexpr float dfg_grazing_fine[7][7] = {{7.35088587e-01f, 1.62730324e+00f, 7.22046280e+00f, 1.41426535e+01f,
                                                  1.64641113e+01f, 1.02664480e+01f, 2.53341913e+00f},
                                                 {2.78224111e+00f, 1.78577461e+01f, 6.03493195e+01f, 1.13040367e+02f,
                                                  1.18990509e+02f, 6.68237000e+01f, 1.57334929e+01f},
                                                 {9.15766811e+00f, 6.81318359e+01f, 2.16149780e+02f, 3.68047638e+02f,
                                                  3.53276184e+02f, 1.80500656e+02f, 3.82184944e+01f},
                                                 {1.96294994e+01f, 1.39099747e+02f, 4.05277313e+02f, 6.30315125e+02f,
                                                  5.51372375e+02f, 2.56159149e+02f, 4.90313072e+01f},
                                                 {2.45585880e+01f, 1.57574554e+02f, 4.19996918e+02f, 5.97859985e+02f,
                                                  4.77769165e+02f, 2.02290329e+02f, 3.54070435e+01f},
                                                 {1.61489849e+01f, 9.31915970e+01f, 2.28079742e+02f, 2.98204651e+02f,
                                                  2.18198669e+02f, 8.46457138e+01f, 1.37206612e+01f},
                                                 {4.30220461e+00f, 2.24518566e+01f, 5.07519035e+01f, 6.12112617e+01f,
                                                  4.10947609e+01f, 1.47322769e+01f, 2.22616768e+00f}};
inline constexpr float dfg_loss_coarse[4][4] = {{6.05665088e-01f, 7.07573473e-01f, 2.03270540e-01f, -1.18424483e-01f},
                                                {8.58538508e-01f, 1.26551747e+00f, 3.91769618e-01f, -2.29082987e-01f},
                                                {3.80167544e-01f, 1.29571688e+00f, 5.00247896e-01f, -1.67180344e-01f},
                                                {1.21680588e-01f, 7.32842445e-01f, 3.06169808e-01f, -5.07111289e-02f}};
inline constexpr float dfg_grazing_coarse[4][4] = {
    {6.48003042e-01f, 4.88250494e-01f, 1.65345860e+00f, 8.94572139e-01f},
    {1.41683936e+00f, 3.73787880e+00f, 4.21032047e+00f, 1.81201458e+00f},
    {1.67191744e+00f, 4.71284723e+00f, 4.10933399e+00f, 8.91315758e-01f},
    {7.14488924e-01f, 1.83975685e+00f, 1.12264061e+00f, 1.73078060e-01f}};

/// A polynomial in y for each power of x.
template <int rows, int columns, class F>
TESSERA_INLINE F polynomial(const float (&k)[rows][columns], F x, F y) {
  F sum = F(0);
  for (int i = rows - 1; i >= 0; --i) {
    F row = F(k[i][columns - 1]);
    for (int j = columns - 2; j >= 0; --j) row = mul_add(row, y, F(k[i][j]));
    sum = i == rows - 1 ? row : mul_add(sum, x, row);
  }
  return sum;
}

template <int rows, int columns, int grazing_rows, int grazing_columns, class F>
TESSERA_INLINE EnvironmentFit<F> dfg_polynomials(const float (&loss)[rows][columns], double loss_ratio,
                                                 const float (&grazing)[grazing_rows][grazing_columns],
                                                 double grazing_ratio, F NoV, F roughness) {
  const F c = saturate(NoV), r = saturate(roughness), alpha = r * r;
  const auto ratio = [&](double k) {
    const F scaled = F(k) * alpha;
    return (c - scaled) / max(c + scaled, F(1e-30));  // 0/0 at n.v = r = 0
  };
  const F x = ratio(loss_ratio), y = ratio(grazing_ratio);
  const F lost = mul_sub(x, F(0.5), F(0.5)) * polynomial(loss, x, mul_sub(F(2), alpha, F(1)));  // below 0
  const F B = max(pow5(F(1) - c) * polynomial(grazing, y, mul_sub(F(2), r, F(1))), F(0));
  return {max(F(1) + lost - B, F(0)), B};
}

/// Within 2e-3, mean 3e-4, of A and of B over n.v in [1e-3,1], r in [0.02,1]: 94 multiply-adds, two divisions.
template <class F>
TESSERA_INLINE EnvironmentFit<F> dfg_fit(F NoV, F roughness) {
  return dfg_polynomials(dfg_loss_fine, 0.8, dfg_grazing_fine, 2, NoV, roughness);
}

/// Within 1.4e-2, mean 2.6e-3: 32 multiply-adds.
template <class F>
TESSERA_INLINE EnvironmentFit<F> dfg_fit_small(F NoV, F roughness) {
  return dfg_polynomials(dfg_loss_coarse, 1, dfg_grazing_coarse, 2, NoV, roughness);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

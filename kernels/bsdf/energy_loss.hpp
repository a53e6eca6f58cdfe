// What single scattering loses: Ems(mu) = 1 - E(mu), with E the directional albedo of the white GGX lobe (F = 1) with
// height-correlated Smith masking. It is what several facets must return, and what every compensation is built on.
//
// Near the horizon and for smooth surfaces E depends on mu / alpha, not on mu: it dips by 0.1 where mu is about alpha,
// however small that is. So the natural variables are
//   m = mu / (mu + 2.5 alpha),   u = 1 - m,
// in which Ems = m u^2 (1 + mu^2 m^2) q(sqrt(m), alpha) has a smooth q: Ems vanishes as mu towards the horizon
// (m; for rough surfaces with a logarithm, whose edge the square root takes off), and for smooth surfaces as alpha^2 (1
// + mu^2) / (2 mu^2) away from it.
#pragma once
#include "kernels/math/approx.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

inline constexpr double ems_scale = 2.5;  // best of 0.5 ... 4 for the fit below

template <class F>
struct EmsVariables {
  F alpha, x, factor;  // x = sqrt(m (1 + 2.5 alpha)), 1 at mu = 1; factor = Ems / q
};

/// mu and alpha are clamped to [0,1] (NaN: 0).
template <class F>
TESSERA_INLINE EmsVariables<F> ems_variables(F mu, F alpha) {
  const F c = saturate(mu), a = saturate(alpha), scaled = a * F(ems_scale);
  const F inverse = F(1) / max(c + scaled, F(1e-37));  // 1e-37: mu = alpha = 0
  const F m = c * inverse, u = scaled * inverse;
  const F x = min(sqrt(mul_add(m, scaled, m)), F(1));
  return {a, x, m * (u * u) * mul_add(c * m, c * m, F(1))};
}

/// q at one alpha: do this once for all directions at a point.
template <class F>
struct EmsPolynomial {
  F c[9];
};

// q as a polynomial, degree 8 in 2 x - 1 with x = sqrt(m (1 + 2.5 alpha)), which reaches 1 at mu = 1, and 5 in
// 2 alpha - 1: centred, or float's digits cancel. Own fit (Lawson's iteration on 25 x 49 values of reference/albedo for
// alpha in [1e-4,1]): |error of E| <= 7.12e-04 min(E, 150 Ems).
inline constexpr double ems_coefficients[9][6] = {
    {2.08683793, 2.66971958, 1.14897138, -0.209042492, -0.0205133735, 0.0146015127},
    {-0.462242785, -1.5752734, -0.869868364, -0.0628224685, -0.136988731, 0.0686366698},
    {0.92015139, 1.76766374, 0.602054286, -0.0379350246, -0.418400856, 0.316997872},
    {-0.517129221, -0.756669591, -1.24370515, 0.355465463, 0.119526801, 0.141168818},
    {-0.2713315, -0.290821598, -1.16815742, 1.16758388, 1.41635123, -1.42182066},
    {0.61230278, 1.36381986, 0.640687199, -0.603423783, 0.457464314, -1.00828368},
    {0.527631815, 1.66107278, 1.99623227, -2.22264425, -1.14007609, 2.01977883},
    {-1.88661229, -3.35954135, -1.00837755, 0.114111767, -0.33950723, 0.928670475},
    {0.888111139, 1.23522529, 0.087523687, 0.863335445, 0.221761749, -0.984840104}};

template <class F>
TESSERA_INLINE EmsPolynomial<F> ems_polynomial(F alpha) {
  const F t = mul_add(saturate(alpha), F(2), F(-1));
  EmsPolynomial<F> p;
  for (int i = 0; i < 9; ++i) {
    p.c[i] = F(ems_coefficients[i][5]);
    for (int k = 4; k >= 0; --k) p.c[i] = mul_add(p.c[i], t, F(ems_coefficients[i][k]));
  }
  return p;
}

template <class F>
TESSERA_INLINE F ems_at(const EmsPolynomial<F>& p, F mu, F alpha) {
  const EmsVariables<F> v = ems_variables(mu, alpha);
  const F x = mul_add(v.x, F(2), F(-1));
  F q = p.c[8];
  for (int i = 7; i >= 0; --i) q = mul_add(q, x, p.c[i]);
  return saturate(v.factor * q);
}

/// 1 - E(mu), by polynomial. mu and alpha in [0,1], clamped. In [0,1]; 0 at mu = 0 and at alpha = 0.
template <class F>
TESSERA_INLINE F Ems_GGX(F mu, F alpha) {
  return ems_at(ems_polynomial(alpha), mu, alpha);
}

/// The same from a table of q (reference/energy_table.hpp bakes it): row j at roughness j / (size - 1), column i at
/// sqrt(m (1 + 2.5 alpha)) = i / (size - 1), which is 1 at mu = 1. Bilinear. size >= 2.
template <class F>
TESSERA_INLINE F Ems_GGX_lookup(const float* texels, int size, F mu, F alpha) {
  using I = IntOf<F>;
  const EmsVariables<F> v = ems_variables(mu, alpha);
  const F last = F(size - 1);
  const F x = v.x * last, y = sqrt(v.alpha) * last;
  const I i = truncate_to_int(min(x, F(size - 2))), j = truncate_to_int(min(y, F(size - 2)));
  const F wx = x - to_float(i), wy = y - to_float(j);
  const I first = j * I(size) + i, below = first + I(size);
  const F a = F(gather(texels, first)), b = F(gather(texels + 1, first));
  const F c = F(gather(texels, below)), d = F(gather(texels + 1, below));
  const F top = mul_add(wx, b - a, a), bottom = mul_add(wx, d - c, c);
  return saturate(v.factor * mul_add(wy, bottom - top, top));
}

/// 1 - Eavg = 2 integral Ems(mu) mu dmu. alpha in [0,1], clamped.
template <class F>
TESSERA_INLINE F Emsavg_GGX(F alpha) {
  // alpha^2 (polynomial - ln alpha): the logarithm is the exact behaviour of smooth surfaces. Own fit against
  // reference/albedo for alpha in [2.5e-5,1]: relative error at most 3.5e-4 (smooth) and 6e-5 (rough).
  const F a = saturate(alpha);
  F q = mul_add(F(-0.166158375), a, F(0.442039626));
  q = mul_add(q, a, F(-0.23418773));
  q = mul_add(q, a, F(0.0580538186));
  q = mul_add(q, a, F(0.491083098));
  q = mul_add(log2(max(a, F(1e-30))), F(-0.692695396), q);  // 1e-30: alpha^2 log(alpha) is 0 long before
  return a * a * q;
}

/// The average to go with the polynomial, whose tail is too high on smooth surfaces: by 6.8 % of it at r = 0, 2.6 % at
/// 0.05, nothing from 0.1 on. What matters to a lobe is that its factors cancel, and never to more than 1.
template <class F>
TESSERA_INLINE F Emsavg_GGX_polynomial(F alpha) {
  return Emsavg_GGX(alpha) * (F(1) + max(neg_mul_add(sqrt(saturate(alpha)), F(0.7), F(0.07)), F(0)));
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

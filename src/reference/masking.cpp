#include "reference/masking.hpp"

#include <algorithm>
#include <numbers>

#include "reference/quadrature.hpp"

namespace tessera::reference {

double beckmann_lambda(double theta, double alpha) {
  const double a = 1 / (alpha * std::tan(theta));
  return std::exp(-a * a) / (2 * a * std::sqrt(std::numbers::pi)) - std::erfc(a) / 2;
}

double beckmann_lambda_rational(double theta, double alpha) {
  const double a = 1 / (alpha * std::tan(theta));
  if (a >= 1.6) return 0;
  const double g1 = (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a);
  return 1 / g1 - 1;
}

double joint_masking(Joint joint, double lambda_v, double lambda_l, double azimuth) {
  const double g_v = 1 / (1 + lambda_v), g_l = 1 / (1 + lambda_l);
  const double w = 4.41 * azimuth / (4.41 * azimuth + 1);
  switch (joint) {
    case Joint::separable:
      return g_v * g_l;
    case Joint::height:
      return 1 / (1 + lambda_v + lambda_l);
    case Joint::direction:
      return w * g_v * g_l + (1 - w) * std::min(g_v, g_l);
    case Joint::height_direction:
      return 1 / (1 + std::max(lambda_v, lambda_l) + w * std::min(lambda_v, lambda_l));
  }
  return 0;
}

double schlick_g1(double mu, double k) { return mu / (mu * (1 - k) + k); }
double schlick_masking(const Vec3& v, const Vec3& l, double k) { return schlick_g1(v.z, k) * schlick_g1(l.z, k); }

double hammon_masking(const Vec3& v, const Vec3& l, double alpha) {
  const double product = v.z * l.z;
  return 2 * product / std::lerp(2 * product, v.z + l.z, alpha);
}

double cook_torrance_masking(const Vec3& v, const Vec3& l) {
  const Vec3 h = normalize(v + l);
  return std::min({1.0, 2 * h.z * v.z / dot(v, h), 2 * h.z * l.z / dot(v, h)});
}
double v_cavity_g1(const Vec3& v, const Vec3& m) { return std::min(1.0, 2 * std::abs(m.z * v.z) / dot(v, m)); }

double neumann_masking(const Vec3& v, const Vec3& l) { return v.z * l.z / std::max(v.z, l.z); }
double kelemen_masking(const Vec3& v, const Vec3& l) {
  const double vh = dot(v, normalize(v + l));
  return v.z * l.z / (vh * vh);
}
double implicit_masking(const Vec3& v, const Vec3& l) { return v.z * l.z; }

double visible_area(double mu, double alpha, const std::function<double(double theta)>& D,
                    const std::function<double(const Vec3& v, const Vec3& m)>& G1) {
  const double sin_v = std::sqrt(1 - mu * mu);
  const Vec3 v = {sin_v, 0, mu};
  // tan theta = alpha tan x: the integrand in x is smooth for every alpha. The azimuth where facets turn away from v
  // cuts the inner integral.
  const auto ring = [&](double x) {
    const double tan_x = std::tan(x), t = alpha * tan_x, theta = std::atan(t);
    const double s = std::sin(theta), c = std::cos(theta);
    const double ratio = sin_v * s > 0 ? -mu * c / (sin_v * s) : -2;
    const double edge = ratio <= -1 ? std::numbers::pi : std::acos(ratio);
    const double facing = integrate(
        [&](double phi) {
          const Vec3 m = from_angles(theta, phi);
          const double cosine = dot(v, m);
          return cosine > 0 ? G1(v, m) * cosine : 0.0;
        },
        0, edge, 12, 2);
    const double dtheta_dx = alpha * (1 + tan_x * tan_x) / (1 + t * t);
    return 2 * facing * D(theta) * s * dtheta_dx;
  };
  return integrate(ring, 0, std::numbers::pi / 2, 24, 24);
}

}  // namespace tessera::reference

#include "reference/microfacet.hpp"

#include <numbers>

namespace tessera::reference {

double ggx_distribution(double theta, double alpha) {
  const double c = std::cos(theta), t = std::tan(theta);
  const double bracket = alpha * alpha + t * t;
  return alpha * alpha / (std::numbers::pi * c * c * c * c * bracket * bracket);
}

double ggx_distribution(double sin2, double cos2, double alpha) {
  if (cos2 <= 0) return alpha * alpha / std::numbers::pi;  // limit at the horizon
  const double tan2 = sin2 / cos2, bracket = alpha * alpha + tan2;
  return alpha * alpha / (std::numbers::pi * cos2 * cos2 * bracket * bracket);
}

double ggx_lambda(double theta, double alpha) {
  const double a = 1 / (alpha * std::tan(theta));
  return 0.5 * (std::sqrt(1 + 1 / (a * a)) - 1);
}

double smith_masking_shadowing(double theta_v, double theta_l, double alpha) {
  const double horizon = std::numbers::pi / 2;
  if (theta_v >= horizon || theta_l >= horizon) return 0;
  return 1 / (1 + ggx_lambda(theta_v, alpha) + ggx_lambda(theta_l, alpha));
}

double specular_brdf_over_fresnel(const Vec3& v, const Vec3& l, double alpha) {
  const Vec3 h = v + l;  // its length cancels in tan^2
  const double h2 = dot(h, h), tangential = h.x * h.x + h.y * h.y;
  const double d = ggx_distribution(tangential / h2, h.z > 0 ? h.z * h.z / h2 : 0, alpha);
  const double g = smith_masking_shadowing(std::acos(v.z), std::acos(l.z), alpha);
  return d * g / (4 * v.z * l.z);
}

}  // namespace tessera::reference

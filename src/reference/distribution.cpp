#include "reference/distribution.hpp"

#include <cmath>
#include <numbers>

namespace tessera::reference {
namespace {
using std::numbers::pi;
}

double beckmann_distribution(double theta, double alpha) {
  const double tangent = std::tan(theta), c = std::cos(theta);
  return std::exp(-tangent * tangent / (alpha * alpha)) / (pi * alpha * alpha * std::pow(c, 4));
}

double blinn_phong_distribution(double theta, double alpha) {
  const double power = 2 / (alpha * alpha) - 2;
  // cos^p through log(cos) = log1p(cos - 1), cos - 1 = -2 sin^2(theta/2).
  const double half = std::sin(theta / 2);
  return (power + 2) / (2 * pi) * std::exp(power * std::log1p(-2 * half * half));
}

double gtr_distribution(double theta, double alpha, double gamma) {
  const double s = std::sin(theta), c = std::cos(theta), a2 = alpha * alpha;
  if (alpha == 1) return 1 / pi;
  const double t = s * s + a2 * c * c;  // 1 + (a2 - 1) cos^2
  const double normalization =
      gamma == 1 ? (a2 - 1) / (pi * std::log(a2)) : (gamma - 1) * (a2 - 1) / (pi * (1 - std::pow(a2, 1 - gamma)));
  return normalization / std::pow(t, gamma);
}

double anisotropic_ggx_distribution(double theta, double phi, double alpha_x, double alpha_y) {
  const double s = std::sin(theta), x = s * std::cos(phi) / alpha_x, y = s * std::sin(phi) / alpha_y;
  const double c = std::cos(theta);
  return 1 / (pi * alpha_x * alpha_y * std::pow(x * x + y * y + c * c, 2));
}

double anisotropic_beckmann_distribution(double theta, double phi, double alpha_x, double alpha_y) {
  // The density of slopes, over cos^4: Heitz 2014, eq. 36.
  const double slope = std::tan(theta), x = slope * std::cos(phi), y = slope * std::sin(phi);
  const double density =
      std::exp(-x * x / (alpha_x * alpha_x) - y * y / (alpha_y * alpha_y)) / (pi * alpha_x * alpha_y);
  return density / std::pow(std::cos(theta), 4);
}

}  // namespace tessera::reference

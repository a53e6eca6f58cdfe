#include "reference/fresnel.hpp"

#include <cmath>
#include <complex>

namespace tessera::reference {

double fresnel_schlick(double f0, double cos_theta) { return f0 + (1 - f0) * std::pow(1 - cos_theta, 5); }

double fresnel_conductor(double cos_theta, double eta, double k) {
  const std::complex<double> index(eta, k);
  const double sin2 = 1 - cos_theta * cos_theta;
  const std::complex<double> cos_t = std::sqrt(1.0 - sin2 / (index * index));
  const std::complex<double> s = (cos_theta - index * cos_t) / (cos_theta + index * cos_t);
  const std::complex<double> p = (index * cos_theta - cos_t) / (index * cos_theta + cos_t);
  return 0.5 * (std::norm(s) + std::norm(p));
}

double fresnel_dielectric(double cos_theta, double eta) {
  if (1 - cos_theta * cos_theta >= eta * eta) return 1;
  return fresnel_conductor(cos_theta, eta, 0);
}

}  // namespace tessera::reference

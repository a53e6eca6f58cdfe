#include "reference/diffuse.hpp"

#include <algorithm>
#include <numbers>

#include "reference/quadrature.hpp"

namespace tessera::reference {
namespace {

constexpr double pi = std::numbers::pi;

double angle(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }
double difference_angle(const Vec3& v, const Vec3& l) { return angle(dot(l, normalize(v + l))); }
double azimuth(const Vec3& v, const Vec3& l) { return std::atan2(l.y, l.x) - std::atan2(v.y, v.x); }
double schlick(double f0, double f90, double cosine) { return f0 + (f90 - f0) * std::pow(1 - cosine, 5); }

}  // namespace

double burley_diffuse(double albedo, double roughness, const Vec3& v, const Vec3& l) {
  const double c = std::cos(difference_angle(v, l)), fd90 = 0.5 + 2 * roughness * c * c;
  return albedo / pi * schlick(1, fd90, l.z) * schlick(1, fd90, v.z);
}

double frostbite_diffuse(double albedo, double roughness, const Vec3& v, const Vec3& l) {
  const double c = std::cos(difference_angle(v, l));
  const double bias = std::lerp(0.0, 0.5, roughness), factor = std::lerp(1.0, 1 / 1.51, roughness);
  const double fd90 = bias + 2 * roughness * c * c;
  return albedo / pi * schlick(1, fd90, l.z) * schlick(1, fd90, v.z) * factor;
}

double oren_nayar_diffuse(double albedo, double sigma, const Vec3& v, const Vec3& l) {
  const double theta_r = angle(v.z), theta_i = angle(l.z), s2 = sigma * sigma;
  const double A = 1 - 0.5 * s2 / (s2 + 0.33), B = 0.45 * s2 / (s2 + 0.09);
  const double alpha = std::max(theta_r, theta_i), beta = std::min(theta_r, theta_i);
  return albedo / pi * (A + B * std::max(0.0, std::cos(azimuth(v, l))) * std::sin(alpha) * std::tan(beta));
}

double fujii_diffuse(double albedo, double roughness, const Vec3& v, const Vec3& l) {
  const double theta_r = angle(v.z), theta_i = angle(l.z);
  const double A = 1 / (pi + (pi / 2 - 2.0 / 3) * roughness), B = roughness * A;
  const double s = std::sin(theta_r) * std::sin(theta_i) * std::cos(azimuth(v, l));
  const double t = s > 0 ? std::max(v.z, l.z) : 1;
  return albedo * (A + B * s / t);
}

double eon_diffuse(double albedo, double roughness, const Vec3& v, const Vec3& l) {
  const auto white = [&](const Vec3& a, const Vec3& b) { return fujii_diffuse(1, roughness, a, b); };
  const double E_v = hemispherical_albedo(white, v.z), E_l = hemispherical_albedo(white, l.z);
  const double average = average_hemispherical_albedo(white);
  double f = fujii_diffuse(albedo, roughness, v, l);
  if (roughness > 0) {
    const double multiple = (1 - E_v) * (1 - E_l) / (pi * (1 - average));
    f += albedo * albedo * average / (1 - albedo * (1 - average)) * multiple;
  }
  return f;
}

double ashikhmin_shirley_diffuse(double albedo, double f0, const Vec3& v, const Vec3& l) {
  return 28 * albedo / (23 * pi) * (1 - f0) * (1 - std::pow(1 - l.z / 2, 5)) * (1 - std::pow(1 - v.z / 2, 5));
}

double hemispherical_albedo(const std::function<double(const Vec3& v, const Vec3& l)>& f, double mu, int order) {
  const Vec3 v = {std::sqrt(1 - mu * mu), 0, mu};
  const auto ring = [&](double theta) {
    const auto along = [&](double phi) { return f(v, from_angles(theta, phi)); };
    return 2 * (integrate(along, 0, pi / 2, order) + integrate(along, pi / 2, pi, order)) * std::sin(theta) *
           std::cos(theta);
  };
  const double theta_v = std::acos(mu);
  return integrate(ring, 0, theta_v, order) + integrate(ring, theta_v, pi / 2, order);
}

double average_hemispherical_albedo(const std::function<double(const Vec3& v, const Vec3& l)>& f, int order) {
  return integrate([&](double mu) { return 2 * mu * hemispherical_albedo(f, mu, order); }, 0, 1, order);
}

}  // namespace tessera::reference

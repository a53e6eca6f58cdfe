// As in reference/albedo.cpp: with D(h) cos(h) dh = du dphi / 2 pi and dl = 4 (v.h) dh,
//   integral D V n.l dl = 1 / 2 pi integral du dphi V 4 (v.h)(n.l) / (n.h)
// u = 1 - w^2: tan^2(h) = alpha^2 u / (1 - u) for GGX, -alpha^2 log(1 - u) for Beckmann.
#include "bench/chart/specular_lobe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/quadrature.hpp"

namespace tessera::chart {
namespace {

using std::numbers::pi;

double tangent_of(Microfacets microfacets, double w, double alpha) {
  return microfacets == Microfacets::ggx ? alpha * std::sqrt(1 - w * w) / w : alpha * std::sqrt(-2 * std::log(w));
}
double w_of(Microfacets microfacets, double tangent, double alpha) {
  return microfacets == Microfacets::ggx ? alpha / std::hypot(alpha, tangent)
                                         : std::exp(-0.5 * tangent * tangent / (alpha * alpha));
}

// Beyond this azimuth of h, l is below the horizon.
double horizon_azimuth(const reference::Vec3& v, double theta_h) {
  const double c = std::cos(theta_h), numerator = v.z * (1 / (2 * c) - c), denominator = v.x * std::sin(theta_h);
  if (numerator <= -denominator) return pi;
  return numerator >= denominator ? 0 : std::acos(numerator / denominator);
}

}  // namespace

std::vector<LobeSample> lobe_samples(Microfacets microfacets, double mu, double alpha, int order) {
  const double theta_v = std::acos(mu);
  const reference::Vec3 v = {std::sqrt(1 - mu * mu), 0, mu};
  const reference::QuadratureRule& rule = reference::gauss_legendre(order);
  const double first = w_of(microfacets, std::tan((pi / 2 - theta_v) / 2), alpha);
  const double last = w_of(microfacets, std::tan((pi / 2 + theta_v) / 2), alpha);
  std::vector<LobeSample> samples;
  const auto add_ring = [&](double w0, double w1) {
    for (int i = 0; i < order; ++i) {
      const double x = rule.nodes[i], w = w0 + (w1 - w0) * x * x * (3 - 2 * x);
      if (w <= 0 || w >= 1) continue;
      const double du = 2 * w * (w1 - w0) * 6 * x * (1 - x) * rule.weights[i];
      const double theta_h = std::atan(tangent_of(microfacets, w, alpha)), edge = horizon_azimuth(v, theta_h);
      for (int j = 0; j < order; ++j) {
        const reference::Vec3 h = reference::from_angles(theta_h, edge * rule.nodes[j]);
        const double VoH = dot(v, h);
        const reference::Vec3 l = h * (2 * VoH) - v;
        if (VoH <= 0 || l.z <= 1e-6) continue;
        const double weight = 4 * VoH * l.z / h.z * du * edge * rule.weights[j] / pi;  // both halves of azimuth
        samples.push_back({v, l, h.z, VoH, std::abs(std::atan2(l.y, l.x)), weight});
      }
    }
  };
  add_ring(first, 1);
  add_ring(last, first);
  return samples;
}

}  // namespace tessera::chart

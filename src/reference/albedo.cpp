// The integral over l is taken over the microfacet h instead. With D(h) cos(h) dh = du dphi / 2pi for
// tan^2(theta_h) = alpha^2 u / (1 - u), and dl = 4 (v.h) dh:
//   integral f cos(l) dl = 1/2pi integral du dphi  G2(v,l) (v.h) / (cos(v) cos(h))
// which is smooth but for the edge where l meets the horizon; there G2 falls to zero, and azimuth is cut at that edge.
#include "reference/albedo.hpp"

#include <algorithm>
#include <numbers>

#include "reference/fresnel.hpp"
#include "reference/microfacet.hpp"
#include "reference/quadrature.hpp"

namespace tessera::reference {
namespace {

// l.z = 2 (v.h) h.z - v.z > 0, with v.h = v.x h.x + v.z h.z: the azimuth beyond which l is under the horizon.
double horizon_azimuth(double sin_v, double cos_v, double sin_h, double cos_h) {
  const double numerator = cos_v * (1 / (2 * cos_h) - cos_h), denominator = sin_v * sin_h;
  if (numerator <= -denominator) return std::numbers::pi;
  if (numerator >= denominator) return 0;
  return std::acos(numerator / denominator);
}

// Sum over the microfacets whose u lies where sqrt(1 - u) is between w0 and w1.
void add_ring(const Vec3& v, double theta_v, double alpha, double w0, double w1, int order, DirectionalAlbedo* sum) {
  const QuadratureRule& rule = gauss_legendre(order);
  for (int i = 0; i < order; ++i) {
    // A smoothstep: the width of the cut azimuth grows as a square root from either end.
    const double x = rule.nodes[i], w = w0 + (w1 - w0) * x * x * (3 - 2 * x);
    const double du = 2 * w * (w1 - w0) * 6 * x * (1 - x) * rule.weights[i];
    const double theta_h = std::atan(alpha * std::sqrt(1 - w * w) / w);
    const double edge = horizon_azimuth(v.x, v.z, std::sin(theta_h), std::cos(theta_h));
    for (int j = 0; j < order; ++j) {
      const double phi = edge * rule.nodes[j], dphi = 2 * edge * rule.weights[j];  // both halves
      const Vec3 h = from_angles(theta_h, phi);
      const double vh = dot(v, h), lz = 2 * vh * h.z - v.z;
      if (vh <= 0 || lz <= 0) continue;
      const double g = smith_masking_shadowing(theta_v, std::acos(std::min(lz, 1.0)), alpha);
      const double value = g * vh / (v.z * h.z) * du * dphi / (2 * std::numbers::pi);
      const double grazing = fresnel_schlick(0, vh);
      sum->A += value * (1 - grazing);
      sum->B += value * grazing;
    }
  }
}

}  // namespace

DirectionalAlbedo directional_albedo(double mu, double alpha, int order) {
  const double theta_v = std::acos(mu), horizon = std::numbers::pi / 2;
  const Vec3 v = {std::sqrt(1 - mu * mu), 0, mu};
  // l leaves the hemisphere first behind v (theta_l = 2 theta_h + theta_v), last before it (2 theta_h - theta_v).
  const auto w = [&](double theta_h) { return alpha / std::hypot(alpha, std::tan(theta_h)); };
  const double first = w((horizon - theta_v) / 2), last = w((horizon + theta_v) / 2);
  DirectionalAlbedo sum;
  add_ring(v, theta_v, alpha, first, 1, order, &sum);
  add_ring(v, theta_v, alpha, last, first, order, &sum);
  return sum;
}

double average_albedo(double alpha, int order) {
  return integrate([&](double mu) { return 2 * mu * directional_albedo(mu, alpha, order).E(); }, 0, 1, order);
}

}  // namespace tessera::reference

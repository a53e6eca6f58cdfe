#include "bench/chart/diffuse_lobes.hpp"

#include <cmath>
#include <numbers>

#include "reference/quadrature.hpp"

namespace tessera::chart {

std::vector<DiffuseSample> hemisphere(double mu, int order, double cut) {
  using std::numbers::pi;
  const reference::QuadratureRule& rule = reference::gauss_legendre(order);
  const reference::Vec3 v = {std::sqrt(1 - mu * mu), 0, mu};
  const double edge = std::acos(cut);
  std::vector<DiffuseSample> samples;
  for (int i = 0; i < 2 * order; ++i)
    for (int j = 0; j < 2 * order; ++j) {
      const double low = i < order ? 0 : edge, width = i < order ? edge : pi / 2 - edge;
      const double theta = low + width * rule.nodes[i % order];
      const double phi = (rule.nodes[j % order] + (j < order ? 0 : 1)) * pi / 2;
      const double area = width * rule.weights[i % order] * pi / 2 * rule.weights[j % order];
      // Both halves of azimuth.
      samples.push_back({v, reference::from_angles(theta, phi), 2 * area * std::sin(theta) * std::cos(theta)});
    }
  return samples;
}

double albedo_of(const std::vector<DiffuseSample>& samples, const std::vector<double>& f) {
  double sum = 0;
  for (std::size_t i = 0; i < f.size(); ++i) sum += samples[i].weight * f[i];
  return sum;
}

Error error_of(const std::vector<double>& values) { return absolute_error(values, std::vector<double>(values.size())); }

}  // namespace tessera::chart

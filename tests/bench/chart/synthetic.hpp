// Results that look like a run's but come from nowhere: for tests of what draws and writes them.
#pragma once
#include <cmath>
#include <string>

#include "bench/chart/results.hpp"

namespace tessera::chart_test {

using namespace chart;

inline ErrorMap synthetic_map(double strength, bool two_sided) {
  ErrorMap map{"error of reflectance", "NoV", "roughness", {}, {}, {}};
  constexpr int side = 48;
  for (int i = 0; i < side; ++i) {
    map.columns.push_back((i + 0.5) / side);
    map.rows.push_back((i + 0.5) / side);
  }
  for (const double r : map.rows)
    for (const double c : map.columns) {
      const double value = strength * std::pow(1 - c, 5) * (0.05 + r * r);
      map.values.push_back(two_sided ? value * std::cos(9 * c + 4 * r) : value);
    }
  return map;
}

/// `methods` methods whose costs and errors scatter over two and five decades; the last is exact.
inline Plot synthetic_plot(const std::string& id, int methods, bool maps) {
  Plot plot;
  plot.id = id;
  plot.title = "Reflectance of a dielectric, " + id;
  plot.error_name = "largest error of reflectance";
  plot.domain = "F0 in [0.02, 0.08], VoH in [0, 1]";
  plot.truth = "unpolarised Fresnel equations";
  const char* titles[] = {"Schlick, pow5 by multiplication",
                          "Spherical Gaussian (Karis)",
                          "Single Gaussian (Lagarde)",
                          "2% rule",
                          "Schlick with roughness",
                          "F82 tint",
                          "Lazányi-Szirmay-Kalos",
                          "Gotanda",
                          "Exact dielectric",
                          "Exact conductor"};
  for (int i = 0; i < methods; ++i) {
    Point point;
    point.id = "method-" + std::to_string(i);
    point.title = std::string(titles[i % 10]) + (i < 10 ? "" : " " + std::to_string(i / 10 + 1));
    point.formula = "F0 + (1 - F0) (1 - VoH)^" + std::to_string(i);
    point.paper = "Schlick 1994, An Inexpensive BRDF Model <for> \"Rendering\", eq. " + std::to_string(i);
    point.file = "kernels/bsdf/fresnel.hpp";
    point.fails = i % 3 == 0 ? "grazing angles & dark metals" : "";
    const double wave = std::abs(std::sin(i * 12.9898) * 43758.5453), share = wave - std::floor(wave);
    const double ns = 0.3 * std::pow(40.0, (i + 0.5) / methods);
    const char* isas[] = {"sse42", "avx2", "avx512"};
    for (int k = 0; k < 3; ++k) {
      const double cost = ns / (1 + k * (0.7 + 0.4 * share));
      point.cost[isas[k]] = {cost, cost * 0.97, cost * (1.02 + 0.2 * share), 9};
    }
    const double error = i == methods - 1 ? 0 : 0.3 * std::pow(10.0, -4 * share - 1.5 * i / methods);
    point.method = {error, error / 6, error / 3};
    point.arithmetic = {6e-8 * (1 + 9 * share), 2e-8, 3e-8};
    if (i % 2 == 0) point.extra["reciprocity error"] = error * 2;
    for (const char* isa : isas) point.extra[std::string("instructions ") + isa] = 10 + i;
    if (maps && i < 6) point.maps.push_back(synthetic_map(error, i % 2 == 1));
    plot.points.push_back(point);
  }
  return plot;
}

inline Results synthetic_results() {
  Results results;
  results.machine = {"Synthetic CPU",
                     "GCC 12",
                     "-O3; avx2: -march=x86-64-v3",
                     "0123456789ab",
                     "2024-01-01 00:00 UTC",
                     "0.1.0",
                     2.9,
                     true,
                     {"sse42", "avx2", "avx512"}};
  Family fresnel{"fresnel", "Fresnel reflectance", "How much is reflected, by angle. <b>Not</b> markup.", {}, {}};
  fresnel.findings = {"Schlick by multiplication costs 0.4 ns, the spherical Gaussian 0.9 ns: 2.2 times as much.",
                      "No approximation is within 1e-3 over all angles."};
  fresnel.plots = {synthetic_plot("dielectric", 10, true), synthetic_plot("crowded", 24, false)};
  Family second{"distribution", "Normal distributions", "A second family.", {}, {synthetic_plot("ndf", 3, true)}};
  results.families = {fresnel, second};
  return results;
}

}  // namespace tessera::chart_test

// Material blending: one evaluation of blended parameters against the blend of all evaluations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/chart/measure.hpp"

namespace tessera::chart {
namespace {

using Planes = std::vector<std::vector<float>>;

constexpr double rough_layer = 0.8;

// Half vectors across the lobe of the smooth layer, the eye at 45 degrees, mask from 0 to 1.
Planes lobes(double smooth, double mask, int steps) {
  Planes planes(7);
  for (const double theta : spread(0, 1.2, steps)) {
    const double s = std::sin(theta);
    const double row[] = {std::cos(theta), s * s,       0.7071, std::max(std::cos(theta + 0.7854), 0.05),
                          smooth,          rough_layer, mask};
    for (std::size_t k = 0; k < 7; ++k) planes[k].push_back(float(row[k]));
  }
  return planes;
}

// Part of the reflected light that a form sends elsewhere than the mixture does: half the sum of the differences.
double relative_difference(const std::string& term, double smooth, double mask, int steps) {
  const Planes in = lobes(smooth, mask, steps);
  const std::vector<double> found = in_double(term, in), truth = in_double("blend_Shaded", in);
  double difference = 0, total = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double weight = std::sqrt(double(in[1][i])) * double(in[3][i]);  // solid angle and cosine
    difference += weight * std::abs(found[i] - truth[i]);
    total += weight * truth[i];
  }
  return 0.5 * difference / total;
}

Plot roughness_plot(Session& session) {
  Plot plot;
  plot.id = "blending-roughness";
  plot.title = "Roughness of two layers";
  plot.error_name = "largest part of the reflected light that lands elsewhere";
  plot.domain =
      fmt::format("one layer of roughness 0.1 to {0}, the other {0}; mask 0 to 1; eye at 45 degrees", rough_layer);
  plot.truth = "both layers shaded, then blended";
  const int steps = session.quick ? 101 : 401;
  for (const char* term : {"blend_Shaded", "blend_Roughness", "blend_Alpha", "blend_Variance"}) {
    session.progress(fmt::format("blending: {}", term));
    Point point = describe(term);
    point.maps.push_back(
        map_over("part of the light that lands elsewhere", "mask", spread(0, 1, 33), "roughness of the other layer",
                 spread(0.1, rough_layer, 29),
                 [&](double mask, double smooth) { return relative_difference(term, smooth, mask, steps); }));
    const std::vector<double>& values = point.maps[0].values;
    point.method = absolute_error(values, std::vector<double>(values.size(), 0));
    const Planes in = lobes(0.3, 0.4, 512);
    point.arithmetic = relative_error(in_float(session, term, in), in_double(term, in), 1e-20);
    add_cost(session, point, term, in);
    plot.points.push_back(point);
  }
  return plot;
}

Plot f0_plot(Session& session) {
  Plot plot;
  plot.id = "blending-f0";
  plot.title = "Base colour and metallic of two layers";
  plot.error_name = "largest error of F0";
  plot.domain = "a metal of base colour 0 to 1 over a dielectric of base colour 0 to 1, mask 0 to 1";
  plot.truth = "F0 of each layer, blended";
  Planes in(5);
  for (const double metal : spread(0, 1, 21))
    for (const double dielectric : spread(0, 1, 21))
      for (const double mask : spread(0, 1, 21)) {
        const double row[] = {dielectric, 0, metal, 1, mask};
        for (std::size_t k = 0; k < 5; ++k) in[k].push_back(float(row[k]));
      }
  const std::vector<double> truth = in_double("blend_F0", in);
  for (const char* term : {"blend_F0", "blend_F0Parameters"}) {
    session.progress(fmt::format("blending: {}", term));
    Point point = describe(term);
    const std::vector<double> exact = in_double(term, in);
    point.method = absolute_error(exact, truth);
    point.arithmetic = absolute_error(in_float(session, term, in), exact);
    add_cost(session, point, term, in);
    point.maps.push_back(map_over("F0 minus the exact one", "mask", spread(0, 1, 33), "base colour of both",
                                  spread(0, 1, 33), [&](double mask, double color) {
                                    const float c = float(color), m = float(mask);
                                    const Planes one = {{c}, {0.0f}, {c}, {1.0f}, {m}};
                                    return in_double(term, one)[0] - in_double("blend_F0", one)[0];
                                  }));
    plot.points.push_back(point);
  }
  return plot;
}

}  // namespace

Family measure_blending(Session& session) {
  Family family;
  family.id = "blending";
  family.title = "Material blending";
  family.about =
      "Layered materials blend the parameters of their layers by a mask and shade once. The truth is a mixture too "
      "fine "
      "to see: both layers shaded, then blended, at the cost of all of them.";
  family.plots = {roughness_plot(session), f0_plot(session)};
  const std::vector<Point>& lobes = family.plots[0].points;
  const Point& best = *std::min_element(lobes.begin() + 1, lobes.end(),
                                        [](const Point& a, const Point& b) { return a.method.mean < b.method.mean; });
  family.findings = {
      fmt::format("Of the forms that shade once, '{}' is nearest on average: {:.0f} % of the reflected light lands "
                  "elsewhere, at worst {:.0f} % (a smooth layer under a rough one).",
                  best.title, 100 * best.method.mean, 100 * best.method.max),
      fmt::format(
          "Blending base colour and metallic apart puts F0 off by up to {}; blending F0 itself is exact and costs "
          "as much.",
          number(family.plots[1].points[1].method.max)),
  };
  return family;
}

}  // namespace tessera::chart

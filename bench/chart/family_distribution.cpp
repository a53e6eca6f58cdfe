// Normal distributions: what each costs, and what float leaves of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/chart/measure.hpp"
#include "reference/distribution.hpp"
#include "reference/microfacet.hpp"

namespace tessera::chart {
namespace {

using std::numbers::pi;

// A half vector: theta from the normal, phi from the tangent.
struct Direction {
  double theta, phi;
};

constexpr double alpha_y = 0.1;

double truth_of(const std::string& term, const Direction& h, double alpha, double gamma) {
  if (term == "D_Beckmann") return reference::beckmann_distribution(h.theta, alpha);
  if (term == "D_BlinnPhong" || term == "D_BlinnPhong_naive")
    return reference::blinn_phong_distribution(h.theta, alpha);
  if (term == "D_GTR") return reference::gtr_distribution(h.theta, alpha, gamma);
  if (term == "D_GTR1") return reference::gtr_distribution(h.theta, alpha, 1);
  if (term == "D_GGXAnisotropic") return reference::anisotropic_ggx_distribution(h.theta, h.phi, alpha, alpha_y);
  if (term == "D_BeckmannAnisotropic")
    return reference::anisotropic_beckmann_distribution(h.theta, h.phi, alpha, alpha_y);
  const double s = std::sin(h.theta), c = std::cos(h.theta);
  return reference::ggx_distribution(s * s, c * c, alpha);
}

// What a renderer has: floats of the exact cosine, the exact sine squared, the exact components of h.
std::vector<float> inputs_of(const std::string& term, const Direction& h, double alpha, double gamma) {
  const float c = float(std::cos(h.theta)), s2 = float(std::pow(std::sin(h.theta), 2)), a = float(alpha);
  if (term == "D_GGX_naive" || term == "D_BlinnPhong_naive") return {c, a};
  if (term == "D_BlinnPhong") return {s2, a};
  if (term == "D_GTR") return {c, s2, a, float(gamma)};
  if (term == "D_GGXAnisotropic" || term == "D_BeckmannAnisotropic")
    return {float(std::sin(h.theta) * std::cos(h.phi)), float(std::sin(h.theta) * std::sin(h.phi)), c, a,
            float(alpha_y)};
  return {c, s2, a};
}

struct Grid {
  std::vector<std::vector<float>> planes;
  std::vector<double> truth;
};

// theta = atan(alpha t): t counts widths of the lobe, whatever its size.
Grid grid_of(const std::string& term, const std::vector<double>& alphas, const std::vector<double>& widths) {
  Grid grid;
  for (const double alpha : alphas)
    for (const double width : widths) {
      const Direction h{std::atan(alpha * width), 0.7};
      const double a = double(float(alpha)), gamma = 1.5;
      const std::vector<float> in = inputs_of(term, h, a, gamma);
      grid.planes.resize(in.size());
      for (std::size_t k = 0; k < in.size(); ++k) grid.planes[k].push_back(in[k]);
      grid.truth.push_back(truth_of(term, h, a, gamma));
    }
  return grid;
}

// Largest relative error of the usual GGX at one alpha.
double naive_error_at(Session& session, double alpha) {
  const Grid grid = grid_of("D_GGX_naive", {alpha}, spread(0, 3, 2001));
  return relative_error(in_float(session, "D_GGX_naive", grid.planes), grid.truth, 1e-20).max;
}

double stable_over_naive(const Session& session, const Plot& plot) {
  const auto cost = [&](const char* id) {
    const auto at = std::find_if(plot.points.begin(), plot.points.end(), [&](const Point& p) { return p.id == id; });
    return at->cost.at(session.kernels.back()->isa).ns;
  };
  return cost("d-ggx") / cost("d-ggx-naive");
}

}  // namespace

Family measure_distribution(Session& session) {
  Plot plot;
  plot.id = "distribution";
  plot.title = "Normal distributions in float";
  plot.error_name = "largest relative error of D";
  plot.domain =
      "alpha from 1e-4 to 1, half vectors from the normal to 3 lobe widths from it; GTR with gamma = 1.5; the "
      "anisotropic ones with alpha_y = 0.1";
  plot.truth = "the formula in double from the exact angle";
  const int steps = session.quick ? 41 : 201;
  for (const char* term : {"D_GGX", "D_GGX_naive", "D_Beckmann", "D_BlinnPhong", "D_BlinnPhong_naive", "D_GTR",
                           "D_GTR1", "D_GGXAnisotropic", "D_BeckmannAnisotropic"}) {
    session.progress(fmt::format("distribution: {}", term));
    Point point = describe(term);
    const Grid grid = grid_of(term, spread_logarithmic(1e-4, 1, steps), spread(0, 3, steps));
    const std::vector<double> found = in_float(session, term, grid.planes);
    point.method = relative_error(found, grid.truth, 1e-20);
    point.arithmetic = relative_error(found, in_double(term, grid.planes), 1e-20);
    add_cost(session, point, term, grid.planes);
    const std::vector<double> columns = spread(0, 3, 49), rows = spread_logarithmic(1e-4, 1, 49);
    const Grid seen = grid_of(term, rows, columns);
    const std::vector<double> values = in_float(session, term, seen.planes);
    ErrorMap map{"relative error of D in float, within 1", "tan theta / alpha", "alpha", columns, rows, {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
      // Beyond a factor of two wrong is wrong: one method's failure must not wash out the others' maps.
      const double error = (values[i] - seen.truth[i]) / std::max(seen.truth[i], 1e-20);
      map.values.push_back(std::clamp(error, -1.0, 1.0));
    }
    point.maps.push_back(map);
    plot.points.push_back(point);
  }
  const auto worst = [&](const char* id) {
    return std::find_if(plot.points.begin(), plot.points.end(), [&](const Point& p) { return p.id == id; })->method.max;
  };
  Family family;
  family.id = "distribution";
  family.title = "Normal distributions";
  family.about =
      "A distribution is a formula, exact by definition; its error here is what float makes of it, from the values a "
      "renderer has at hand: the cosine, the sine squared taken from the vectors, the components of the half vector. "
      "The naive forms know the cosine alone.";
  family.findings = {
      fmt::format(
          "GGX through the sine keeps its digits ({} at worst) down to alpha = 1e-4; in the usual form the "
          "denominator cancels, from a relative error of {} at alpha = 0.01 to a division by zero below 2.4e-4. "
          "The stable form takes {:.2g} times as long.",
          number(worst("d-ggx")), number(naive_error_at(session, 0.01)), stable_over_naive(session, plot)),
      fmt::format("Blinn-Phong through the sine: {}; through the power of the cosine: {}.",
                  number(worst("d-blinnphong")), number(worst("d-blinnphong-naive"))),
      fmt::format(
          "What is left in the exponential ones ({} for Beckmann) is the rounding of the exponent, magnified by "
          "its size.",
          number(worst("d-beckmann"))),
  };
  family.plots = {plot};
  return family;
}

}  // namespace tessera::chart

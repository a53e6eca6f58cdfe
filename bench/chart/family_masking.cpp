// Masking and shadowing: what each form costs, and how far it moves the light that a specular lobe reflects.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/chart/measure.hpp"
#include "bench/chart/specular_lobe.hpp"
#include "reference/distribution.hpp"
#include "reference/masking.hpp"
#include "reference/microfacet.hpp"
#include "reference/walk.hpp"

namespace tessera::chart {
namespace {

using catalogue::Quantity;
using Planes = std::vector<std::vector<float>>;

const std::vector<std::string> ggx_terms = {"V_SmithGGXCorrelated",
                                            "V_SmithGGXSeparable",
                                            "V_SmithGGXDirectionCorrelated",
                                            "V_SmithGGXHeightDirectionCorrelated",
                                            "V_SmithGGXCorrelatedFast",
                                            "V_SchlickGGX",
                                            "V_SchlickGGXRemapped",
                                            "V_CookTorrance",
                                            "V_Neumann",
                                            "V_Kelemen",
                                            "V_Implicit"};
const std::vector<std::string> beckmann_terms = {"V_SmithBeckmannCorrelated", "V_SmithBeckmannSeparable",
                                                 "V_SmithBeckmannRationalCorrelated",
                                                 "V_SmithBeckmannRationalSeparable", "V_SchlickBeckmann"};

bool takes_azimuth(const std::string& term) {
  const auto& inputs = catalogue::method_of(term).inputs;
  return std::find(inputs.begin(), inputs.end(), Quantity::phi) != inputs.end();
}

// The lobes of a square of roughness (rows) and n.v (columns), one after another.
struct Cells {
  std::vector<double> roughness, NoV;
  std::vector<LobeSample> samples;
  std::vector<double> sample_roughness, truth;  // V
  std::vector<std::size_t> end;                 // of each cell's samples

  [[nodiscard]] std::size_t begin(std::size_t cell) const { return cell == 0 ? 0 : end[cell - 1]; }
};

Cells make_cells(Microfacets microfacets, std::vector<double> roughness, std::vector<double> NoV, int order) {
  Cells cells{std::move(roughness), std::move(NoV), {}, {}, {}, {}};
  const auto lambda = microfacets == Microfacets::ggx ? reference::ggx_lambda : reference::beckmann_lambda;
  for (const double r : cells.roughness)
    for (const double mu : cells.NoV) {
      const double alpha = r * r;
      for (const LobeSample& s : lobe_samples(microfacets, mu, alpha, order)) {
        const double G = reference::joint_masking(reference::Joint::height, lambda(std::acos(mu), alpha),
                                                  lambda(std::acos(std::min(s.l.z, 1.0)), alpha), s.phi);
        cells.samples.push_back(s);
        cells.sample_roughness.push_back(r);
        cells.truth.push_back(G / (4 * mu * s.l.z));
      }
      cells.end.push_back(cells.samples.size());
    }
  return cells;
}

float value_of(Quantity quantity, const LobeSample& s, double roughness) {
  switch (quantity) {
    case Quantity::NoV:
      return float(s.v.z);
    case Quantity::NoL:
      return std::min(float(s.l.z), 1.0f);
    case Quantity::NoH:
      return float(s.NoH);
    case Quantity::VoH:
      return float(s.VoH);
    case Quantity::phi:
      return float(s.phi);
    case Quantity::roughness:
      return float(roughness);
    default:
      return float(roughness * roughness);
  }
}

Planes planes_of(const std::string& term, const Cells& cells) {
  Planes planes;
  for (const Quantity quantity : catalogue::method_of(term).inputs) {
    planes.emplace_back();
    for (std::size_t i = 0; i < cells.samples.size(); ++i)
      planes.back().push_back(value_of(quantity, cells.samples[i], cells.sample_roughness[i]));
  }
  return planes;
}

Error error_of(const std::vector<double>& values) { return absolute_error(values, std::vector<double>(values.size())); }

// What G1 of a form is off from what the facets' visible area demands, relative, at worst. Of a joint form, masking is
// what is left with light along the normal; the V-cavity's depends on the facet.
double constraint_error(const std::string& term, Microfacets microfacets) {
  double worst = 0;
  for (const double alpha : {0.02, 0.1, 0.3, 0.6, 1.0})
    for (const double mu : {0.05, 0.1, 0.3, 0.6, 1.0}) {
      const auto D = [&](double theta) {
        return microfacets == Microfacets::ggx ? reference::ggx_distribution(theta, alpha)
                                               : reference::beckmann_distribution(theta, alpha);
      };
      double G1 = 1;
      if (term != "V_CookTorrance") {
        const double half = std::cos(std::acos(mu) / 2);
        const LobeSample above{{std::sqrt(1 - mu * mu), 0, mu}, {0, 0, 1}, half, half, 0, 0};
        Planes planes;
        for (const Quantity quantity : catalogue::method_of(term).inputs)
          planes.push_back({value_of(quantity, above, std::sqrt(alpha))});
        G1 = 4 * mu * in_double(term, planes)[0];
      }
      const double area =
          reference::visible_area(mu, alpha, D, [&](const reference::Vec3& v, const reference::Vec3& m) {
            return term == "V_CookTorrance" ? reference::v_cavity_g1(v, m) : G1;
          });
      worst = std::max(worst, std::abs(area / mu - 1));
    }
  return worst;
}

void measure_exact(Session& session, Plot& plot, const Cells& cells, Microfacets microfacets,
                   const std::vector<std::string>& terms, const std::map<std::string, Cost>& azimuth) {
  for (const std::string& term : terms) {
    session.progress("masking: " + term);
    Point point = describe(term);
    const Planes planes = planes_of(term, cells);
    const std::vector<double> V = in_double(term, planes);
    point.arithmetic = relative_error(in_float(session, term, planes), V, 1e-20);
    std::vector<double> moved, albedo;
    ErrorMap map{point.title + ": reflected light, relative", "NoV", "roughness", cells.NoV, cells.roughness, {}};
    for (std::size_t cell = 0; cell < cells.end.size(); ++cell) {
      double total = 0, difference = 0, absolute = 0;
      for (std::size_t i = cells.begin(cell); i < cells.end[cell]; ++i) {
        const double weight = cells.samples[i].weight, off = V[i] - cells.truth[i];
        total += weight * cells.truth[i];
        difference += weight * off;
        absolute += weight * std::abs(off);
      }
      moved.push_back(absolute / total);
      albedo.push_back(difference);
      map.values.push_back(difference / total);
    }
    point.method = error_of(moved);
    point.extra["albedo error"] = error_of(albedo).max;
    point.extra["masking constraint error"] = constraint_error(term, microfacets);
    point.maps.push_back(map);
    add_cost(session, point, term, planes);
    if (takes_azimuth(term)) {
      point.note = "its azimuth is an atan2 besides, which is not in the cost";
      for (const auto& [isa, cost] : azimuth) point.extra["azimuth ns " + isa] = cost.ns;
    }
    plot.points.push_back(point);
  }
}

// Against the walk: its first order is the exact single-scattering lobe, in closed form; the rest comes from walks.
Plot measure_walk(Session& session, const Plot& exact) {
  Plot plot;
  const int steps = session.quick ? 4 : 7, order = session.quick ? 6 : 9;
  const long walks = session.quick ? 1000 : 6000;
  const Cells cells = make_cells(Microfacets::ggx, spread(0.25, 1, steps), spread(0.1, 1, steps), order);
  session.progress("masking: random walk");
  std::vector<double> multiple;  // BRDF
  double noise = 0, lost = 0;
  for (std::size_t i = 0; i < cells.samples.size(); ++i) {
    const double r = cells.sample_roughness[i];
    const auto result = reference::walk_brdf({.alpha = r * r}, cells.samples[i].v, cells.samples[i].l, walks, 1, i + 1);
    multiple.push_back(result.multiple.mean);
    lost += result.multiple.mean;
    noise += result.multiple.error;
  }
  plot.id = "masking-walk";
  plot.title = "GGX masking and light that meets several facets";
  plot.error_name = "largest share of light misplaced or missing";
  plot.domain = "D V with F = 1, roughness 0.25 to 1, n.v 0.1 to 1";
  plot.truth = fmt::format("random walk of Heitz 2016 ({} per direction, noise {:.0f} %)", walks,
                           100 * noise / std::max(lost, 1e-30));
  for (const std::string& term : ggx_terms) {
    Point point = *std::find_if(exact.points.begin(), exact.points.end(),
                                [&](const Point& p) { return p.title == catalogue::method_of(term).title; });
    const std::vector<double> V = in_double(term, planes_of(term, cells));
    std::vector<double> moved;
    ErrorMap map{point.title + ": reflected light", "NoV", "roughness", cells.NoV, cells.roughness, {}};
    for (std::size_t cell = 0; cell < cells.end.size(); ++cell) {
      double difference = 0, absolute = 0;
      for (std::size_t i = cells.begin(cell); i < cells.end[cell]; ++i) {
        const LobeSample& s = cells.samples[i];
        const double alpha = cells.sample_roughness[i] * cells.sample_roughness[i];
        const double D = reference::ggx_distribution(std::max(1 - s.NoH * s.NoH, 0.0), s.NoH * s.NoH, alpha);
        const double off = s.weight * (V[i] - cells.truth[i] - multiple[i] / D);
        difference += off;
        absolute += std::abs(off);
      }
      moved.push_back(absolute);
      map.values.push_back(difference);
    }
    point.method = error_of(moved);
    point.maps = {map};
    plot.points.push_back(point);
  }
  return plot;
}

const Point& point_of(const Plot& plot, const std::string& id) {
  return *std::find_if(plot.points.begin(), plot.points.end(), [&](const Point& p) { return p.id == id; });
}

std::vector<std::string> findings(const std::vector<Plot>& plots, const std::string& isa) {
  const Plot &exact = plots[0], &beckmann = plots[1], &walk = plots[2];
  const auto at = [&](const char* id) -> const Point& {
    return point_of(std::string(id).find("beckmann") == std::string::npos ? exact : beckmann, id);
  };
  const auto percent = [](double x) { return fmt::format("{:.3g} %", 100 * x); };
  const auto cost = [&](const char* id) { return fmt::format("{:.3g} ns", at(id).cost.at(isa).ns); };
  const auto constraint = [&](const char* id) { return percent(at(id).extra.at("masking constraint error")); };
  const Point *nearest = nullptr, *best_walk = &walk.points[0];
  for (const Point& p : exact.points)
    if (p.id != "v-smithggxcorrelated" && (nearest == nullptr || p.method.max < nearest->method.max)) nearest = &p;
  for (const Point& p : walk.points)
    if (p.method.mean < best_walk->method.mean) best_walk = &p;
  return {
      fmt::format("Exact height-correlated Smith costs {} ({}). Hammon's form without roots: {}, and {} of the light "
                  "misplaced at worst, {} on average. Schlick's with k = alpha/2: {}, {} and {}.",
                  cost("v-smithggxcorrelated"), isa, cost("v-smithggxcorrelatedfast"),
                  percent(at("v-smithggxcorrelatedfast").method.max),
                  percent(at("v-smithggxcorrelatedfast").method.mean), cost("v-schlickggx"),
                  percent(at("v-schlickggx").method.max), percent(at("v-schlickggx").method.mean)),
      fmt::format("Nearest to it among the other GGX forms: {} ({} at worst, {} on average).", nearest->title,
                  percent(nearest->method.max), percent(nearest->method.mean)),
      fmt::format("UE4's remapped k = (r+1)^2/8 misplaces up to {} (k = alpha/2: {}): it masks even a mirror.",
                  percent(at("v-schlickggxremapped").method.max), percent(at("v-schlickggx").method.max)),
      fmt::format(
          "Schlick's fit for Beckmann, k = alpha sqrt(2/pi), sees {} too little of the surface, and misplaces up "
          "to {} of the light: at grazing angles its k is 2 sqrt 2 times what Beckmann's masking asks for.",
          constraint("v-schlickbeckmann"), percent(at("v-schlickbeckmann").method.max)),
      fmt::format(
          "Beckmann's masking exactly, with erf, costs {} against {} for Walter's rational fit, which misplaces "
          "{} at worst.",
          cost("v-smithbeckmanncorrelated"), cost("v-smithbeckmannrationalcorrelated"),
          percent(at("v-smithbeckmannrationalcorrelated").method.max)),
      fmt::format(
          "The masking constraint, that the facets seen along v have the area n.v, is obeyed by every form built "
          "on Smith's exact Lambda and by the V-cavity ({}); Walter's fit breaks it by {}, Hammon's and "
          "Schlick's k = alpha/2 by {} both (they hide the same G1), Neumann's by {}, Kelemen's by {}.",
          constraint("v-cooktorrance"), constraint("v-smithbeckmannrationalcorrelated"), constraint("v-schlickggx"),
          constraint("v-neumann"), constraint("v-kelemen")),
      fmt::format("The constraint is necessary, not sufficient: separable Smith obeys it and misplaces up to {}, the "
                  "V-cavity up to {}.",
                  percent(at("v-smithggxseparable").method.max), percent(at("v-cooktorrance").method.max)),
      fmt::format("Against the random walk every form of single scattering misses light: {} at worst and {} on average "
                  "with exact Smith; {} on average with the nearest, {}. What is missing is energy, which no masking "
                  "should give back.",
                  percent(point_of(walk, "v-smithggxcorrelated").method.max),
                  percent(point_of(walk, "v-smithggxcorrelated").method.mean), percent(best_walk->method.mean),
                  best_walk->title),
  };
}

}  // namespace

Family measure_masking(Session& session) {
  const int steps = session.quick ? 9 : 25, order = session.quick ? 12 : 24;
  Plot ggx;
  ggx.id = "masking";
  ggx.title = "Masking and shadowing with GGX";
  ggx.error_name = "largest share of light misplaced";
  ggx.domain = "D V with F = 1, roughness 0.1 to 1, n.v 0.02 to 1";
  ggx.truth = "exact height-correlated Smith";
  Plot beckmann = ggx;
  beckmann.id = "masking-beckmann";
  beckmann.title = "Masking and shadowing with Beckmann";
  const auto roughness = spread(0.1, 1, steps), NoV = spread(0.02, 1, steps);
  const auto azimuth = time_term(session, "azimuth_between", Planes(2, std::vector<float>(512, 0.3f)));
  measure_exact(session, ggx, make_cells(Microfacets::ggx, roughness, NoV, order), Microfacets::ggx, ggx_terms,
                azimuth);
  measure_exact(session, beckmann, make_cells(Microfacets::beckmann, roughness, NoV, order), Microfacets::beckmann,
                beckmann_terms, azimuth);
  Family family;
  family.id = "masking";
  family.title = "Masking and shadowing";
  family.about =
      "A specular lobe is D F V. With its distribution and F = 1, the lobe of each form of V is summed over all "
      "directions of light and compared with the lobe of exact Smith masking, correlated by height: the error is the "
      "share of the reflected light that lies elsewhere, or is missing, or too much. In the table: the error of the "
      "sum "
      "(albedo), and how far the form breaks the masking constraint. The last plot has as truth a random walk, in "
      "which light may meet several facets.";
  family.plots = {ggx, beckmann, measure_walk(session, ggx)};
  family.findings = findings(family.plots, session.kernels.back()->isa);
  return family;
}

}  // namespace tessera::chart

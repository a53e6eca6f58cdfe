// Diffuse lobes against a random walk on diffuse facets. How they share light with a specular lobe: diffuse_split.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/chart/diffuse_lobes.hpp"
#include "reference/walk.hpp"

namespace tessera::chart {
namespace {

using catalogue::Quantity;
using reference::Vec3;
using Planes = std::vector<std::vector<float>>;

// A white rough surface: roughness (rows) by n.v (columns), alpha = roughness^2.
struct Walks {
  std::vector<double> roughness, NoV;
  std::vector<std::vector<DiffuseSample>> samples;  // by column
  std::vector<std::vector<double>> brdf;            // by cell
  std::vector<double> grey;                         // albedo for facets that reflect half, by cell
  double noise = 0;                                 // mean relative standard error of a BRDF value
  long walks = 0;
};

Walks walk(Session& session) {
  const int steps = session.quick ? 4 : 7, order = session.quick ? 3 : 4;
  Walks w{spread(0.1, 1, steps), spread(0.1, 1, steps), {}, {}, {}, 0, session.quick ? 800 : 5000};
  for (const double mu : w.NoV) w.samples.push_back(hemisphere(mu, order, mu));
  using Facets = reference::Microsurface::Facets;
  long count = 0;
  for (const double r : w.roughness) {
    session.progress(fmt::format("diffuse: random walk, roughness {}", r));
    for (std::size_t c = 0; c < w.NoV.size(); ++c) {
      std::vector<double> brdf;
      for (const DiffuseSample& s : w.samples[c]) {
        const auto total = reference::walk_brdf({.alpha = r * r, .facets = Facets::diffuse}, s.v, s.l, w.walks, 1,
                                                std::uint64_t(++count))
                               .total;
        brdf.push_back(total.mean);
        w.noise += total.error / total.mean;
      }
      w.brdf.push_back(brdf);
      w.grey.push_back(reference::walk_albedo({r * r, [](double) { return 0.5; }, Facets::diffuse}, w.NoV[c],
                                              20 * w.walks, 1, std::uint64_t(++count))
                           .total.mean);
    }
  }
  w.noise /= double(count);
  return w;
}

Planes planes_of(const std::string& term, const std::vector<DiffuseSample>& samples, double parameter, double albedo) {
  Planes planes;
  for (const Quantity quantity : catalogue::method_of(term).inputs) {
    planes.emplace_back();
    for (const DiffuseSample& s : samples) {
      const double LoV = std::clamp(dot(s.l, s.v), -1.0, 1.0);
      const double value = quantity == Quantity::albedo      ? albedo
                           : quantity == Quantity::roughness ? parameter
                           : quantity == Quantity::F0        ? 0
                           : quantity == Quantity::NoV       ? s.v.z
                           : quantity == Quantity::NoL       ? s.l.z
                           : quantity == Quantity::VoH       ? std::sqrt(0.5 * (1 + LoV))
                                                             : LoV;
      planes.back().push_back(float(value));
    }
  }
  return planes;
}

// Values of the lobe for facets of this albedo; terms without it are proportional to it.
std::vector<double> lobe(const std::string& term, const std::vector<DiffuseSample>& samples, double parameter,
                         double albedo) {
  std::vector<double> f = in_double(term, planes_of(term, samples, parameter, albedo));
  if (catalogue::method_of(term).inputs[0] != Quantity::albedo)
    for (double& x : f) x *= albedo;
  return f;
}

double misplaced(const std::vector<DiffuseSample>& samples, const std::vector<double>& f,
                 const std::vector<double>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < f.size(); ++i) sum += samples[i].weight * std::abs(f[i] - truth[i]);
  return sum;
}

// |f(v,l) - f(l,v)| at worst.
double reciprocity_error(const std::string& term) {
  double worst = 0;
  for (const double mu : {0.05, 0.3, 0.9})
    for (const DiffuseSample& s : hemisphere(mu, 3, mu)) {
      const double there = lobe(term, {s}, 0.7, 0.8)[0], back = lobe(term, {{s.l, s.v, 1}}, 0.7, 0.8)[0];
      worst = std::max(worst, std::abs(there - back));
    }
  return worst;
}

Plot measure_lobes(Session& session) {
  const Walks truth = walk(session);
  Plot plot;
  plot.id = "diffuse";
  plot.title = "Diffuse lobes on a rough white surface";
  plot.error_name = "largest share of light misplaced";
  plot.domain = "albedo 1, roughness 0.1 to 1 as it is, n.v 0.1 to 1";
  plot.truth = fmt::format("random walk, GGX, white Lambertian facets ({} per direction, noise {:.1f} %)", truth.walks,
                           100 * truth.noise);
  for (const std::string term :
       {"Fd_Lambert", "Fd_Burley", "Fd_Frostbite", "Fd_OrenNayar", "Fd_Fujii", "Fd_EON", "Fd_EONExact"}) {
    session.progress("diffuse: " + term);
    Point point = describe(term);
    std::vector<double> moved, fitted, white, grey;
    std::string parameters;
    ErrorMap map{point.title + ": light too much or missing", "NoV", "roughness", truth.NoV, truth.roughness, {}};
    for (std::size_t row = 0; row < truth.roughness.size(); ++row) {
      const auto row_of = [&](double parameter) {
        std::vector<double> errors;
        for (std::size_t c = 0; c < truth.NoV.size(); ++c)
          errors.push_back(misplaced(truth.samples[c], lobe(term, truth.samples[c], parameter, 1),
                                     truth.brdf[row * truth.NoV.size() + c]));
        return errors;
      };
      const std::vector<double> as_it_is = row_of(truth.roughness[row]);
      moved.insert(moved.end(), as_it_is.begin(), as_it_is.end());
      double suited = truth.roughness[row];
      std::vector<double> best = as_it_is;  // of all parameters, that with the least largest error
      for (double parameter = 0; parameter <= 1; parameter += 0.02)
        if (const auto errors = row_of(parameter);
            *std::max_element(errors.begin(), errors.end()) < *std::max_element(best.begin(), best.end()))
          best = errors, suited = parameter;
      parameters += fmt::format("{}{:.2f} for {:.2f}", row == 0 ? "" : ", ", suited, truth.roughness[row]);
      fitted.insert(fitted.end(), best.begin(), best.end());
      for (std::size_t c = 0; c < truth.NoV.size(); ++c) {
        const auto smooth_sum = hemisphere(truth.NoV[c], 16, truth.NoV[c]);
        white.push_back(albedo_of(smooth_sum, lobe(term, smooth_sum, truth.roughness[row], 1)) - 1);
        grey.push_back(albedo_of(smooth_sum, lobe(term, smooth_sum, truth.roughness[row], 0.5)) -
                       truth.grey[row * truth.NoV.size() + c]);
        map.values.push_back(white.back());
      }
    }
    point.method = error_of(moved);
    if (term != "Fd_Lambert") point.note = "parameters that suit the walk best: " + parameters;
    point.extra["error with the best parameter"] = error_of(fitted).max;
    point.extra["albedo error, white"] = error_of(white).max;
    point.extra["albedo error, grey"] = error_of(grey).max;
    point.extra["largest albedo"] = 1 + *std::max_element(white.begin(), white.end());
    point.extra["reciprocity error"] = reciprocity_error(term);
    point.maps.push_back(map);
    const Planes drawn = draw_inputs(catalogue::method_of(term), session.quick ? 20000 : 200000, 3);
    point.arithmetic = relative_error(in_float(session, term, drawn), in_double(term, drawn), 0.05);
    add_cost(session, point, term, planes_of(term, hemisphere(0.4, 12, 0.4), 0.6, 0.8));
    plot.points.push_back(point);
  }
  return plot;
}

std::vector<std::string> findings(const Plot& lobes, const Plot& split, const std::string& isa) {
  const auto at = [&](const Plot& plot, const char* id) -> const Point& {
    return *std::find_if(plot.points.begin(), plot.points.end(), [&](const Point& p) { return p.id == id; });
  };
  const auto percent = [](double x) { return fmt::format("{:.3g} %", 100 * x); };
  const auto cost = [&](const Point& p) { return fmt::format("{:.3g} ns", p.cost.at(isa).ns); };
  const char* fit_error = "error with the best parameter";
  const Point *best = &lobes.points[0], *fitted = &lobes.points[0];
  for (const Point& p : lobes.points) {
    if (p.method.max < best->method.max) best = &p;
    if (p.extra.at(fit_error) < fitted->extra.at(fit_error)) fitted = &p;
  }
  const Point &lambert = at(lobes, "fd-lambert"), &burley = at(lobes, "fd-burley"),
              &frostbite = at(lobes, "fd-frostbite"), &oren_nayar = at(lobes, "fd-orennayar"),
              &eon = at(lobes, "fd-eon"), &exact = at(lobes, "fd-eonexact");
  return {
      fmt::format(
          "Given the same roughness, {} comes nearest to the random walk at worst: {} of the light misplaced, {} "
          "on average; but Lambert, which knows no roughness, {} and {}: a model's roughness is not that of a GGX "
          "surface.",
          best->title, percent(best->method.max), percent(best->method.mean), percent(lambert.method.max),
          percent(lambert.method.mean)),
      fmt::format(
          "With the parameter that suits the walk best, {} comes nearest, {} at worst, then Oren-Nayar {}, Burley "
          "{}, Frostbite {}. For {}, {}.",
          fitted->title, percent(fitted->extra.at(fit_error)), percent(oren_nayar.extra.at(fit_error)),
          percent(burley.extra.at(fit_error)), percent(frostbite.extra.at(fit_error)), fitted->title, fitted->note),
      fmt::format(
          "Burley's lobe returns up to {} of what it receives; renormalised for Frostbite at most {}, but off by "
          "{} at worst where it stands alone.",
          percent(burley.extra.at("largest albedo")), percent(frostbite.extra.at("largest albedo")),
          percent(frostbite.extra.at("albedo error, white"))),
      fmt::format(
          "Oren and Nayar's qualitative model lacks the light between facets: {} of a white surface's at worst. "
          "EON returns all but {} (fitted, {}) and all (exact, {}).",
          percent(oren_nayar.extra.at("albedo error, white")), percent(eon.extra.at("albedo error, white")), cost(eon),
          cost(exact)),
      fmt::format(
          "Below a specular lobe: 1 - F(n.v) is off by {} at worst, 1 - F(v.h) by {}, 1 - E(v) and its "
          "reciprocal form (1 - E(v))(1 - E(l)) / (1 - Eavg) by less than {}, Ashikhmin and Shirley's lobe by {}.",
          percent(at(split, "kd-fresnel-nov").method.max), percent(at(split, "kd-fresnel-voh").method.max),
          percent(at(split, "kd-coupled").method.max), percent(at(split, "fd-ashikhminshirley").method.max)),
      fmt::format("1 - F is often called not reciprocal. Of v.h it is ({}): v.h = l.h. Of n.v it is not ({}), and no "
                  "more is 1 - E(v) ({}).",
                  number(at(split, "kd-fresnel-voh").extra.at("reciprocity error")),
                  number(at(split, "kd-fresnel-nov").extra.at("reciprocity error")),
                  number(at(split, "kd-albedoscaled").extra.at("reciprocity error"))),
  };
}

}  // namespace

Family measure_diffuse(Session& session) {
  Family family;
  family.id = "diffuse";
  family.title = "Diffuse reflection";
  family.about =
      "Each lobe is compared, over all directions of light, with a random walk on a rough surface whose facets are "
      "Lambertian and white: the error is the share of the light that goes elsewhere, or is missing, or too much. The "
      "statistical noise of the walk is part of every error. In the table: the error of the albedo for white and for "
      "grey (0.5) facets, and the error with the parameter that suits the walk best. The second plot is about the "
      "light "
      "that a specular lobe leaves for the diffuse one.";
  family.plots = {measure_lobes(session), measure_split(session)};
  family.findings = findings(family.plots[0], family.plots[1], session.kernels.back()->isa);
  return family;
}

}  // namespace tessera::chart

// Energy that single scattering loses: what each compensation costs, how near it comes to the random walk inside the
// surface, and whether it is reciprocal.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"
#include "bench/chart/measure.hpp"
#include "reference/albedo.hpp"
#include "reference/energy_table.hpp"
#include "reference/fresnel.hpp"
#include "reference/microfacet.hpp"
#include "reference/quadrature.hpp"
#include "reference/walk.hpp"

namespace tessera::chart {
namespace {

using Planes = std::vector<std::vector<float>>;

struct Table {
  int size = 0;
  std::vector<float> texels;
};

// A term, and the table it reads.
struct Choice {
  std::string term;
  const Table* table = nullptr;
};

Point describe(const Choice& choice) {
  Point point = chart::describe(choice.term);
  if (choice.table != nullptr) {
    point.id += fmt::format("-{}", choice.table->size);
    point.title += fmt::format(" {0} x {0}", choice.table->size);
    point.extra["bytes"] = double(choice.table->texels.size() * sizeof(float));
  }
  return point;
}

std::vector<double> in_double(const Choice& choice, const Planes& inputs, int output = 0) {
  static const Table none;
  const Table& table = choice.table == nullptr ? none : *choice.table;
  return chart::in_double(choice.term, inputs, table.texels.data(), table.size, output);
}

void add_cost_and_rounding(Session& session, const Choice& choice, const Planes& drawn, Point& point) {
  const float* texels = choice.table == nullptr ? nullptr : choice.table->texels.data();
  const int size = choice.table == nullptr ? 0 : choice.table->size;
  point.arithmetic = relative_error(in_float(session, choice.term, drawn, texels, size),
                                    chart::in_double(choice.term, drawn, texels, size), 1e-2);
  add_cost(session, point, choice.term, drawn, texels, size);
}

// The truth over roughness (rows), NoV (columns) and F0.
struct Truth {
  std::vector<double> roughness, NoV, f0 = {0.3, 0.6, 0.9, 1};
  std::vector<reference::DirectionalAlbedo> lobe;  // per cell
  std::vector<std::vector<double>> albedo;         // per F0, per cell
  double error = 0;                                // largest standard error

  [[nodiscard]] std::size_t cells() const { return lobe.size(); }
  [[nodiscard]] double row(std::size_t cell) const { return roughness[cell / NoV.size()]; }
  [[nodiscard]] double column(std::size_t cell) const { return NoV[cell % NoV.size()]; }
};

Truth make_truth(bool quick) {
  Truth truth;
  const int n = quick ? 8 : 16;
  const long walks = quick ? 20000 : 100000;
  truth.roughness = spread(0.1, 1, n);
  truth.NoV = spread_logarithmic(0.02, 1, n);
  const std::size_t cells = std::size_t(n) * std::size_t(n);
  truth.lobe.resize(cells);
  truth.albedo.assign(truth.f0.size(), std::vector<double>(cells));
  std::vector<double> errors(cells, 0);
  parallel_for(cells, [&](std::size_t cell) {
    const double alpha = std::pow(truth.roughness[cell / std::size_t(n)], 2), mu = truth.NoV[cell % std::size_t(n)];
    truth.lobe[cell] = reference::directional_albedo(mu, alpha, 64);
    for (std::size_t k = 0; k < truth.f0.size(); ++k) {
      const double f0 = truth.f0[k];
      const auto schlick = [=](double c) {
        const double m = 1 - c;
        return f0 + (1 - f0) * m * m * m * m * m;
      };
      double multiple = 1 - truth.lobe[cell].E();  // white facets absorb nothing
      if (f0 < 1) {
        const auto walk = reference::walk_albedo({alpha, schlick}, mu, walks, 1, cell + 1).multiple;
        multiple = walk.mean;
        errors[cell] = std::max(errors[cell], walk.error);
      }
      truth.albedo[k][cell] = f0 * truth.lobe[cell].A + truth.lobe[cell].B + multiple;
    }
  });
  truth.error = *std::max_element(errors.begin(), errors.end());
  return truth;
}

// Inputs of an f_ term in the order of the catalogue.
Planes lobe_inputs(const std::string& term, const std::vector<float>& single, const std::vector<float>& NoL, double f0,
                   double mu, double alpha) {
  const std::size_t n = NoL.size();
  const std::size_t inputs = catalogue::method_of(term).inputs.size();
  Planes planes = {single};
  if (inputs == 1) return planes;
  planes.insert(planes.end(), {std::vector<float>(n, float(f0)), std::vector<float>(n, float(mu))});
  if (inputs == 5) planes.push_back(NoL);
  planes.emplace_back(n, float(alpha));
  return planes;
}

// Every f_ is affine in the single-scattering lobe: f = scale single + added(l); added is integrated over panels that
// follow l / alpha.
double lobe_albedo(const Choice& choice, const reference::DirectionalAlbedo& lobe, double f0, double mu, double alpha) {
  std::vector<float> l, weight;
  const auto& rule = reference::gauss_legendre(8);
  double low = 0;
  for (double high = std::min(alpha / 10, 1.0); low < 1; low = high, high = std::min(high * 2.5, 1.0))
    for (std::size_t i = 0; i < 8; ++i) {
      l.push_back(float(low + (high - low) * rule.nodes[i]));
      weight.push_back(float(2 * std::numbers::pi * (high - low) * rule.weights[i]));
    }
  const std::vector<float> zero(l.size(), 0), one(l.size(), 1);
  const std::vector<double> added = in_double(choice, lobe_inputs(choice.term, zero, l, f0, mu, alpha));
  const std::vector<double> with = in_double(choice, lobe_inputs(choice.term, one, l, f0, mu, alpha));
  double sum = (with.back() - added.back()) * (f0 * lobe.A + lobe.B);
  for (std::size_t i = 0; i < l.size(); ++i) sum += double(weight[i]) * double(l[i]) * added[i];
  return sum;
}

double split_albedo(const Choice& choice, const reference::DirectionalAlbedo& lobe, double f0, double mu,
                    double alpha) {
  Planes planes = {{float(f0)}, {float(lobe.A)}, {float(lobe.B)}};
  if (choice.term == "split_KullaConty") planes.push_back({float(alpha)});
  if (choice.term == "split_Hill") planes.insert(planes.end(), {{float(mu)}, {float(alpha)}});
  if (choice.term == "split_FdezAguera_kS") planes.insert(planes.end(), {{float(mu)}, {float(std::sqrt(alpha))}});
  return in_double(choice, planes)[0] + in_double(choice, planes, 1)[0];
}

// |f(v,l) - f(l,v)| over their mean, at worst: directions a quarter turn apart.
double reciprocity_error(const Choice& choice) {
  double worst = 0;
  for (const double r : {0.2, 0.5, 0.8, 1.0})
    for (const double v : {0.1, 0.4, 0.8})
      for (const double l : {0.2, 0.6, 1.0}) {
        const double alpha = r * r, f0 = 0.8;
        const reference::Vec3 a = {std::sqrt(1 - v * v), 0, v}, b = {0, std::sqrt(1 - l * l), l};
        const double cosine = std::sqrt((1 + reference::dot(a, b)) / 2);
        const auto single =
            float(reference::specular_brdf_over_fresnel(a, b, alpha) * reference::fresnel_schlick(f0, cosine));
        const double there = in_double(choice, lobe_inputs(choice.term, {single}, {float(l)}, f0, v, alpha))[0];
        const double back = in_double(choice, lobe_inputs(choice.term, {single}, {float(v)}, f0, l, alpha))[0];
        worst = std::max(worst, std::abs(there - back) / (0.5 * (there + back)));
      }
  return worst;
}

using Albedo = double (*)(const Choice&, const reference::DirectionalAlbedo&, double f0, double mu, double alpha);

Point measure_point(Session& session, const Choice& choice, const Truth& truth, Albedo albedo) {
  session.progress("energy: " + choice.term);
  Point point = describe(choice);
  std::vector<double> found, exact;
  double furnace = 0, gain = 0;
  for (std::size_t k = 0; k < truth.f0.size(); ++k) {
    ErrorMap map{fmt::format("F0 = {}", truth.f0[k]), "NoV", "roughness", truth.NoV, truth.roughness, {}};
    for (std::size_t cell = 0; cell < truth.cells(); ++cell) {
      const double E = albedo(choice, truth.lobe[cell], truth.f0[k], truth.column(cell), std::pow(truth.row(cell), 2));
      found.push_back(E);
      exact.push_back(truth.albedo[k][cell]);
      map.values.push_back(E - exact.back());
      gain = std::max(gain, E - 1);
      if (truth.f0[k] == 1) furnace = std::max(furnace, std::abs(E - 1));
    }
    if (truth.f0[k] == 0.6 || truth.f0[k] == 1) point.maps.push_back(map);
  }
  point.method = absolute_error(found, exact);
  point.extra["white furnace error"] = furnace;
  point.extra["largest gain"] = gain;
  Planes drawn = catalogue::draw_inputs(catalogue::method_of(choice.term), 4096, 1);
  if (choice.term.rfind("split_", 0) == 0)  // A and B that a lobe can have
    for (std::size_t i = 0; i < drawn[0].size(); ++i) {
      drawn[1][i] = 0.3f + 0.7f * drawn[1][i];
      drawn[2][i] *= 1 - drawn[1][i];
    }
  add_cost_and_rounding(session, choice, drawn, point);
  return point;
}

Plot measure_loss(Session& session, const std::vector<Choice>& choices) {
  Plot plot{
      "energy-loss", "The lost energy", "largest error of 1 - E", {}, "1 - E by quadrature (64 x 64 x 2 nodes)", {}};
  plot.domain = "roughness 0.02 to 1, NoV 0.0001 to 1";
  const int n = session.quick ? 16 : 40;
  const std::vector<double> rows = spread(0.02, 1, n), columns = spread_logarithmic(1e-4, 1, n);
  std::vector<double> exact(rows.size() * columns.size());
  parallel_for(exact.size(), [&](std::size_t i) {
    const double r = rows[i / columns.size()];
    exact[i] = 1 - reference::directional_albedo(columns[i % columns.size()], r * r, 64).E();
  });
  Planes inputs(2);
  for (const double r : rows)
    for (const double mu : columns) {
      inputs[0].push_back(float(mu));
      inputs[1].push_back(float(r * r));
    }
  for (const Choice& choice : choices) {
    session.progress("energy: " + choice.term);
    Point point = describe(choice);
    const std::vector<double> found = in_double(choice, inputs);
    point.method = absolute_error(found, exact);
    ErrorMap map{point.title, "NoV", "roughness", columns, rows, {}};
    for (std::size_t i = 0; i < exact.size(); ++i) map.values.push_back(found[i] - exact[i]);
    point.maps.push_back(map);
    add_cost_and_rounding(session, choice, catalogue::draw_inputs(catalogue::method_of(choice.term), 4096, 1), point);
    plot.points.push_back(point);
  }
  return plot;
}

const Point& point_of(const Plot& plot, const std::string& id) {
  return *std::find_if(plot.points.begin(), plot.points.end(), [&](const Point& p) { return p.id == id; });
}

std::vector<std::string> findings(const Plot& light, const Plot& environment, const Plot& loss) {
  const auto at = [&](const char* id) { return number(point_of(light, id).method.max); };
  const auto extra = [&](const char* id, const char* column) { return number(point_of(light, id).extra.at(column)); };
  const Point &f0 = point_of(environment, "split-fdezaguera"), &kS = point_of(environment, "split-fdezaguera-ks");
  const Point &small = point_of(loss, "ems-ggx-table-32"), &polynomial = point_of(loss, "ems-ggx");
  return {
      fmt::format("Without compensation up to {} of the light is missing. Kulla-Conty's lobe brings the error to {}, "
                  "Turquin's scale to {}, the series in F0 after Hill to {}; in a white furnace (F0 = 1) they are off "
                  "by {}, {} and {}.",
                  at("f-singlescattering"), at("f-kullaconty-table-64"), at("f-turquin-table-64"), at("f-hill"),
                  extra("f-kullaconty-table-64", "white furnace error"),
                  extra("f-turquin-table-64", "white furnace error"), extra("f-hill", "white furnace error")),
      fmt::format("The colour of Kulla-Conty's first slides leaves out the absorption at one facet: largest error {} "
                  "against {} with "
                  "Favg squared, as Hill corrected it.",
                  at("f-kullaconty-slides"), at("f-kullaconty")),
      fmt::format("Energy and reciprocity are bought apart: Kulla-Conty is reciprocal to {}, Turquin's scale, cheaper, "
                  "differs by up to {} when light and eye change places, the series by up to {}.",
                  extra("f-kullaconty", "reciprocity error"), extra("f-turquin", "reciprocity error"),
                  extra("f-hill", "reciprocity error")),
      fmt::format("Fdez-Aguera: with F0, as derived, the largest error is {} and the mean {}; with the "
                  "roughness-dependent kS of the published listing {} and {}. {} is nearer to the walk.",
                  number(f0.method.max), number(f0.method.mean), number(kS.method.max), number(kS.method.mean),
                  f0.method.mean < kS.method.mean ? "F0" : "kS"),
      fmt::format(
          "E in the variable mu / (mu + 2.5 alpha): a table of 32 x 32 values is within {}, a polynomial within "
          "{}, down to NoV = 0.0001.",
          number(small.method.max), number(polynomial.method.max))};
}

}  // namespace

Family measure_energy(Session& session) {
  session.progress("energy: tables");
  const Table small{32, reference::energy_loss_table(32)}, large{64, reference::energy_loss_table(64)};
  session.progress("energy: random walks");
  const Truth truth = make_truth(session.quick);

  Plot light{"energy-light", "For a light", "largest error of reflected light", {}, {}, {}};
  light.domain = "F0 0.3, 0.6, 0.9 and 1, roughness 0.1 to 1, NoV 0.02 to 1";
  light.truth = "random walk on the Smith microsurface, Schlick's Fresnel at each facet (Heitz et al. 2016)";
  for (const Choice& choice : std::vector<Choice>{{"f_SingleScattering"},
                                                  {"f_KullaConty"},
                                                  {"f_KullaConty_table", &small},
                                                  {"f_KullaConty_table", &large},
                                                  {"f_KullaConty_slides"},
                                                  {"f_Turquin"},
                                                  {"f_Turquin_table", &small},
                                                  {"f_Turquin_table", &large},
                                                  {"f_Hill"}}) {
    light.points.push_back(measure_point(session, choice, truth, lobe_albedo));
    light.points.back().extra["reciprocity error"] = reciprocity_error(choice);
  }
  Plot environment{"energy-environment", "For an environment", light.error_name, light.domain, light.truth, {}};
  for (const char* term : {"split_SingleScattering", "split_KullaConty", "split_Turquin", "split_Hill",
                           "split_FdezAguera", "split_FdezAguera_kS"})
    environment.points.push_back(measure_point(session, {term}, truth, split_albedo));
  const Plot loss =
      measure_loss(session, {{"Ems_GGX"}, {"Ems_GGX_table", &small}, {"Ems_GGX_table", &large}, {"Ems_GGX_integral"}});

  Family family;
  family.id = "energy";
  family.title = "Energy compensation";
  family.about = fmt::format(
      "A single-scattering lobe drops light that leaves one microfacet only to meet another: a white metal turns grey "
      "as "
      "it gets rough. Error is that of the light reflected under a white sky; truth is the lobe by quadrature plus a "
      "random walk for all further facets, whose largest standard error is {}. Cost includes 1 - E of each direction "
      "and its average, computed anew for each evaluation.",
      number(truth.error));
  family.findings = findings(light, environment, loss);
  family.plots = {light, environment, loss};
  return family;
}

}  // namespace tessera::chart

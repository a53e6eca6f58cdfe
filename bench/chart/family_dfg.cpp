// The environment BRDF: tables by size, format, axes and filter, against fits.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bench/chart/measure.hpp"
#include "precompute/dfg_variants.hpp"
#include "reference/albedo.hpp"

namespace tessera::chart {
namespace {

struct Truth {
  std::vector<std::vector<float>> inputs{2};
  std::vector<double> A, B;
  std::size_t columns = 0, rows = 0, uniform = 0;  // the first columns * rows points are a uniform grid
  double convergence = 0;  // the largest difference that 1.5 times the nodes make, at every 16th point
};

Truth make_truth(bool quick) {
  Truth t;
  const int n = quick ? 40 : 96, order = 48;
  const auto add = [&](double mu, double r) {
    const float m = std::clamp(float(mu), 1e-3f, 1.0f), q = std::clamp(float(r), 0.02f, 1.0f);
    const auto e = reference::directional_albedo(m, double(q) * q, order);
    t.inputs[0].push_back(m);
    t.inputs[1].push_back(q);
    t.A.push_back(e.A);
    t.B.push_back(e.B);
    if (t.A.size() % 16 != 1) return;
    const auto finer = reference::directional_albedo(m, double(q) * q, order * 3 / 2);
    t.convergence = std::max({t.convergence, std::abs(finer.A - e.A), std::abs(finer.B - e.B)});
  };
  for (const double r : spread(0.02, 1, n))
    for (const double mu : spread(1e-3, 1, n)) add(mu, r);
  t.columns = t.rows = std::size_t(n);
  t.uniform = t.A.size();
  for (const double r : spread_logarithmic(0.02, 1, n))
    for (const double mu : spread_logarithmic(1e-3, 1, n)) add(mu, r);
  return t;
}

// The larger of A's and B's, largest over all points, mean and rms over the uniform grid.
Error error_of(const Truth& t, const std::vector<double>& A, const std::vector<double>& B) {
  Error e;
  double sum[2] = {}, squares[2] = {};
  for (std::size_t k = 0; k < t.A.size(); ++k) {
    const double d[2] = {std::abs(A[k] - t.A[k]), std::abs(B[k] - t.B[k])};
    e.max = std::max({e.max, d[0], d[1]});
    for (int c = 0; c < 2 && k < t.uniform; ++c) sum[c] += d[c], squares[c] += d[c] * d[c];
  }
  e.mean = std::max(sum[0], sum[1]) / double(t.uniform);
  e.rms = std::sqrt(std::max(squares[0], squares[1]) / double(t.uniform));
  return e;
}

Point measure(Session& session, const Truth& t, const std::string& term, const DfgVariant* table, bool maps) {
  session.progress("dfg: " + term + (table != nullptr ? fmt::format(" {}", table->size) : ""));
  Point point = describe(term);
  const float* words = table != nullptr ? table->words.data() : nullptr;
  const int size = table != nullptr ? table->size : 0;
  const auto A = in_double(term, t.inputs, words, size, 0), B = in_double(term, t.inputs, words, size, 1);
  point.method = error_of(t, A, B);
  for (int c = 0; c < 2; ++c) {
    const Error e = absolute_error(in_float(session, term, t.inputs, words, size, c), c == 0 ? A : B);
    if (e.max >= point.arithmetic.max) point.arithmetic = e;
  }
  // Scattered points, so that a table is read all over, as pixels of different materials do.
  std::vector<std::vector<float>> inputs(2, std::vector<float>(1024));
  for (std::size_t k = 0; k < 1024; ++k)
    for (std::size_t i = 0; i < 2; ++i) inputs[i][k] = t.inputs[i][(k * 7919 + 13) % t.uniform];
  point.cost = time_term(session, term, inputs, words, size);
  point.extra["bytes"] = table != nullptr ? double(table->bytes) : 0;
  if (maps)
    for (int c = 0; c < 2; ++c) {
      ErrorMap map;
      map.title = c == 0 ? "A" : "B";
      map.column_name = "NoV";
      map.row_name = "roughness";
      map.columns = spread(1e-3, 1, int(t.columns));
      map.rows = spread(0.02, 1, int(t.rows));
      for (std::size_t k = 0; k < t.uniform; ++k) map.values.push_back(c == 0 ? A[k] - t.A[k] : B[k] - t.B[k]);
      point.maps.push_back(std::move(map));
    }
  return point;
}

Plot plot_of(const Truth& truth, std::string id, std::string title) {
  Plot plot;
  plot.id = std::move(id);
  plot.title = std::move(title);
  plot.error_name = "largest error of A and B";
  plot.domain = "NoV in [1e-3,1], roughness in [0.02,1], off the nodes";
  plot.truth = fmt::format("quadrature in double, converged to {}", number(truth.convergence));
  return plot;
}

constexpr std::array<std::pair<DfgAxes, const char*>, 3> all_axes = {
    {{DfgAxes::linear, "linear"}, {DfgAxes::root, "root"}, {DfgAxes::warped, "warped"}}};
constexpr std::array<std::pair<DfgFormat, const char*>, 3> all_formats = {
    {{DfgFormat::float32, "float"}, {DfgFormat::half, "half"}, {DfgFormat::unorm16, "unorm16"}}};

class Tables {
 public:
  Tables(Session& session, const Truth& truth) : session_(session), truth_(truth) {}

  Point point(DfgAxes axes, const char* filter, DfgFormat format, int size, bool balanced = false, bool maps = false) {
    const DfgVariant table = build_dfg_variant(*session_.kernels.back(), axes, format, size, balanced);
    const std::string term =
        std::string("dfg_") + name(all_axes, axes) + "_" + filter + "_" + name(all_formats, format);
    Point p = measure(session_, truth_, term, &table, maps);
    p.id += fmt::format("-{}{}", size, balanced ? "-balanced" : "");
    p.title += fmt::format(", {} x {}{}", size, size, balanced ? ", balanced nodes" : "");
    if (balanced) p.note = "nodes moved by 1/16 of the second differences: half the error between them, at no cost";
    return p;
  }

 private:
  template <class List, class Value>
  static const char* name(const List& list, Value value) {
    for (const auto& [v, text] : list)
      if (v == value) return text;
    return "";
  }

  Session& session_;
  const Truth& truth_;
};

const Point& smallest(const Plot& plot, double bound) {
  const Point* best = &plot.points.front();
  for (const Point& p : plot.points)
    if (p.method.max <= bound && (best->method.max > bound || p.extra.at("bytes") < best->extra.at("bytes"))) best = &p;
  return *best;
}

}  // namespace

Family measure_dfg(Session& session) {
  const Truth truth = make_truth(session.quick);
  Tables tables(session, truth);
  Family family;
  family.id = "dfg";
  family.title = "Look-up tables: the environment BRDF";

  Plot fits = plot_of(truth, "dfg-fits", "Fits, and the tables they stand against");
  for (const char* term : {"dfg_Lazarov", "dfg_Karis", "dfg_MaterialX", "dfg_fit_small", "dfg_fit"})
    fits.points.push_back(measure(session, truth, term, nullptr, true));
  fits.points.push_back(tables.point(DfgAxes::linear, "bilinear", DfgFormat::float32, 128, false, true));
  fits.points.push_back(tables.point(DfgAxes::warped, "bilinear", DfgFormat::unorm16, 128, true, true));
  fits.points.push_back(tables.point(DfgAxes::warped, "cubic", DfgFormat::unorm16, 32, false, true));

  Plot sizes = plot_of(truth, "dfg-axes", "Tables by axes, filter and size (float)");
  for (const auto& [axes, name] : all_axes)
    for (const char* filter : {"nearest", "bilinear", "cubic"})
      for (const int size : session.quick ? std::vector{32, 128} : std::vector{16, 32, 64, 128, 256, 512})
        sizes.points.push_back(tables.point(axes, filter, DfgFormat::float32, size));
  for (const int size : session.quick ? std::vector{128} : std::vector{64, 128, 256})
    sizes.points.push_back(tables.point(DfgAxes::warped, "bilinear", DfgFormat::float32, size, true));

  Plot formats = plot_of(truth, "dfg-formats", "Tables by format (warped axes)");
  for (const auto& [format, name] : all_formats)
    for (const int size : session.quick ? std::vector{128} : std::vector{32, 64, 128, 256}) {
      formats.points.push_back(tables.point(DfgAxes::warped, "bilinear", format, size, true));
      formats.points.push_back(tables.point(DfgAxes::warped, "cubic", format, size));
    }

  family.about =
      "The integral of the GGX lobe with height-correlated Smith masking, as the weights A of F0 and B of F90. Errors "
      "are the larger of A's and B's; the largest over a uniform and a logarithmic grid, the mean over the uniform "
      "one. Costs include the gathers, at scattered places of a table that is in the cache as far as it fits.";
  const auto find = [](const Plot& plot, const std::string& id) -> const Point* {
    for (const Point& p : plot.points)
      if (p.id == id) return &p;
    return nullptr;
  };
  const std::string isa = session.kernels.back()->isa;
  const Point *linear = find(sizes, "dfg-linear-bilinear-float-128"), *warped = &fits.points[6],
              *cubic = &fits.points[7];
  const Point *ours = &fits.points[4], *material = &fits.points[2];
  Plot all = formats;
  all.points.insert(all.points.end(), fits.points.begin(), fits.points.end());
  const Point& least = smallest(all, 1e-4);
  family.findings = {
      fmt::format("The axes decide, not the size: with linear axes a 128 x 128 table errs by up to {}, with axes along "
                  "which the function changes evenly by {}.",
                  number(linear->method.max), number(warped->method.max)),
      fmt::format("1e-4 everywhere takes {:.0f} KB: {} ({}).", least.extra.at("bytes") / 1024, least.title,
                  number(least.method.max)),
      fmt::format("Sixteen bits are enough, if they are spent evenly: unorm16 reaches {} where half, which has its "
                  "digits near 0, reaches {}; two of them travel in one gather.",
                  number(warped->method.max),
                  number(find(formats, "dfg-warped-bilinear-half-128-balanced")->method.max)),
      fmt::format("A fit that reads no memory: {} at worst and {} on average in {:.2f} ns on {}; the bilinear table "
                  "takes {:.2f} ns, the cubic one {:.2f} ns. MaterialX's fit errs by {} in {:.2f} ns.",
                  number(ours->method.max), number(ours->method.mean), ours->cost.at(isa).ns, isa,
                  warped->cost.at(isa).ns, cubic->cost.at(isa).ns, number(material->method.max),
                  material->cost.at(isa).ns),
  };
  family.plots = {fits, sizes, formats};
  return family;
}

}  // namespace tessera::chart

// Elementary functions by degree, machines' own estimates beside them, and what the same bits everywhere cost.
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "bench/chart/measure.hpp"

namespace tessera::chart {
namespace {

using Values = std::vector<std::vector<float>>;

struct Group {
  const char *id, *title;
  std::vector<std::string> terms;  // the default first
  Values inputs;
  double (*exact)(double, double);
  double floor;  // 0: relative errors
  std::string domain;
};

std::vector<float> to_floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

double exact_exp2(double x, double) { return std::exp2(x); }
double exact_log2(double x, double) { return std::log2(x); }
double exact_pow(double x, double y) { return std::pow(x, y); }
double exact_rsqrt(double x, double) { return 1 / std::sqrt(x); }
double exact_reciprocal(double x, double) { return 1 / x; }
double exact_acos(double x, double) { return std::acos(x); }

std::vector<Group> groups(int count) {
  Values powers(2);
  const int side = int(std::sqrt(double(count)));
  for (const double y : spread(0.01, 4, side))
    for (const double x : spread_logarithmic(0.01, 4, side))
      powers[0].push_back(float(x)), powers[1].push_back(float(y));
  const std::vector<float> wide = to_floats(spread_logarithmic(1e-4, 1e4, count));
  return {
      {"function-exp2",
       "exp2",
       {"exp2", "exp2_poly2", "exp2_poly3", "exp2_poly4", "exp2_poly5"},
       {to_floats(spread(-126, 127, count))},
       exact_exp2,
       0,
       "x in [-126,127]"},
      {"function-log2",
       "log2",
       {"log2", "log2_poly3", "log2_poly5", "log2_poly7"},
       {to_floats(spread_logarithmic(1e-6, 16, count))},
       exact_log2,
       1,
       "x in [1e-6,16]"},
      {"function-pow",
       "pow",
       {"pow", "pow_exp2_log2", "pow_poly5_7", "pow_poly3_5"},
       powers,
       exact_pow,
       0,
       "x and y in [0.01,4]"},
      {"function-rsqrt",
       "1 / sqrt(x)",
       {"rsqrt_exact", "rsqrt_newton1", "rsqrt_newton2", "rsqrt_newton3", "estimate_rsqrt", "estimate_rsqrt_newton"},
       {wide},
       exact_rsqrt,
       0,
       "x in [1e-4,1e4]"},
      {"function-reciprocal",
       "1 / x",
       {"reciprocal_exact", "reciprocal_newton2", "reciprocal_newton3", "estimate_reciprocal",
        "estimate_reciprocal_newton"},
       {wide},
       exact_reciprocal,
       0,
       "x in [1e-4,1e4]"},
      {"function-acos",
       "acos",
       {"acos", "acos_poly1", "acos_poly3", "acos_poly5"},
       {to_floats(spread(-1, 1, count))},
       exact_acos,
       1,
       "x in [-1,1]"},
  };
}

Error error_of(const std::vector<double>& found, const std::vector<double>& truth, double floor) {
  return floor > 0 ? absolute_error(found, truth) : relative_error(found, truth, 1e-300);
}

// For timing: a part of the inputs that lies in the first-level cache.
Values scattered(const Values& inputs) {
  Values some;
  for (const auto& plane : inputs) {
    some.emplace_back();
    for (std::size_t k = 0; k < 512; ++k) some.back().push_back(plane[k * 7919 % plane.size()]);
  }
  return some;
}

Plot measure(Session& session, const Group& group) {
  Plot plot;
  plot.id = group.id;
  plot.title = group.title;
  plot.error_name = group.floor > 0 ? "largest error, formula and float together"
                                    : "largest relative error, formula and float together";
  plot.domain = group.domain;
  plot.truth = "libm in double";
  std::vector<double> truth;
  for (std::size_t i = 0; i < group.inputs[0].size(); ++i)
    truth.push_back(group.exact(double(group.inputs[0][i]), group.inputs.size() > 1 ? double(group.inputs[1][i]) : 0));
  for (const std::string& term : group.terms) {
    session.progress("function: " + term);
    Point point = describe(term);
    const auto in_floats = in_float(session, term, group.inputs);
    point.method = error_of(in_floats, truth, group.floor);
    point.arithmetic = error_of(in_floats, in_double(term, group.inputs), group.floor);
    point.cost = time_term(session, term, scattered(group.inputs));
    plot.points.push_back(std::move(point));
  }
  return plot;
}

Values lights(std::size_t count) {
  Values in(8);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0.02, 1), turn(0, 6.283185307179586);
  for (std::size_t k = 0; k < count; ++k) {
    const double NoV = unit(random), NoL = unit(random), phi = turn(random), r = unit(random);
    const double sv = std::sqrt(1 - NoV * NoV), sl = std::sqrt(1 - NoL * NoL);
    const double x = sl * std::cos(phi) + sv, y = sl * std::sin(phi), z = NoL + NoV, H2 = x * x + y * y + z * z;
    const double values[8] = {H2, z, x * x + y * y, NoV, NoL, r * r, unit(random), std::fmin(std::sqrt(H2) / 2, 1)};
    for (std::size_t i = 0; i < 8; ++i) in[i].push_back(float(values[i]));
  }
  return in;
}

Plot measure_price(Session& session) {
  Plot plot;
  plot.id = "function-determinism";
  plot.title = "The price of the same bits everywhere";
  plot.error_name = "largest relative error of float";
  plot.domain = "GGX lobe and Schlick's Fresnel term; NoV, NoL and roughness in [0.02,1]";
  plot.truth = "the same formula in double";
  const Values all = lights(session.quick ? 4096 : 32768), some = lights(512);
  const auto truth = in_double("specular_light", all);
  for (const char* term : {"specular_light", "estimate_light_contracted", "estimate_light"}) {
    session.progress(std::string("function: ") + term);
    Point point = describe(term);
    point.method = point.arithmetic = relative_error(in_float(session, term, all), truth, 1e-300);
    point.cost = time_term(session, term, some);
    plot.points.push_back(std::move(point));
  }
  for (Point& point : plot.points)
    for (const auto& [isa, cost] : plot.points[0].cost)
      point.extra["default's cost / this " + isa] = cost.ns / point.cost.at(isa).ns;
  return plot;
}

}  // namespace

Family measure_function(Session& session) {
  Family family;
  family.id = "function";
  family.title = "Function approximations";
  family.about =
      "Elementary functions by degree beside those that the kernels use, with the error of the float function: formula "
      "and rounding together. Estimates of the machine are on this chart and nowhere else. The last plot is a whole "
      "light on a surface, GGX lobe and Fresnel term: as the kernels compute it; with the compiler free to contract; "
      "and with division and roots by estimate and one Newton step.";
  for (const Group& group : groups(session.quick ? 20000 : 200000)) family.plots.push_back(measure(session, group));
  family.plots.push_back(measure_price(session));

  const Plot& price = family.plots.back();
  std::string contracted, estimated;
  for (const auto& [isa, cost] : price.points[0].cost) {
    const auto text = [&, &isa = isa, &cost = cost](const Point& p) {
      return fmt::format("{:+.0f} % on {}", 100 * (cost.ns / p.cost.at(isa).ns - 1), isa);
    };
    contracted += (contracted.empty() ? "" : ", ") + text(price.points[1]);
    estimated += (estimated.empty() ? "" : ", ") + text(price.points[2]);
  }
  const std::string isa = session.kernels.back()->isa;
  const auto ns = [&](int plot, int point) {
    return family.plots[std::size_t(plot)].points[std::size_t(point)].cost.at(isa).ns;
  };
  family.findings = {
      "The same bits on every machine, in time against a build that may contract: " + contracted +
          ". On SSE4.2, which has no fused multiply-add, the contract emulates one.",
      "In time against contraction and the machine's estimates together: " + estimated +
          fmt::format("; the error: {} by default, {} with them.", number(price.points[0].method.max),
                      number(price.points[2].method.max)),
      fmt::format("On {}, exp2 to the last place takes {:.2f} ns and a cubic {:.2f} ns; acos {:.2f} against {:.2f} ns; "
                  "pow, whose logarithm is carried in two floats, {:.2f} ns against {:.2f} ns for exp2(y log2 x).",
                  isa, ns(0, 0), ns(0, 2), ns(5, 0), ns(5, 2), ns(2, 0), ns(2, 1)),
      fmt::format("An exact 1/sqrt(x) takes {:.2f} ns on {}; the bit trick with two steps {:.2f} ns, the estimate with "
                  "one {:.2f} ns.",
                  ns(3, 0), isa, ns(3, 2), ns(3, 5)),
  };
  return family;
}

}  // namespace tessera::chart

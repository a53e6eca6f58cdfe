#include "bench/chart/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "bench/chart/instructions.hpp"
#include "catalogue/run_term.hpp"

namespace tessera::chart {
namespace {

template <class Number>
std::vector<double> run(const TermSpan<Number>* const* terms, const std::string& name,
                        const std::vector<std::vector<float>>& inputs, const float* table, int table_size, int output) {
  std::vector<std::vector<Number>> in;
  for (const auto& plane : inputs) in.emplace_back(plane.begin(), plane.end());
  const auto out = catalogue::run_term(catalogue::require_term(terms, name), in, table, table_size);
  const auto& chosen = out.at(std::size_t(output));
  return {chosen.begin(), chosen.end()};
}

}  // namespace

std::vector<double> in_double(const std::string& term, const std::vector<std::vector<float>>& inputs,
                              const float* table, int table_size, int output) {
  return run(precise_terms, term, inputs, table, table_size, output);
}

std::vector<double> in_float(const Session& session, const std::string& term,
                             const std::vector<std::vector<float>>& inputs, const float* table, int table_size,
                             int output) {
  return run(session.kernels.back()->terms, term, inputs, table, table_size, output);
}

Error relative_error(const std::vector<double>& found, const std::vector<double>& truth, double floor) {
  Error error;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double e = std::abs(found[i] - truth[i]) / std::max(std::abs(truth[i]), floor);
    error.max = std::max(error.max, e);
    sum += e;
    squares += e * e;
  }
  error.mean = sum / double(truth.size());
  error.rms = std::sqrt(squares / double(truth.size()));
  return error;
}

Error absolute_error(const std::vector<double>& found, const std::vector<double>& truth) {
  std::vector<double> difference(truth.size()), one(truth.size(), 0);
  for (std::size_t i = 0; i < truth.size(); ++i) difference[i] = found[i] - truth[i];
  return relative_error(difference, one, 1);
}

Point describe(const std::string& term) {
  const catalogue::Method& method = catalogue::method_of(term);
  Point point;
  for (const char c : term)
    point.id += std::isalnum(static_cast<unsigned char>(c)) ? char(std::tolower(static_cast<unsigned char>(c))) : '-';
  point.title = method.title;
  point.formula = method.formula;
  point.paper = method.paper;
  point.file = method.file;
  point.fails = method.fails;
  return point;
}

Point describe(const catalogue::Lookup& lookup, const std::string& suffix) {
  Point point;
  point.id = lookup.id + "-" + suffix;
  point.title = lookup.title;
  point.formula = lookup.formula;
  point.paper = lookup.paper;
  point.file = lookup.file;
  point.fails = lookup.fails;
  return point;
}

bool runs_on(const Session& session, const std::string& isa) {
  return std::any_of(session.kernels.begin(), session.kernels.end(),
                     [&](const Kernels* kernels) { return isa == kernels->isa; });
}

void add_cost(Session& session, Point& point, const std::string& term, std::vector<std::vector<float>> inputs,
              const float* table, int table_size) {
  constexpr std::size_t enough = 512;  // fewer, and the call would be timed, not the loop
  for (auto& plane : inputs)
    for (std::size_t i = 0; plane.size() < enough; ++i) plane.push_back(plane[i]);
  point.cost = time_term(session, term, inputs, table, table_size);
  for (const LoopCount& loop : loop_counts())
    if (loop.function == term && runs_on(session, loop.isa))
      point.extra["instructions " + loop.isa] = loop.instructions;
}

std::vector<double> spread(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
  return values;
}

std::vector<double> spread_logarithmic(double low, double high, int count) {
  std::vector<double> values = spread(std::log(low), std::log(high), count);
  for (double& v : values) v = std::exp(v);
  return values;
}

ErrorMap map_over(std::string title, std::string column_name, std::vector<double> columns, std::string row_name,
                  std::vector<double> rows, const std::function<double(double column, double row)>& value) {
  ErrorMap map{std::move(title), std::move(column_name), std::move(row_name), std::move(columns), std::move(rows), {}};
  for (const double row : map.rows)
    for (const double column : map.columns) map.values.push_back(value(column, row));
  return map;
}

std::string number(double value) { return fmt::format("{:.3g}", value); }

}  // namespace tessera::chart

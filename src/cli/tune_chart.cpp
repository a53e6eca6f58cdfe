#include "cli/tune_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera::cli {
namespace {

constexpr int columns = 72, rows = 18;  // of the plot; the lowest row is for what is exact
constexpr double exact_below = 1e-3;

// Where a value stands between the ends of a logarithmic axis, 0 .. last.
int place(double value, double low, double high, int last) {
  if (!(high > low)) return last / 2;
  const double t = std::log(value / low) / std::log(high / low);
  return static_cast<int>(std::lround(std::clamp(t, 0.0, 1.0) * last));
}

}  // namespace

std::string draw_chart(const std::vector<ChartPoint>& points, double limit) {
  double cheapest = points.at(0).cost, dearest = cheapest, worst = limit, least = limit > 0 ? limit : 1;
  for (const ChartPoint& p : points) {
    cheapest = std::min(cheapest, p.cost);
    dearest = std::max(dearest, p.cost);
    worst = std::max(worst, p.error);
    if (p.error > 0) least = std::min(least, p.error);
  }
  least = std::max(least, exact_below);
  worst = std::max(worst, least);
  const auto row_of = [&](double error) {
    return error < least ? rows - 1 : rows - 2 - place(error, least, worst, rows - 2);
  };
  std::vector<std::string> plot(rows, std::string(columns, ' '));
  const int limit_row = row_of(limit);
  plot[static_cast<std::size_t>(limit_row)].assign(columns, '-');
  for (const ChartPoint& p : points) {
    const auto column = static_cast<std::size_t>(place(p.cost, cheapest, dearest, columns - 1));
    char& mark = plot[static_cast<std::size_t>(row_of(p.error))][column];
    if (mark == ' ' || mark == '-' || mark == '.') mark = p.mark;
  }
  std::string text = "  mean error, display steps\n";
  for (int row = 0; row < rows; ++row) {
    std::string label;
    if (row == limit_row)
      label = fmt::format("{:.4g}", limit);
    else if (row == 0)
      label = fmt::format("{:.3g}", worst);
    else if (row == rows - 1)
      label = "exact";
    else if (row == rows - 2)
      label = fmt::format("{:.3g}", least);
    text += fmt::format("{:>8} |{}\n", label, plot[static_cast<std::size_t>(row)]);
  }
  const std::string low = fmt::format("{:.4g}", cheapest), high = fmt::format("{:.4g} ms a frame", dearest);
  text += fmt::format("{:>8} +{:-<{}}\n", "", "", columns);
  text += fmt::format("{:>9} {}{:>{}}\n", "", low, high, columns - static_cast<int>(low.size()));
  return text;
}

}  // namespace tessera::cli

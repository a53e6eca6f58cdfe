#include "bench/scaling/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/scaling/fit.hpp"
#include "bench/scaling/series_plot.hpp"

namespace tessera::scaling {
namespace {

// Times are compared with those of this case: of pixels 1080p, of triangles a million, of lights the most, since light
// by light is what grows.
double reference_x(const Part& part) { return part.id == "pixels" ? 1.92 * 1.08 : part.id == "triangles" ? 1000 : 64; }

const Case& reference_of(const Part& part, const Series& series) {
  const double x = reference_x(part);
  return *std::min_element(series.cases.begin(), series.cases.end(),
                           [&](const Case& a, const Case& b) { return std::abs(a.x - x) < std::abs(b.x - x); });
}

// From a million triangles on, they are what grows; below it, pixels find ever fewer neighbours on their own triangle.
double fitted_from(const Part& part) { return part.id == "triangles" ? 1000 : 0; }

}  // namespace

std::string table_of(const Part& part) {
  std::string text = fmt::format("{}: {}\n", part.title, part.measured);
  for (const Series& series : part.series) {
    text += fmt::format("  {}\n", series.name);
    if (part.id == "threads") {
      const double alone = series.cases.front().time.median;
      for (const Case& c : series.cases)
        text += fmt::format("    {:>8g} {:<30} {:9.2f} ms ({:.2f} to {:.2f}){:>12.2f} times as fast as 1\n", c.x,
                            part.x_name, c.time.median, c.time.least, c.time.most, alone / c.time.median);
      continue;
    }
    const LinearFit fit = fit_line(series, fitted_from(part));
    const Case& reference = reference_of(part, series);
    for (const Case& c : series.cases) {
      text += fmt::format("    {:>8.4g} {:<30} {:9.2f} ms ({:.2f} to {:.2f}){:>9.3f} of the line", c.x, part.x_name,
                          c.time.median, c.time.least, c.time.most, c.time.median / (fit.fixed + fit.each * c.x));
      if (part.id == "pixels")
        text += fmt::format("{:>9.3f} of proportional", c.time.median / c.x * reference.x / reference.time.median);
      text += "\n";
    }
    text += fmt::format("    the line: {:.3f} ms + {:.5f} ms for each\n", fit.fixed, fit.each);
  }
  return text;
}

std::string json_of(const Part& part, const std::string& isa, int threads) {
  nlohmann::ordered_json j = {{"part", part.id},  {"title", part.title}, {"measured", part.measured},
                              {"x", part.x_name}, {"isa", isa},          {"threads", threads}};
  for (const Series& series : part.series) {
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (const Case& c : series.cases)
      points.push_back({{"x", c.x},
                        {"threads", c.threads},
                        {"ms", c.time.median},
                        {"least_ms", c.time.least},
                        {"most_ms", c.time.most}});
    j["series"].push_back({{"name", series.name}, {"points", points}});
  }
  return j.dump(2) + "\n";
}

std::string chart_of(const Part& part, const std::string& isa, int threads) {
  if (part.id == "threads") return {};
  SeriesPlot plot;
  plot.linear = part.id != "pixels";
  plot.x_name = part.x_name;
  plot.y_name = fmt::format("ms a frame, {} threads, {}", threads, isa);
  for (const Series& series : part.series) {
    PlottedSeries drawn{series.name, {}, {}};
    const LinearFit fit = fit_line(series, fitted_from(part));
    const Case& reference = reference_of(part, series);
    for (const Case& c : series.cases) {
      drawn.points.push_back({c.x, c.time.median, c.time.least, c.time.most, c.name});
      const double proportional = reference.time.median * c.x / reference.x;
      drawn.guide.push_back({c.x, part.id == "pixels" ? proportional : fit.fixed + fit.each * c.x});
    }
    plot.series.push_back(std::move(drawn));
  }
  plot.guide_name = part.id == "pixels"      ? "proportional to pixels"
                    : part.id == "triangles" ? "a straight line through those from a million on"
                                             : "a straight line through them";
  return draw(plot,
              {part.title, part.measured, {"median of all rounds, least and most of a round; all sizes took turns"}});
}

}  // namespace tessera::scaling

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/chart/compare.hpp"
#include "bench/chart/page.hpp"
#include "bench/chart/plot.hpp"
#include "chart/markup.hpp"

namespace tessera::chart {
namespace {

using Json = nlohmann::ordered_json;

std::string words(const Error& error) {
  return fmt::format("largest {}, mean {}, rms {}", amount(error.max), amount(error.mean), amount(error.rms));
}

std::string words(const Cost& cost, double ghz) {
  std::string text = fmt::format("{} ns ({} to {}, {} repetitions)", amount(cost.ns), amount(cost.low),
                                 amount(cost.high), cost.repetitions);
  if (ghz > 0) text += fmt::format(", {} cycles", amount(cost.ns * ghz));
  return text;
}

}  // namespace

std::string page_data(const Results& results, const Results* other) {
  Json data = Json::object();
  for (const Family& family : results.families)
    for (const Plot& plot : family.plots) {
      Json& points = data[family.id + "/" + plot.id] = Json::object();
      const Plot* theirs = other == nullptr ? nullptr : matching_plot(*other, family.id, plot.id);
      for (const Point& point : plot.points)
        points[point.id] = {{"title", point.title},          {"formula", point.formula},
                            {"paper", point.paper},          {"file", point.file},
                            {"fails", point.fails},          {"note", point.note},
                            {"method", words(point.method)}, {"arithmetic", words(point.arithmetic)},
                            {"cost", Json::object()},        {"frontier", Json::array()},
                            {"ratio", Json::object()},       {"extra", Json::object()}};
      for (const Point& point : plot.points)
        for (const auto& [name, value] : point.extra) points[point.id]["extra"][name] = amount(value);
      for (const std::string& isa : results.machine.isas) {
        const std::vector<bool> frontier = on_frontier(plot, isa);
        for (std::size_t i = 0; i < plot.points.size(); ++i) {
          const Point& point = plot.points[i];
          const auto cost = point.cost.find(isa);
          if (cost == point.cost.end()) continue;
          points[point.id]["cost"][isa] = words(cost->second, results.machine.clock_ghz);
          if (frontier[i]) points[point.id]["frontier"].push_back(isa);
          const double ratio = cost_ratio(point, matching_point(theirs, point.id), isa);
          if (ratio > 0) points[point.id]["ratio"][isa] = amount(ratio);
        }
      }
    }
  // "</script>" in a title must not end the script.
  std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace), out;
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace tessera::chart

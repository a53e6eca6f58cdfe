#include "cli/tune_report.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "chart/frontier_plot.hpp"
#include "chart/markup.hpp"
#include "cli/text.hpp"
#include "cli/tune_chart.hpp"
#include "frame/settings_file.hpp"

namespace tessera::cli {
namespace {

using Json = nlohmann::ordered_json;

// Differs from the exact settings in at most one knob.
bool is_single(const KnobPoint& point) {
  return std::count_if(point.choice.begin(), point.choice.end(), [](int k) { return k != 0; }) <= 1;
}

std::vector<std::size_t> cheapest_first(const std::vector<KnobPoint>& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost
                                            : points[a].error.mean < points[b].error.mean;
  });
  return order;
}

// A letter for each point of the frontier, the choice included; '.' for the rest.
std::vector<char> marks_of(const TuneReport& r, const std::vector<std::size_t>& order) {
  std::vector<char> marks(r.points.size(), '.');
  std::vector<bool> marked(r.points.size(), false);
  for (const std::size_t i : clear_frontier(r.points)) marked[i] = true;
  marked[r.chosen] = true;
  char next = 'A';
  for (const std::size_t i : order) {
    if (!marked[i]) continue;
    marks[i] = next;
    next = next == 'Z' ? 'a' : static_cast<char>(next + 1);
  }
  return marks;
}

}  // namespace

std::string result_of(const KnobPoint& point) {
  return fmt::format("mean error {:.3g} display steps (99 % of pixels within {}), {:.2f} ms a frame", point.error.mean,
                     point.error.percentile99, point.cost);
}

std::string table_of(const TuneReport& r) {
  const std::vector<std::size_t> order = cheapest_first(r.points);
  const std::vector<char> marks = marks_of(r, order);
  const KnobChoice standard = r.knobs.defaults();
  std::string text = fmt::format(
      "{}: {} x {}, {} pixels of the scene, {} on {} thread{}, fastest of {} frame{}\n\n"
      "      ms a frame  mean error  99 % within  settings\n",
      printable(r.scene), r.width, r.height, grouped(r.pixels), r.isa, r.threads, r.threads == 1 ? "" : "s", r.frames,
      r.frames == 1 ? "" : "s");
  std::size_t left_out = 0;
  std::vector<ChartPoint> chart;
  for (const std::size_t i : order) {
    const KnobPoint& p = r.points[i];
    chart.push_back({p.cost, p.error.mean, marks[i]});
    const bool exact = i == 0, is_default = p.choice == standard;
    if (marks[i] == '.' && !exact && !is_default && !is_single(p)) {
      ++left_out;
      continue;
    }
    text += fmt::format("  {} {:>12.2f}{:>12.3f}{:>13}  {}{}{}{}\n", marks[i], p.cost, p.error.mean,
                        p.error.percentile99, r.knobs.describe(p.choice), exact ? " (exact)" : "",
                        is_default ? " (the default)" : "", i == r.chosen ? "  <- chosen" : "");
  }
  text += "Letters: on the frontier; all that are nearer cost at least 2 % more. Dots: beaten";
  text += left_out == 0 ? ".\n" : fmt::format(", with {} more that the table leaves out.\n", left_out);
  return text + "\n" + draw_chart(chart, r.limit.mean);
}

std::string chart_of(const TuneReport& r) {
  const std::vector<char> marks = marks_of(r, cheapest_first(r.points));
  const KnobChoice standard = r.knobs.defaults();
  chart::FrontierPlot plot;
  plot.cost_name = fmt::format("cost: ms a frame, {} thread{}, {}", r.threads, r.threads == 1 ? "" : "s", r.isa);
  plot.error_name = "mean error: display steps (1/255) against the exact settings";
  plot.limit = r.limit.mean;
  plot.limit_name = fmt::format("E = {:.4g}", r.limit.mean);
  for (std::size_t i = 0; i < r.points.size(); ++i) {
    const KnobPoint& p = r.points[i];
    const bool exact = i == 0, is_default = p.choice == standard;
    plot.points.push_back({p.cost, p.error.mean,
                           exact        ? "exact"
                           : is_default ? "default: " + r.knobs.describe(p.choice)
                                        : r.knobs.describe(p.choice),
                           exact        ? "exact"
                           : is_default ? "default"
                                        : std::string(1, marks[i]),
                           marks[i] != '.', i == r.chosen, exact || is_default});
  }
  const KnobPoint& chosen = r.points[r.chosen];
  return draw(plot, {fmt::format("Cheapest settings of {}", std::filesystem::path(r.scene).filename().string()),
                     fmt::format("{} × {}, {} settings measured; exact: {}", r.width, r.height, r.points.size(),
                                 chart::shortened(r.knobs.describe(KnobChoice(r.knobs.list.size(), 0)), 100)),
                     {fmt::format("chosen: {}; {}", r.knobs.describe(chosen.choice), result_of(chosen)),
                      fmt::format("fastest of {} frames, all in turns; errors over {} pixels that show the scene",
                                  r.frames, grouped(r.pixels))}});
}

std::string results_of(const TuneReport& r) {
  Json j;
  j["tessera"] = TESSERA_VERSION;
  j["command"] = "tune";
  j["scene"] = r.scene;
  j["width"] = r.width;
  j["height"] = r.height;
  j["pixels"] = r.pixels;
  j["isa"] = r.isa;
  j["threads"] = r.threads;
  j["frames"] = r.frames;
  j["error_unit"] = "display steps (1/255)";
  j["max_error"] = r.limit.mean;
  if (std::isfinite(r.limit.percentile99)) j["max_p99"] = r.limit.percentile99;
  j["points"] = Json::array();
  for (std::size_t i = 0; i < r.points.size(); ++i) {
    const KnobPoint& p = r.points[i];
    Json point = settings_json(r.settings_of(p.choice));
    point.update(Json{{"mean_error", p.error.mean},
                      {"p99_error", p.error.percentile99},
                      {"ms", p.cost},
                      {"frontier", p.frontier},
                      {"exact", i == 0},
                      {"chosen", i == r.chosen}});
    j["points"].push_back(std::move(point));
  }
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tessera::cli

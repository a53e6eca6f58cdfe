#include "bench/scaling/series_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chart/axis.hpp"
#include "chart/markup.hpp"

namespace tessera::scaling {
namespace {

using chart::coordinate;

constexpr double width = 960, left = 84, right = width - 16, top = 10, bottom = 410, font = 13, radius = 5.5;
constexpr double height = bottom + 72;
constexpr const char* colors[] = {"#1b63d6", "#c2560a", "#14804a", "#8a3fb8"};

// Logarithmic, or linear from 0.
struct Axis {
  bool linear = false;
  chart::LogAxis log;
  double high = 1, from = 0, to = 1;

  [[nodiscard]] double at(double value) const { return linear ? from + value / high * (to - from) : log.at(value); }
  // On an axis of few decades, more of their parts have labels.
  [[nodiscard]] std::vector<chart::Tick> log_ticks() const {
    std::vector<chart::Tick> all = log.ticks();
    const double decades = log.high - log.low;
    for (chart::Tick& tick : all) {
      const int digit =
          static_cast<int>(std::lround(tick.value / std::pow(10, std::floor(std::log10(tick.value) + 1e-9))));
      if (decades < 0.8 || (decades < 2.5 && (digit == 2 || digit == 5)))
        tick = {tick.value, true, chart::tick_label(tick.value)};
    }
    return all;
  }
  [[nodiscard]] std::vector<chart::Tick> ticks() const {
    if (!linear) return log_ticks();
    // Steps of 1, 2 or 5 times a power of ten: at most eight.
    double step = std::pow(10.0, std::floor(std::log10(high / 8)));
    for (const double factor : {2.0, 2.5, 2.0})
      if (high / step > 8) step *= factor;
    std::vector<chart::Tick> all;
    for (int k = 0; k * step <= high; ++k) all.push_back({k * step, true, fmt::format("{:g}", k * step)});
    return all;
  }
};

Axis axis_of(std::vector<double> values, bool linear, double from, double to) {
  const double high = *std::max_element(values.begin(), values.end()) * 1.06;
  return {linear, chart::axis_over(values, 0.5, 0.05, from, to), high, from, to};
}

std::string colored(const char* cls, const std::string& d, const char* color) {
  return fmt::format(R"(<path class="{}" style="stroke:{}" d="{}"/>)", cls, color, d);
}

std::string draw_axes(const SeriesPlot& plot, const Axis& x, const Axis& y) {
  std::string out = chart::rectangle("panel", {left, top, right, bottom});
  for (const chart::Tick& tick : y.ticks()) {
    const double at = y.at(tick.value);
    out += chart::line(tick.major ? "grid" : "grid minor", left, at, right, at);
    if (tick.major) out += chart::text("tick", left - 6, at + font * 0.35, "end", tick.label);
  }
  for (const chart::Tick& tick : x.ticks()) {
    const double at = x.at(tick.value);
    out += chart::line(tick.major ? "grid" : "grid minor", at, top, at, bottom);
    if (tick.major) out += chart::text("tick", at, bottom + font * 1.4, "middle", tick.label);
  }
  out += chart::text("axis", (left + right) / 2, bottom + font * 2.8, "middle", plot.x_name);
  return out + chart::upright_text("axis", font * 1.3, (top + bottom) / 2, plot.y_name);
}

std::string draw_series(const PlottedSeries& series, const Axis& x, const Axis& y, const char* color) {
  std::string d, out;
  for (const chart::Place& p : series.guide)
    d += fmt::format("{}{} {}", d.empty() ? "M" : "L", coordinate(x.at(p.x)),
                     coordinate(std::clamp(y.at(p.y), top, bottom)));
  out += fmt::format(R"(<path class="proportional" d="{}"/>)", d);
  d.clear();
  for (const PlottedPoint& p : series.points)
    d += fmt::format("{}{} {}", d.empty() ? "M" : "L", coordinate(x.at(p.x)), coordinate(y.at(p.y)));
  out += colored("series", d, color);
  for (const PlottedPoint& p : series.points) {
    const double px = x.at(p.x), low = y.at(p.low), high = y.at(p.high);
    out += colored("series",
                   fmt::format("M{0} {1}V{2}M{3} {1}h8M{3} {2}h8", coordinate(px), coordinate(low), coordinate(high),
                               coordinate(px - 4)),
                   color);
    out += fmt::format(
        R"(<circle class="series-dot" style="fill:{}" cx="{}" cy="{}" r="{}"><title>{}: {}</title></circle>)", color,
        coordinate(px), coordinate(y.at(p.y)), coordinate(radius), chart::amount(p.x), chart::amount(p.y));
  }
  return out;
}

// Above each point what it took, where there is room for all series.
std::string draw_values(const SeriesPlot& plot, const Axis& x, const Axis& y) {
  chart::LabelScene scene{{left + 3, top + 3, right - 3, bottom - 2}, {}, {}};
  std::vector<chart::LabelRequest> requests;
  std::vector<std::string> words;
  // The upper ones choose first: between them and the frame is the least room.
  std::vector<const PlottedSeries*> from_above;
  for (const PlottedSeries& series : plot.series)
    if (!series.points.empty()) from_above.push_back(&series);
  std::stable_sort(from_above.begin(), from_above.end(), [](const PlottedSeries* a, const PlottedSeries* b) {
    return a->points.back().y > b->points.back().y;
  });
  for (const PlottedSeries* each : from_above) {
    const PlottedSeries& series = *each;
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const PlottedPoint& p = series.points[i];
      words.push_back(p.name + (p.name.empty() ? "" : ": ") + fmt::format("{:.3g} ms", p.y));
      requests.push_back(
          {x.at(p.x), y.at(p.y), radius + 1, {{0, 0, chart::text_width(words.back(), font), font * 1.15}}});
      if (i > 0)
        scene.soft_lines.push_back({x.at(series.points[i - 1].x), y.at(series.points[i - 1].y), x.at(p.x), y.at(p.y)});
    }
  }
  std::string out;
  const std::vector<chart::Label> labels = chart::place_labels(scene, requests);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!labels[i].placed) continue;
    if (labels[i].leader) out += fmt::format(R"(<path class="leader" d="{}"/>)", chart::path_of({labels[i].line}));
    out += chart::text("label dominated", (labels[i].box.x0 + labels[i].box.x1) / 2, labels[i].box.y1 - font * 0.3,
                       "middle", words[i]);
  }
  return out;
}

std::string draw_legend(const SeriesPlot& plot) {
  std::string out = R"(<g class="legend">)";
  double at = left;
  const auto add = [&](const std::string& mark, const std::string& words) {
    out += fmt::format(R"~(<g transform="translate({} {})">{}<text x="24">{}</text></g>)~", coordinate(at),
                       coordinate(height - 10), mark, chart::escaped(words));
    at += 26 + chart::text_width(words, font) + 14;
  };
  for (std::size_t k = 0; k < plot.series.size(); ++k)
    add(fmt::format(R"(<circle class="series-dot" style="fill:{}" cx="8" cy="-4" r="5.5"/>)",
                    colors[k % std::size(colors)]),
        plot.series[k].name);
  add(R"(<path class="proportional" d="M0 -4H18"/>)", plot.guide_name);
  return out + "</g>";
}

}  // namespace

std::string draw(const SeriesPlot& plot, const chart::Lettering& around) {
  std::vector<double> xs, ys;
  for (const PlottedSeries& series : plot.series)
    for (const PlottedPoint& p : series.points) {
      xs.push_back(p.x);
      ys.insert(ys.end(), {p.low, p.high});
    }
  const Axis x = axis_of(xs, plot.linear, left, right), y = axis_of(ys, plot.linear, bottom, top);
  std::string out = draw_axes(plot, x, y);
  for (std::size_t k = 0; k < plot.series.size(); ++k)
    out += draw_series(plot.series[k], x, y, colors[k % std::size(colors)]);
  out += draw_values(plot, x, y) + draw_legend(plot);
  return chart::standalone(out, width, height, around);
}

}  // namespace tessera::scaling

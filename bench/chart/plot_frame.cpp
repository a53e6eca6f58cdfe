#include "bench/chart/plot_frame.hpp"

#include <fmt/format.h>

#include <cmath>

#include "chart/markup.hpp"
#include "chart/svg.hpp"

namespace tessera::chart {
namespace {

constexpr double edge_band = 30;  // pixels of the panel that the floor takes, or the ceiling

Panel panel_over(const std::vector<double>& errors, double least, double top, double bottom) {
  Panel panel;
  panel.top = top;
  panel.bottom = bottom;
  std::vector<double> on_axis;
  for (const double error : errors) {
    if (error <= exact_below)
      panel.floor = true;
    else
      on_axis.push_back(error);
  }
  const LogAxis whole = axis_over(on_axis, 0, 0, 0, 1);
  if (whole.high - whole.low > long_axis) {
    const std::size_t all = on_axis.size();
    std::erase_if(on_axis, [](double error) { return error > worthless_above; });
    panel.ceiling = on_axis.size() < all;
  }
  if (on_axis.empty()) on_axis = {1e-9, 1e-3};
  panel.floor_y = bottom - edge_band / 2;
  panel.ceiling_y = top + edge_band / 2;
  panel.axis =
      axis_over(on_axis, least, 0.08, panel.floor ? bottom - edge_band : bottom, panel.ceiling ? top + edge_band : top);
  return panel;
}

std::string draw_errors(const Panel& panel, const PlotFrame& f, int most, const std::string& title, bool narrow) {
  std::string out =
      fmt::format(R"(<rect class="panel" x="{}" y="{}" width="{}" height="{}"/>)", coordinate(f.left),
                  coordinate(panel.top), coordinate(f.right - f.left), coordinate(panel.bottom - panel.top));
  for (const Tick& tick : panel.axis.ticks(most)) {
    const double y = panel.axis.at(tick.value);
    out += line(tick.major ? "grid" : "grid minor", f.left, y, f.right, y);
    if (tick.major) out += text("tick", f.left - 6, y + f.font * 0.35, "end", tick.label);
  }
  if (panel.floor) {
    out += line("floor", f.left, panel.bottom - edge_band, f.right, panel.bottom - edge_band);
    out += text("tick", f.left - 6, panel.floor_y + f.font * 0.35, "end", "exact");
    if (!narrow)  // above the frontier, which runs through the middle
      out += text("tick note", f.right - 6, panel.bottom - edge_band + f.font * 0.8, "end", "error 0, or below 10⁻¹²");
  }
  if (panel.ceiling) {
    out += line("floor", f.left, panel.top + edge_band, f.right, panel.top + edge_band);
    out += text("tick", f.left - 6, panel.ceiling_y + f.font * 0.35, "end", "> 1000");
  }
  const double x = f.font * 0.95, y = (panel.top + panel.bottom) / 2;
  out += fmt::format(R"~(<text class="axis" text-anchor="middle" transform="translate({} {}) rotate(-90)">{}</text>)~",
                     coordinate(x), coordinate(y), escaped(title));
  return out;
}

// As much of the words as fits into `room` pixels.
std::string fitted(const std::string& words, double font, double room) {
  std::string out = words;
  for (std::size_t most = words.size(); most > 0 && text_width(out, font) > room;) out = shortened(words, --most);
  return out;
}

}  // namespace

double Panel::at(double error) const {
  if (!std::isfinite(error)) return NAN;
  if (error <= exact_below) return floor ? floor_y : NAN;
  if (ceiling && error > worthless_above) return ceiling_y;
  return axis.at(error);
}

PlotFrame frame_of(const PlotContext& context, Layout layout) {
  const bool narrow = layout == Layout::narrow;
  PlotFrame f{};
  f.width = narrow ? 344 : 960;
  f.font = narrow ? 11 : 13;
  f.marker = narrow ? 5 : 6.5;
  f.left = narrow ? 56 : 84;
  f.right = f.width - (narrow ? 8 : 16);
  const double top = narrow ? 42 : 46;
  const double method_bottom = top + (narrow ? 300 : 400), gap = narrow ? 12 : 14;
  const double arithmetic_bottom = method_bottom + gap + (narrow ? 84 : 104);
  f.legend_y = arithmetic_bottom + (narrow ? 50 : 60);
  f.height = f.legend_y + (narrow ? 44 : 30) + (context.other != nullptr && narrow ? 18 : 0);
  std::vector<double> costs, method, arithmetic;
  for (const Plot* plot : {&context.plot, context.other})
    if (plot != nullptr)
      for (const Point& point : plot->points) {
        for (const auto& [isa, cost] : point.cost)
          for (const double ns : {cost.ns, cost.low, cost.high}) costs.push_back(ns);
        method.push_back(measured(point.method, plot->measure));
        arithmetic.push_back(measured(point.arithmetic, plot->measure));
      }
  f.cost = axis_over(costs, 0.7, 0.07, f.left, f.right);
  f.method = panel_over(method, 1, top, method_bottom);
  f.arithmetic = panel_over(arithmetic, 1, method_bottom + gap, arithmetic_bottom);
  return f;
}

std::string draw_axes(const PlotContext& context, const PlotFrame& f, Layout layout) {
  const bool narrow = layout == Layout::narrow;
  const char* measures[] = {"largest", "mean", "rms"};
  std::string out;
  const double method_room = f.method.bottom - f.method.top;
  out += draw_errors(f.method, f, 8, fitted("method error: " + context.plot.error_name, f.font, method_room), narrow);
  out += draw_errors(
      f.arithmetic, f, 3,
      narrow ? "arithmetic" : fmt::format("arithmetic, {}", measures[static_cast<int>(context.plot.measure)]), true);
  for (const Tick& tick : f.cost.ticks(8)) {
    const double x = f.cost.at(tick.value);
    for (const Panel* panel : {&f.method, &f.arithmetic})
      out += line(tick.major ? "grid" : "grid minor", x, panel->top, x, panel->bottom);
    if (tick.major) out += text("tick", x, f.arithmetic.bottom + f.font * 1.4, "middle", tick.label);
  }
  const double middle = (f.left + f.right) / 2;
  out += text("axis", middle, f.arithmetic.bottom + f.font * 2.8, "middle",
              fmt::format("cost: ns per evaluation, one thread, {}", context.isa));
  if (context.machine.clock_ghz > 0) {
    // The same axis in cycles: a shift.
    LogAxis cycles = f.cost;
    cycles.low += std::log10(context.machine.clock_ghz);
    cycles.high += std::log10(context.machine.clock_ghz);
    for (const Tick& tick : cycles.ticks(8)) {
      if (!tick.major) continue;
      const double x = cycles.at(tick.value);
      out += line("tickmark", x, f.method.top - 5, x, f.method.top);
      out += text("tick", x, f.method.top - 8, "middle", tick.label);
    }
    out += text("axis", middle, f.font * 1.1, "middle",
                fmt::format("cycles per pixel {}{:.2f} GHz", narrow ? "at " : "(one evaluation a pixel) at ",
                            context.machine.clock_ghz));
  }
  return out;
}

}  // namespace tessera::chart

// One scatter plot as SVG: cost against method error, and under it, over the same costs, arithmetic error.
#pragma once
#include <string>

#include "bench/chart/results.hpp"

namespace tessera::chart {

/// wide: points carry their names. narrow: for a phone, numbers that the table explains.
enum class Layout { wide, narrow };

/// What goes into an <svg> of this size. Colours and fonts come from classes (src/chart/style.cpp, page.css).
struct Drawing {
  std::string content;
  double width = 0, height = 0;
};

struct PlotContext {
  const Machine& machine;
  const Plot& plot;
  std::string isa;
  const Plot* other = nullptr;  // the same plot of the run that this one is compared with
  std::string other_name{};     // that run, in words
};

/// Errors below this are drawn on a floor of their own, "exact": truth itself is no better.
inline constexpr double exact_below = 1e-12;
/// On an axis of more than long_axis decades, errors above this share a place at the top: nothing distinguishes them
/// that anyone would want to know, and they would squeeze all others together.
inline constexpr double worthless_above = 1e3;
inline constexpr double long_axis = 10;

Drawing draw_plot(const PlotContext& context, Layout layout);

/// A file of its own, with title, domain and machine around the plot.
std::string standalone_plot(const PlotContext& context, const std::string& family_title);

/// How the page names a machine, in one line.
std::string caption_of(const Machine& machine, const std::string& isa);
/// The compiler flags that the kernels of this instruction set were built with.
std::string flags_of(const Machine& machine, const std::string& isa);

/// Whether the point is on the frontier of its plot, by this instruction set's costs. One entry per point.
std::vector<bool> on_frontier(const Plot& plot, const std::string& isa);

}  // namespace tessera::chart

// Where a plot's panels and axes lie. The axes span every instruction set (and the other run), so that switching
// between them moves points and not the ground.
#pragma once
#include "bench/chart/plot.hpp"
#include "chart/axis.hpp"
#include "chart/labels.hpp"

namespace tessera::chart {

struct Panel {
  LogAxis axis;  // error; from = bottom, to = top
  double top = 0, bottom = 0;
  bool floor = false;  // errors below exact_below have a place, at floor_y
  double floor_y = 0;
  bool ceiling = false;  // so have errors above worthless_above, at ceiling_y
  double ceiling_y = 0;

  /// NaN for errors that are no numbers.
  [[nodiscard]] double at(double error) const;
};

struct PlotFrame {
  double width, height, left, right;
  double font, marker;
  LogAxis cost;
  Panel method, arithmetic;
  double legend_y;
};

PlotFrame frame_of(const PlotContext& context, Layout layout);

/// Grid, ticks and titles of the axes.
std::string draw_axes(const PlotContext& context, const PlotFrame& frame, Layout layout);

}  // namespace tessera::chart

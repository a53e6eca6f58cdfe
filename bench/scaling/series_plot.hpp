// Times against what they grow with, and beside them how they should grow.
#pragma once
#include <string>
#include <vector>

#include "chart/svg.hpp"

namespace tessera::scaling {

struct PlottedPoint {
  double x, y, low, high;
  std::string name{};  // of x, where it has one
};

struct PlottedSeries {
  std::string name;
  std::vector<PlottedPoint> points;
  std::vector<chart::Place> guide;
};

struct SeriesPlot {
  std::string x_name, y_name, guide_name;
  bool linear = false;  // axes from 0; else both logarithmic
  std::vector<PlottedSeries> series;
};

/// A whole SVG file. Values positive (x of linear axes: not negative).
std::string draw(const SeriesPlot& plot, const chart::Lettering& around);

}  // namespace tessera::scaling

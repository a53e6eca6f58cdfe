// Cost against error of the same thing done in many ways: which ways are worth their price, and which one was taken.
#pragma once
#include <string>
#include <vector>

#include "chart/svg.hpp"

namespace tessera::chart {

struct FrontierPoint {
  double cost = 0, error = 0;
  std::string name, mark;  // in words; and in a letter or two, for where words find no room
  bool frontier = false;   // on the Pareto frontier
  bool chosen = false;
  bool notable = false;  // has its name on the plot although it is not on the frontier
};

struct FrontierPlot {
  std::string cost_name, error_name;  // of the axes, with units
  double limit = 0;                   // of error; 0: none is drawn
  std::string limit_name;
  double exact_below = 1e-3;  // smaller errors share one place
  std::vector<FrontierPoint> points;
};

/// A whole SVG file. Both axes are logarithmic. At least one point; costs above 0, errors finite and not negative.
std::string draw(const FrontierPlot& plot, const Lettering& around);

}  // namespace tessera::chart

// This run beside another one: of another machine, compiler or commit.
#pragma once
#include "bench/chart/results.hpp"

namespace tessera::chart {

/// The same plot in the other run (by the ids of family and plot), or null.
const Plot* matching_plot(const Results& other, const std::string& family, const std::string& plot);
const Point* matching_point(const Plot* other, const std::string& id);

/// This run's cost over the other's, for a method and an instruction set that both have; else 0.
double cost_ratio(const Point& mine, const Point* theirs, const std::string& isa);

struct RatioSummary {
  std::string family, isa;
  int methods = 0;
  double geometric_mean = 1, lowest = 1, highest = 1;
  std::string lowest_title, highest_title;
};

/// One row per family and instruction set that both runs have, a method counted once however many plots show it.
std::vector<RatioSummary> summarise_ratios(const Results& mine, const Results& theirs);

/// How plots and tables call the other run.
std::string name_of_run(const Machine& machine);

}  // namespace tessera::chart

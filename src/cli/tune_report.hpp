// What `tune` found: as a table with a chart, and as JSON.
#pragma once
#include <string>
#include <vector>

#include "cli/tune_knobs.hpp"

namespace tessera::cli {

struct TuneReport {
  std::string scene, isa;
  int width = 0, height = 0, threads = 0, frames = 0;
  std::size_t pixels = 0;  // that show the scene: those that the errors are over
  PictureError limit;
  TuneKnobs knobs;
  std::vector<KnobPoint> points;
  std::size_t chosen = 0;
};

/// "mean error 0.81 display steps (99 % of pixels within 5), 41.23 ms a frame"
std::string result_of(const KnobPoint& point);

/// The frontier, the knobs alone, the defaults and the choice, cheapest first; and the chart of all.
std::string table_of(const TuneReport& report);

/// All points. path "-": standard output. Throws Error(output).
void write_results(const std::string& path, const TuneReport& report);

}  // namespace tessera::cli

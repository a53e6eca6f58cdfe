// What `tune` found: as a table with a chart, as a picture, and as JSON.
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
  RenderSettings base;  // what is not varied
  TuneKnobs knobs;
  std::vector<KnobPoint> points;
  std::size_t chosen = 0;

  [[nodiscard]] RenderSettings settings_of(const KnobChoice& choice) const {
    RenderSettings settings = base;
    knobs.apply(choice, settings);
    return settings;
  }
};

/// "mean error 0.81 display steps (99 % of pixels within 5), 41.23 ms a frame"
std::string result_of(const KnobPoint& point);

/// The frontier, the knobs alone, the defaults and the choice, cheapest first; and the chart of all.
std::string table_of(const TuneReport& report);

/// All points as an SVG.
std::string chart_of(const TuneReport& report);

/// All points as JSON.
std::string results_of(const TuneReport& report);

}  // namespace tessera::cli

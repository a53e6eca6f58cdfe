// What a run did and how long it took: for a person, and as JSON (--stats).
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "frame/settings.hpp"
#include "frame/statistics.hpp"

namespace tessera::cli {

/// A part of the run, in ticks().
struct RunPhase {
  const char* name;
  std::uint64_t begin, end;
};

struct RunReport {
  std::string command, scene, output;
  int width = 0, height = 0, samples = 0;
  std::size_t scene_triangles = 0;
  // Stages of the whole run in order, wall-clock milliseconds.
  double load_ms = 0, environment_ms = 0, encode_ms = 0, write_ms = 0, total_ms = 0;
  FrameStatistics frame{};
  std::vector<RunPhase> phases;

  /// Ends the phase that began where the last one ended.
  void end_phase(const char* name) {
    const std::uint64_t now = ticks();
    phases.push_back({name, phase_begin_, now});
    phase_begin_ = now;
  }

 private:
  std::uint64_t phase_begin_ = ticks();
};

/// A short table on standard error.
void tell(const RunReport& report);

/// JSON to a file ("-": standard output). Throws Error(output).
void write_statistics(const std::string& path, const RunReport& report);

}  // namespace tessera::cli

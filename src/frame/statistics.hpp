// What a frame cost, and what it did.
#pragma once
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/stage_clock.hpp"
#include "kernels/interface.hpp"

namespace tessera {

/// What one thread did, by stage.
struct ThreadProfile {
  std::array<std::uint64_t, stage_count> ticks{};
  std::vector<StageEvent> events;  // if RenderSettings::trace
};

struct FrameStatistics {
  double prepare_ms = 0;                       // tables and textures; once per scene
  double geometry_ms = 0;                      // vertex stage, set-up and binning
  double tiles_ms = 0;                         // everything per tile
  double total_ms = 0;                         // geometry + tiles
  std::array<double, stage_count> stage_ms{};  // summed over threads
  std::vector<ThreadProfile> profile;          // per thread
  double ticks_per_ms = 0;                     // of the clock that profile is in
  std::uint64_t begin_ticks = 0;
  GeometryCounters geometry{};
  std::uint64_t binned = 0;  // (triangle, tile) pairs
  std::uint64_t tiles = 0, tiles_empty = 0;
  std::uint64_t fragments = 0;      // shaded
  std::uint64_t pixels_shaded = 0;  // pixels with at least one fragment
  std::uint64_t working_bytes = 0;  // bins, set-up and tile memory beyond scene and picture
  std::uint64_t texture_bytes = 0, table_bytes = 0;
  std::uint64_t pixel_hash = 0;  // PixelHash of the linear picture
  int threads = 0;
  const char* isa = "";

  /// As new, but for the memory.
  void clear() {
    std::vector<ThreadProfile> kept = std::move(profile);
    for (ThreadProfile& thread : kept) {
      thread.ticks = {};
      thread.events.clear();
    }
    *this = {};
    profile = std::move(kept);
  }
};

}  // namespace tessera

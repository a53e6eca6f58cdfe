// What a frame cost, and what it did.
#pragma once
#include <array>
#include <cstdint>

#include "kernels/interface.hpp"

namespace tessera {

/// Work inside tiles, in the order in which a tile goes through it.
enum class TileStage { coverage, alpha_mask, collect, resolve, shade, background, composite, count };
inline constexpr std::array<const char*, static_cast<int>(TileStage::count)> tile_stage_names = {
    "coverage", "alpha_mask", "collect", "resolve", "shade", "background", "composite"};

struct FrameStatistics {
  double prepare_ms = 0;                                                   // tables and textures; once per scene
  double geometry_ms = 0;                                                  // vertex stage, set-up and binning
  double tiles_ms = 0;                                                     // everything per tile
  double total_ms = 0;                                                     // geometry + tiles
  std::array<double, static_cast<int>(TileStage::count)> tile_stage_ms{};  // summed over threads
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
};

}  // namespace tessera

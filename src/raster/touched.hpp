// Which tiles a triangle may touch.
#pragma once
#include <algorithm>
#include <cstdint>

#include "kernels/interface.hpp"

namespace tessera {

inline constexpr int tile_shift = 5;
static_assert(1 << tile_shift == tile_size);

/// A frame as a grid of tiles, with the sample positions that decide what is touched.
struct TileScreen {
  int width = 0, height = 0;                                // pixels
  int columns = 0, rows = 0;                                // tiles
  std::int32_t x_min = 0, x_max = 0, y_min = 0, y_max = 0;  // extent of the sample pattern in a pixel, 1/256 pixel

  TileScreen() = default;
  TileScreen(int frame_width, int frame_height, const SamplePattern& pattern);
};

/// Tiles first to last (inclusive) of one row.
struct TileRange {
  int first, last;
};

/// The tiles of a set-up triangle, row by row. Up to 2 x 2 tiles it is the bounding box; beyond that, a tile whose
/// samples lie wholly outside one edge is left out, exactly. So it is a superset of the tiles with covered samples.
class TouchedTiles {
 public:
  TouchedTiles(const TileScreen& screen, const SetupTriangle& t) {
    // Samples on the right and bottom border of the bounding box belong to neighbours (top-left rule).
    const auto least = [](const std::int32_t(&v)[3]) { return std::min(std::min(v[0], v[1]), v[2]); };
    const auto most = [](const std::int32_t(&v)[3]) { return std::max(std::max(v[0], v[1]), v[2]); };
    const int x0 = std::max((least(t.x) - screen.x_max + 255) >> subpixel_bits, 0);
    const int x1 = std::min((most(t.x) - screen.x_min - 1) >> subpixel_bits, screen.width - 1);
    const int y0 = std::max((least(t.y) - screen.y_max + 255) >> subpixel_bits, 0);
    const int y1 = std::min((most(t.y) - screen.y_min - 1) >> subpixel_bits, screen.height - 1);
    if (x0 > x1 || y0 > y1) return;
    box_ = {x0 >> tile_shift, x1 >> tile_shift};
    first_row_ = y0 >> tile_shift, last_row_ = y1 >> tile_shift;
    by_edges_ = box_.last - box_.first > 1 || last_row_ - first_row_ > 1;
    if (by_edges_) set_edges(screen, t);
  }
  [[nodiscard]] int first_row() const { return first_row_; }
  [[nodiscard]] int last_row() const { return last_row_; }  // before first_row: none
  /// Empty (last < first) where the edges leave nothing of the row.
  [[nodiscard]] TileRange row(int row) const { return by_edges_ ? row_within_edges(row) : box_; }

 private:
  [[nodiscard]] TileRange row_within_edges(int row) const;

  void set_edges(const TileScreen& screen, const SetupTriangle& t);

  TileRange box_{0, -1};
  int first_row_ = 0, last_row_ = -1;
  bool by_edges_ = false;
  std::int64_t a_[3], b_[3], most_[3];  // most_: the edge function at its best sample of tile (0, 0)
};

}  // namespace tessera

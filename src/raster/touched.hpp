// Which tiles a triangle may touch.
#pragma once
#include <cstdint>

#include "kernels/interface.hpp"

namespace tessera {

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
  TouchedTiles(const TileScreen& screen, const SetupTriangle& triangle);
  [[nodiscard]] int first_row() const { return first_row_; }
  [[nodiscard]] int last_row() const { return last_row_; }  // before first_row: none
  /// Empty (last < first) where the edges leave nothing of the row.
  [[nodiscard]] TileRange row(int row) const { return by_edges_ ? row_within_edges(row) : box_; }

 private:
  [[nodiscard]] TileRange row_within_edges(int row) const;

  TileRange box_;
  int first_row_, last_row_;
  bool by_edges_;
  std::int64_t a_[3], b_[3], most_[3];  // most_: the edge function at its best sample of tile (0, 0)
};

}  // namespace tessera

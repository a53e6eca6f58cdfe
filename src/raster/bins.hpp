// Per-tile lists of triangles in submission order, filled by several threads.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"
#include "raster/touched.hpp"

namespace tessera {

/// A tile's triangles (indices into the frame's set-up triangles) in submission order, by alphaMode.
struct TileLists {
  std::span<const std::uint32_t> opaque, mask, blend;
};

inline constexpr int alpha_classes = 3;

/// A run of tiles in one row that a triangle may touch, and triangles after it that touch the same: neighbours in a
/// mesh mostly lie in one tile.
struct TileSpan {
  std::uint16_t first, last;         // columns, both included
  std::uint32_t triangle_and_class;  // index within the chunk, times 4, plus AlphaMode
  std::uint32_t count;               // triangles, one after another, of one class
};

/// Memory that a thread keeps while it fills chunks.
struct BinScratch {
  ScratchVector<TileSpan> spans;
  ScratchVector<std::uint16_t> rows;
  std::vector<std::uint32_t> row_counts;
};

/// Where the triangles of one chunk go: spans bucketed by tile row, only for the rows that they touch.
class ChunkBins {
 public:
  /// setup: the chunk's triangles, whose indices refer to `triangles`; boxes: the tiles of each; alpha_modes: per
  /// binding, empty if all are opaque.
  void fill(const TileScreen& screen, std::span<const SetupTriangle> setup, const TouchedBox* boxes,
            const Triangle* triangles, std::span<const AlphaMode> alpha_modes, BinScratch& scratch);
  [[nodiscard]] std::span<const TileSpan> row(int row) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  int first_row_ = 0;
  std::vector<std::uint32_t> begin_;  // of each row from first_row_ on, and the end
  ScratchVector<TileSpan> spans_;
};

/// The finished lists of one row of tiles.
class RowBins {
 public:
  /// base[c]: index of chunk c's first triangle among the frame's.
  void gather(int row, int columns, std::span<const ChunkBins> chunks, std::span<const std::uint32_t> base);
  [[nodiscard]] TileLists lists(int column) const;
  [[nodiscard]] std::size_t entries() const { return entries_.size(); }
  [[nodiscard]] std::size_t bytes() const;

 private:
  std::vector<std::size_t> begin_;  // [column * alpha_classes + class], and the end
  ScratchVector<std::uint32_t> entries_;
};

}  // namespace tessera

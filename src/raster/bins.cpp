#include "raster/bins.hpp"

#include <algorithm>

namespace tessera {

void ChunkBins::fill(const TileScreen& screen, std::span<const SetupTriangle> setup, const Triangle* triangles,
                     std::span<const AlphaMode> alpha_modes, BinScratch& scratch) {
  scratch.spans.resize(std::max(scratch.spans.capacity(), setup.size() + static_cast<std::size_t>(screen.rows)));
  scratch.rows.resize(scratch.spans.size());
  std::size_t count = 0;
  int first_row = screen.rows, last_row = -1;
  for (std::size_t i = 0; i < setup.size(); ++i) {
    const TouchedTiles touched(screen, setup[i]);
    if (touched.first_row() > touched.last_row()) continue;
    first_row = std::min(first_row, touched.first_row());
    last_row = std::max(last_row, touched.last_row());
    auto reference = static_cast<std::uint32_t>(i) * 4;
    if (!alpha_modes.empty())
      reference += static_cast<std::uint32_t>(alpha_modes[triangles[setup[i].triangle].binding]);
    if (count + static_cast<std::size_t>(screen.rows) > scratch.spans.size()) {
      scratch.spans.resize(2 * scratch.spans.size());
      scratch.rows.resize(scratch.spans.size());
    }
    for (int row = touched.first_row(); row <= touched.last_row(); ++row) {
      const TileRange range = touched.row(row);
      scratch.spans[count] = {static_cast<std::uint16_t>(range.first), static_cast<std::uint16_t>(range.last),
                              reference};
      scratch.rows[count] = static_cast<std::uint16_t>(row);
      count += range.first <= range.last;
    }
  }
  // A counting sort by row. begin_[r + 2] counts row r; begin_[r + 1] is then where row r is written next, and ends as
  // where row r + 1 begins.
  first_row_ = first_row;
  begin_.assign(static_cast<std::size_t>(std::max(last_row - first_row + 1, 0)) + 2, 0);
  for (std::size_t i = 0; i < count; ++i) ++begin_[static_cast<std::size_t>(scratch.rows[i] - first_row) + 2];
  for (std::size_t row = 1; row < begin_.size(); ++row) begin_[row] += begin_[row - 1];
  spans_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    spans_[begin_[static_cast<std::size_t>(scratch.rows[i] - first_row) + 1]++] = scratch.spans[i];
  }
  begin_.pop_back();
}

std::span<const TileSpan> ChunkBins::row(int row) const {
  const int r = row - first_row_;
  if (r < 0 || static_cast<std::size_t>(r) + 1 >= begin_.size()) return {};
  return {spans_.data() + begin_[r], spans_.data() + begin_[r + 1]};
}

std::size_t ChunkBins::bytes() const {
  return begin_.capacity() * sizeof(begin_[0]) + spans_.capacity() * sizeof(TileSpan);
}

void RowBins::gather(int row, int columns, std::span<const ChunkBins> chunks, std::span<const std::uint32_t> base) {
  begin_.assign(static_cast<std::size_t>(columns) * alpha_classes + 2, 0);
  const auto slot = [](std::uint32_t column, const TileSpan& s) {
    return std::size_t{column} * alpha_classes + s.triangle_and_class % 4;
  };
  for (const ChunkBins& chunk : chunks)
    for (const TileSpan& s : chunk.row(row))
      for (std::uint32_t column = s.first; column <= s.last; ++column) ++begin_[slot(column, s) + 2];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  entries_.resize(begin_.back());
  for (std::size_t c = 0; c < chunks.size(); ++c)
    for (const TileSpan& s : chunks[c].row(row))
      for (std::uint32_t column = s.first; column <= s.last; ++column)
        entries_[begin_[slot(column, s) + 1]++] = base[c] + s.triangle_and_class / 4;
  begin_.pop_back();
}

TileLists RowBins::lists(int column) const {
  const std::size_t* begin = begin_.data() + static_cast<std::size_t>(column) * alpha_classes;
  const auto list = [&](AlphaMode alpha) {
    const int k = static_cast<int>(alpha);
    return std::span<const std::uint32_t>(entries_.data() + begin[k], entries_.data() + begin[k + 1]);
  };
  return {list(AlphaMode::opaque), list(AlphaMode::mask), list(AlphaMode::blend)};
}

std::size_t RowBins::bytes() const {
  return begin_.capacity() * sizeof(begin_[0]) + entries_.capacity() * sizeof(entries_[0]);
}

}  // namespace tessera

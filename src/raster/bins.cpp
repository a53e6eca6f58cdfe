#include "raster/bins.hpp"

#include <algorithm>
#include <numeric>

namespace tessera {

void ChunkBins::fill(const TileScreen& screen, std::span<const SetupTriangle> setup, const TouchedBox* boxes,
                     const Triangle* triangles, std::span<const AlphaMode> alpha_modes, BinScratch& scratch) {
  scratch.spans.resize(std::max(scratch.spans.capacity(), 2 * setup.size() + static_cast<std::size_t>(screen.rows)));
  scratch.rows.resize(scratch.spans.size());
  scratch.row_counts.assign(static_cast<std::size_t>(screen.rows), 0);
  std::uint32_t* const row_counts = scratch.row_counts.data();
  TileSpan* span = scratch.spans.data();
  std::uint16_t* span_row = scratch.rows.data();
  TileSpan run{};  // grows until a triangle does not continue it
  int run_row = -1;
  const auto finish_run = [&] {
    if (run_row < 0) return;
    *span++ = run;
    *span_row++ = static_cast<std::uint16_t>(run_row);
    ++row_counts[run_row];
  };
  const auto add = [&](int row, TileRange range, std::uint32_t reference) {
    const auto first = static_cast<std::uint16_t>(range.first), last = static_cast<std::uint16_t>(range.last);
    if (row == run_row && first == run.first && last == run.last &&
        reference == run.triangle_and_class + 4 * run.count) {
      ++run.count;
      return;
    }
    finish_run();
    run = {first, last, reference, 1};
    run_row = row;
  };
  for (std::size_t i = 0; i < setup.size(); ++i) {
    const TouchedBox& box = boxes[i];
    auto reference = static_cast<std::uint32_t>(i) * 4;
    if (!alpha_modes.empty())
      reference += static_cast<std::uint32_t>(alpha_modes[triangles[setup[i].triangle].binding]);
    if (box.last_column - box.first_column <= 1 && box.last_row - box.first_row <= 1) {
      for (int row = box.first_row; row <= box.last_row; ++row)
        add(row, {box.first_column, box.last_column}, reference);
      continue;
    }
    const TouchedTiles touched(screen, setup[i]);
    const auto used = static_cast<std::size_t>(span - scratch.spans.data());
    // Room for the run, this one's rows, and two for each that follows.
    if (const std::size_t need = used + 1 + static_cast<std::size_t>(screen.rows) + 2 * setup.size();
        need > scratch.spans.size()) {
      scratch.spans.resize(2 * need);
      scratch.rows.resize(2 * need);
      span = scratch.spans.data() + used;
      span_row = scratch.rows.data() + used;
    }
    for (int row = touched.first_row(); row <= touched.last_row(); ++row)
      if (const TileRange range = touched.row(row); range.first <= range.last) add(row, range, reference);
  }
  finish_run();
  // A counting sort by row, over the rows that are touched: next[r] is where row r is written next.
  const auto count = static_cast<std::size_t>(span - scratch.spans.data());
  int first_row = 0, last_row = screen.rows - 1;
  while (first_row <= last_row && row_counts[first_row] == 0) ++first_row;
  while (last_row > first_row && row_counts[last_row] == 0) --last_row;
  first_row_ = first_row;
  begin_.assign(1, 0);
  for (int row = first_row; row <= last_row; ++row) begin_.push_back(begin_.back() + row_counts[row]);
  std::uint32_t* const next = row_counts;
  for (int row = first_row; row <= last_row; ++row) next[row] = begin_[static_cast<std::size_t>(row - first_row)];
  spans_.resize(count);
  for (std::size_t i = 0; i < count; ++i) spans_[next[scratch.rows[i]]++] = scratch.spans[i];
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
      for (std::uint32_t column = s.first; column <= s.last; ++column) begin_[slot(column, s) + 2] += s.count;
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  entries_.resize(begin_.back());
  for (std::size_t c = 0; c < chunks.size(); ++c)
    for (const TileSpan& s : chunks[c].row(row))
      for (std::uint32_t column = s.first; column <= s.last; ++column) {
        std::size_t& end = begin_[slot(column, s) + 1];
        std::iota(entries_.data() + end, entries_.data() + end + s.count, base[c] + s.triangle_and_class / 4);
        end += s.count;
      }
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

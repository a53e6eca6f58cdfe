// The geometry stage: a scene's triangles -> set-up triangles and the tiles that each may touch.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/aligned.hpp"
#include "base/parallel.hpp"
#include "base/stage_clock.hpp"
#include "kernels/interface.hpp"
#include "raster/bins.hpp"

namespace tessera {

/// Keeps its memory from frame to frame. Results do not depend on the number of threads: the work is cut into chunks of
/// a fixed number of triangles, and chunks are put together in order.
class GeometryStage {
 public:
  /// Transforms, clips, culls, sets up and bins everything, on the threads of the caller's arena.
  /// double_sided and alpha_modes: per binding. view.width and view.height: 1 to max_frame_size. Where z <= w,
  /// ViewTransform gives w > 0; every index of geometry is in range.
  void run(const GeometryView& geometry, const ViewTransform& view, int samples,
           std::span<const std::uint8_t> double_sided, std::span<const AlphaMode> alpha_modes, const Kernels& kernels,
           bool trace = false);

  /// In submission order; a clipped triangle can have several, one after another.
  [[nodiscard]] std::span<const SetupTriangle> setup() const { return {setup_.data(), base_.back()}; }
  /// Column and row of a tile of the frame.
  [[nodiscard]] TileLists lists(int column, int row) const { return rows_[row].lists(column); }
  [[nodiscard]] const GeometryCounters& counters() const { return counters_; }
  /// Entries in all lists.
  [[nodiscard]] std::uint64_t binned() const { return binned_; }
  [[nodiscard]] std::size_t bytes() const;
  /// Of the last run, per thread.
  [[nodiscard]] std::span<const StageClock> clocks() const { return clocks_; }

 private:
  struct Chunk {
    ScratchVector<SetupTriangle> overflow;  // set-up that did not fit behind that of the chunks before it
    GeometryCounters counters;
  };
  struct Scratch {
    std::unique_ptr<SetupTriangle[]> setup;
    std::unique_ptr<TouchedBox[]> touched;
    BinScratch bins;
  };
  StageClock& clock() { return clocks_[static_cast<std::size_t>(thread_index())]; }
  void set_up_chunk(const SetupTrianglesArgs& all, std::size_t chunk, Scratch& scratch, const Kernels& kernels);
  void join_chunks();

  TileScreen screen_;
  ScratchVector<ProjectedVertex> vertices_;
  std::vector<Chunk> chunks_;
  std::vector<ChunkBins> chunk_bins_;
  std::span<const AlphaMode> alpha_modes_;  // empty: all are opaque
  std::vector<std::uint32_t> base_{0};      // first set-up triangle of each chunk, and the end
  std::atomic<std::size_t> next_chunk_{0}, placed_{0};
  std::vector<RowBins> rows_;
  std::vector<Scratch> scratch_;  // per thread
  std::vector<StageClock> clocks_;
  ScratchVector<SetupTriangle> setup_;
  GeometryCounters counters_{};
  std::uint64_t binned_ = 0;
};

}  // namespace tessera

// The geometry stage: a scene's triangles -> set-up triangles and the tiles that each may touch.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/aligned.hpp"
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
           std::span<const std::uint8_t> double_sided, std::span<const AlphaMode> alpha_modes, const Kernels& kernels);

  /// In submission order; a clipped triangle can have several, one after another.
  [[nodiscard]] std::span<const SetupTriangle> setup() const { return {setup_.get(), setup_count_}; }
  /// Column and row of a tile of the frame.
  [[nodiscard]] TileLists lists(int column, int row) const { return rows_[row].lists(column); }
  [[nodiscard]] const GeometryCounters& counters() const { return counters_; }
  /// Entries in all lists.
  [[nodiscard]] std::uint64_t binned() const { return binned_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Chunk {
    std::vector<SetupTriangle> setup;
    GeometryCounters counters;
  };
  struct Scratch {
    std::unique_ptr<SetupTriangle[]> setup;
    BinScratch bins;
  };
  void set_up_chunk(const SetupTrianglesArgs& all, std::size_t chunk, std::span<const AlphaMode> alpha_modes,
                    const Kernels& kernels);
  void join_chunks();

  TileScreen screen_;
  AlignedVector<ProjectedVertex> vertices_;
  std::vector<Chunk> chunks_;
  std::vector<ChunkBins> chunk_bins_;
  std::vector<std::uint32_t> base_;  // first set-up triangle of each chunk, and the end
  std::vector<RowBins> rows_;
  std::vector<Scratch> scratch_;  // per thread
  std::unique_ptr<SetupTriangle[]> setup_;
  std::size_t setup_count_ = 0, setup_capacity_ = 0;
  GeometryCounters counters_{};
  std::uint64_t binned_ = 0;
};

}  // namespace tessera

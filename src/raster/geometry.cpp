#include "raster/geometry.hpp"

#include <algorithm>
#include <cstring>

#include "base/parallel.hpp"

namespace tessera {
namespace {

// Fixed, so that nothing depends on the number of threads. A chunk's triangles and their set-up fit in L2.
constexpr std::uint32_t triangles_per_chunk = 4096;
constexpr std::size_t setup_per_chunk = std::size_t{triangles_per_chunk} * max_setup_per_triangle;
constexpr std::uint32_t vertices_per_chunk = 8192;

std::uint32_t chunks_of(std::uint32_t count, std::uint32_t size) { return count / size + (count % size != 0); }

void add(GeometryCounters& sum, const GeometryCounters& c) {
  sum.in += c.in;
  sum.outside += c.outside;
  sum.back_face += c.back_face;
  sum.empty += c.empty;
  sum.clipped += c.clipped;
  sum.kept += c.kept;
}

}  // namespace

void GeometryStage::run(const GeometryView& geometry, const ViewTransform& view, int samples,
                        std::span<const std::uint8_t> double_sided, std::span<const AlphaMode> alpha_modes,
                        const Kernels& kernels) {
  screen_ = TileScreen(view.width, view.height, kernels.sample_pattern(samples));
  vertices_.resize(geometry.vertex_count);
  parallel_for(chunks_of(geometry.vertex_count, vertices_per_chunk), [&](std::size_t chunk) {
    const std::uint32_t first = static_cast<std::uint32_t>(chunk) * vertices_per_chunk;
    const std::uint32_t count = std::min(vertices_per_chunk, geometry.vertex_count - first);
    kernels.project_vertices(view, geometry.positions + std::size_t{3} * first, count, vertices_.data() + first);
  });

  const std::uint32_t chunk_count = chunks_of(geometry.triangle_count, triangles_per_chunk);
  chunks_.resize(chunk_count);
  chunk_bins_.resize(chunk_count);
  scratch_.resize(std::max(scratch_.size(), static_cast<std::size_t>(thread_count())));
  const SetupTrianglesArgs all{geometry, view, vertices_.data(), double_sided.data(), samples, 0, 0, nullptr, nullptr};
  parallel_for(chunk_count, [&](std::size_t chunk) { set_up_chunk(all, chunk, alpha_modes, kernels); });
  join_chunks();

  rows_.resize(static_cast<std::size_t>(screen_.rows));
  parallel_for(rows_.size(),
               [&](std::size_t row) { rows_[row].gather(static_cast<int>(row), screen_.columns, chunk_bins_, base_); });
  binned_ = 0;
  for (const RowBins& row : rows_) binned_ += row.entries();
}

void GeometryStage::set_up_chunk(const SetupTrianglesArgs& all, std::size_t index,
                                 std::span<const AlphaMode> alpha_modes, const Kernels& kernels) {
  Scratch& scratch = scratch_[static_cast<std::size_t>(thread_index())];
  if (!scratch.setup) scratch.setup = std::make_unique_for_overwrite<SetupTriangle[]>(setup_per_chunk);
  Chunk& chunk = chunks_[index];
  chunk.counters = {};
  SetupTrianglesArgs args = all;
  args.first = static_cast<std::uint32_t>(index) * triangles_per_chunk;
  args.count = std::min(triangles_per_chunk, all.geometry.triangle_count - args.first);
  args.out = scratch.setup.get();
  args.counters = &chunk.counters;
  const std::uint32_t count = kernels.setup_triangles(args);
  chunk.setup.assign(args.out, args.out + count);
  chunk_bins_[index].fill(screen_, chunk.setup, all.geometry.triangles, alpha_modes, scratch.bins);
}

void GeometryStage::join_chunks() {
  counters_ = {};
  base_.assign(1, 0);
  for (const Chunk& chunk : chunks_) {
    add(counters_, chunk.counters);
    base_.push_back(base_.back() + static_cast<std::uint32_t>(chunk.setup.size()));
  }
  setup_count_ = base_.back();
  if (setup_capacity_ < setup_count_) {
    setup_ = std::make_unique_for_overwrite<SetupTriangle[]>(setup_count_);
    setup_capacity_ = setup_count_;
  }
  parallel_for(chunks_.size(), [&](std::size_t c) {
    if (chunks_[c].setup.empty()) return;
    std::memcpy(setup_.get() + base_[c], chunks_[c].setup.data(), chunks_[c].setup.size() * sizeof(SetupTriangle));
  });
}

std::size_t GeometryStage::bytes() const {
  std::size_t sum = vertices_.capacity() * sizeof(ProjectedVertex) + setup_capacity_ * sizeof(SetupTriangle);
  for (const Chunk& chunk : chunks_) sum += chunk.setup.capacity() * sizeof(SetupTriangle);
  for (const ChunkBins& chunk : chunk_bins_) sum += chunk.bytes();
  for (const RowBins& row : rows_) sum += row.bytes();
  for (const Scratch& s : scratch_) {
    sum += (s.setup ? setup_per_chunk * sizeof(SetupTriangle) : 0) + s.bins.spans.capacity() * sizeof(TileSpan) +
           s.bins.rows.capacity() * sizeof(std::uint16_t);
  }
  return sum;
}

}  // namespace tessera

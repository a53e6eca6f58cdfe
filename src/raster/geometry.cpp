#include "raster/geometry.hpp"

#include <algorithm>
#include <thread>

#include "base/parallel.hpp"
#include "base/stream_copy.hpp"

namespace tessera {
namespace {

// Fixed, so that nothing depends on the number of threads. A chunk's triangles and their set-up fit in L2.
constexpr std::uint32_t triangles_per_chunk = 4096;
constexpr std::size_t setup_per_chunk = std::size_t{triangles_per_chunk} * max_setup_per_triangle;
constexpr std::uint32_t vertices_per_chunk = 8192;
// Memory that is not touched costs nothing; what does not fit the first time makes room for the next.
constexpr std::size_t first_setup_capacity = std::size_t{1} << 21;

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
                        const Kernels& kernels, bool trace) {
  screen_ = TileScreen(view.width, view.height, kernels.sample_pattern(samples));
  vertices_.resize(geometry.vertex_count);
  clocks_.resize(std::max(clocks_.size(), static_cast<std::size_t>(thread_count())));
  for (StageClock& c : clocks_) c.reset(trace);
  parallel_for(chunks_of(geometry.vertex_count, vertices_per_chunk), [&](std::size_t chunk) {
    clock().start(static_cast<std::uint32_t>(chunk));
    const std::uint32_t first = static_cast<std::uint32_t>(chunk) * vertices_per_chunk;
    const std::uint32_t count = std::min(vertices_per_chunk, geometry.vertex_count - first);
    kernels.project_vertices(view, geometry.positions + std::size_t{3} * first, count, vertices_.data() + first);
    clock().lap(Stage::vertices);
  });

  const std::size_t chunk_count = chunks_of(geometry.triangle_count, triangles_per_chunk);
  chunks_.resize(chunk_count);
  chunk_bins_.resize(chunk_count);
  base_.assign(chunk_count + 1, 0);
  if (setup_.empty()) setup_.resize(std::min<std::size_t>(geometry.triangle_count, first_setup_capacity));
  const bool plain =
      std::all_of(alpha_modes.begin(), alpha_modes.end(), [](AlphaMode m) { return m == AlphaMode::opaque; });
  alpha_modes_ = plain ? std::span<const AlphaMode>() : alpha_modes;
  scratch_.resize(std::max(scratch_.size(), static_cast<std::size_t>(thread_count())));
  for (Scratch& scratch : scratch_)
    if (!scratch.setup) {
      scratch.setup = std::make_unique_for_overwrite<SetupTriangle[]>(setup_per_chunk);
      scratch.touched = std::make_unique_for_overwrite<TouchedBox[]>(setup_per_chunk);
    }
  const SetupTrianglesArgs all{geometry, view, vertices_.data(), double_sided.data(), samples, 0, 0, nullptr, nullptr};
  // Chunks are begun in order, so that each finds out soon where the one before it ends.
  next_chunk_ = placed_ = 0;
  parallel_for(static_cast<std::size_t>(thread_count()), [&](std::size_t) {
    Scratch& scratch = scratch_[static_cast<std::size_t>(thread_index())];
    for (std::size_t chunk = next_chunk_++; chunk < chunk_count; chunk = next_chunk_++)
      set_up_chunk(all, chunk, scratch, kernels);
  });
  join_chunks();

  rows_.resize(static_cast<std::size_t>(screen_.rows));
  parallel_for(rows_.size(), [&](std::size_t row) {
    clock().start(static_cast<std::uint32_t>(row));
    rows_[row].gather(static_cast<int>(row), screen_.columns, chunk_bins_, base_);
    clock().lap(Stage::bins);
  });
  binned_ = 0;
  for (const RowBins& row : rows_) binned_ += row.entries();
}

void GeometryStage::set_up_chunk(const SetupTrianglesArgs& all, std::size_t index, Scratch& scratch,
                                 const Kernels& kernels) {
  clock().start(static_cast<std::uint32_t>(index));
  Chunk& chunk = chunks_[index];
  chunk.counters = {};
  chunk.overflow.clear();
  SetupTrianglesArgs args = all;
  args.first = static_cast<std::uint32_t>(index) * triangles_per_chunk;
  args.count = std::min(triangles_per_chunk, all.geometry.triangle_count - args.first);
  args.out = scratch.setup.get();
  args.counters = &chunk.counters;
  args.touched = scratch.touched.get();
  const std::uint32_t count = kernels.setup_triangles(args);
  while (placed_.load(std::memory_order_acquire) != index) std::this_thread::yield();
  const std::size_t begin = base_[index], end = begin + count;
  base_[index + 1] = static_cast<std::uint32_t>(end);
  placed_.store(index + 1, std::memory_order_release);
  if (end <= setup_.size()) {
    stream_copy(setup_.data() + begin, args.out, count * sizeof(SetupTriangle));
  } else {
    chunk.overflow.assign(args.out, args.out + count);
  }
  clock().lap(Stage::triangles);
  chunk_bins_[index].fill(screen_, {args.out, count}, args.touched, all.geometry.triangles, alpha_modes_, scratch.bins);
  clock().lap(Stage::bins);
}

void GeometryStage::join_chunks() {
  counters_ = {};
  for (const Chunk& chunk : chunks_) add(counters_, chunk.counters);
  if (base_.back() <= setup_.size()) return;
  setup_.resize(base_.back() + base_.back() / 8);
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    std::copy(chunks_[c].overflow.begin(), chunks_[c].overflow.end(),
              setup_.begin() + static_cast<std::ptrdiff_t>(base_[c]));
  for (Chunk& chunk : chunks_) chunk.overflow = {};
}

std::size_t GeometryStage::bytes() const {
  std::size_t sum = vertices_.capacity() * sizeof(ProjectedVertex) + base_.back() * sizeof(SetupTriangle);
  for (const ChunkBins& chunk : chunk_bins_) sum += chunk.bytes();
  for (const RowBins& row : rows_) sum += row.bytes();
  for (const Scratch& s : scratch_) {
    sum += (s.setup ? setup_per_chunk * (sizeof(SetupTriangle) + sizeof(TouchedBox)) : 0) +
           s.bins.spans.capacity() * sizeof(TileSpan) + s.bins.rows.capacity() * sizeof(std::uint16_t);
  }
  return sum;
}

}  // namespace tessera

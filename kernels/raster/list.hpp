// A tile's list of opaque triangles, drawn by the path that suits each one's size.
#pragma once
#include "kernels/raster/small.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Lists jump through the frame's set-up: what is drawn soon is fetched now.
TESSERA_INLINE void prefetch_setup(const RasterizeArgs& args, std::uint32_t first) {
  constexpr std::uint32_t ahead = 24;
  const std::uint32_t begin = min(std::int64_t{first + ahead}, std::int64_t{args.count});
  const std::uint32_t end = min(std::int64_t{begin + Int::lanes}, std::int64_t{args.count});
  for (std::uint32_t i = begin; i < end; ++i) {
    const SetupTriangle* t = args.triangles + args.list[i];
    __builtin_prefetch(t);
    __builtin_prefetch(reinterpret_cast<const char*>(t + 1) - 1);
  }
}

/// What resolve() reads next of the triangles that are drawn, asked for while they are drawn: their vertices' numbers,
/// and two vectors of triangles later their vertices.
class FetchAhead {
 public:
  TESSERA_INLINE explicit FetchAhead(const GeometryView* geometry) : geometry_(geometry) {}
  TESSERA_INLINE void add(Int triangle) {
    if (geometry_ == nullptr) return;
    if (vectors_ >= distance) fetch_vertices(vectors_ - distance);
    std::int32_t* const recent = recent_[vectors_++ % distance];
    store(recent, triangle);
    for (int i = 0; i < Int::lanes; ++i)
      __builtin_prefetch(geometry_->triangles + static_cast<std::uint32_t>(recent[i]));
  }
  TESSERA_INLINE void finish() const {
    if (geometry_ == nullptr) return;
    for (int v = vectors_ < distance ? 0 : vectors_ - distance; v < vectors_; ++v) fetch_vertices(v);
  }

 private:
  static constexpr int distance = 2;
  TESSERA_INLINE void fetch_vertices(int v) const {
    const GeometryView& g = *geometry_;
    for (int i = 0; i < Int::lanes; ++i) {
      const Triangle& triangle = g.triangles[static_cast<std::uint32_t>(recent_[v % distance][i])];
      for (const std::uint32_t vertex : triangle.vertex) {
        if (g.surfaces != nullptr) {
          fetch(g.surfaces + vertex, sizeof(SurfaceVertex));
        } else {
          fetch(g.positions + std::size_t{3} * vertex, 3 * sizeof(float));
          fetch(g.attributes + vertex, sizeof(VertexAttributes));
        }
      }
    }
  }
  TESSERA_INLINE static void fetch(const void* record, std::size_t bytes) {
    __builtin_prefetch(record);
    __builtin_prefetch(static_cast<const char*>(record) + bytes - 1);
  }

  const GeometryView* geometry_;
  int vectors_ = 0;
  alignas(64) std::int32_t recent_[distance][Int::lanes];
};

/// Draws a tile's triangles, set up a vector at a time.
template <int N, class Counter>
TESSERA_INLINE void rasterize_list(const RasterizeArgs& args, const SamplePattern& pattern, const SampleExtent& extent,
                                   const Counter& counter) {
  const VisibilityTile& tile = args.tile;
  CoarseDepth coarse;
  TileTriangles of_lane;
  SmallTriangles of_small;
  SmallItem items[16 * 16 + Int::lanes];
  FetchAhead fetch_ahead(args.fetch_ahead);
  const bool whole_vectors = tile.width % vector_width == 0 && tile.height % vector_height == 0;
  for (std::uint32_t first = 0; first < args.count; first += std::uint32_t(Int::lanes)) {
    prefetch_setup(args, first);
    const std::uint32_t* list = args.list + first;
    const auto count = static_cast<int>(min(std::int64_t{args.count - first}, std::int64_t{Int::lanes}));
    alignas(64) std::int32_t index[Int::lanes];
    std::uint32_t largest = 0;
    for (int i = 0; i < Int::lanes; ++i) {
      const std::uint32_t k = list[i < count ? i : count - 1];
      index[i] = static_cast<std::int32_t>(k);
      largest = k > largest ? k : largest;
    }
    std::uint32_t left = (1u << count) - 1u, prepared = 0;
    if (largest <= max_gathered_setup) {
      const SetupVector t(args.triangles, load_int<Int>(index));
      BoxVector box(tile, t, extent);
      fetch_ahead.add(t.triangle);
      left &= to_bits(box.some);
      const std::uint32_t small = left & to_bits(box.one_group);
      if (small != 0) {
        left &= ~small;
        const int samples = N > 0 ? N : pattern.count;
        const int found = find_items(tile, t, box, from_mask_bits(small), pattern, samples, of_small, items);
        if (whole_vectors) {
          draw_items<false>(tile, pattern, samples, of_small, items, found, counter);
        } else {
          draw_items<true>(tile, pattern, samples, of_small, items, found, counter);
        }
      }
      prepared = to_bits(box.near);
      if ((left & prepared) != 0) of_lane.set(tile, t, box, pattern, N > 0 ? N : pattern.count);
    }
    for (; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      const SetupTriangle& triangle = args.triangles[list[i]];
      if ((prepared >> i & 1) == 0) {
        const TileBox box = tile_box(tile, triangle, extent);
        if (box.empty()) continue;
        of_lane.set<N>(i, tile, triangle, box, pattern);
      }
      draw_triangle<N>(tile, of_lane, i, pattern, extent, coarse, triangle, counter);
    }
  }
  fetch_ahead.finish();
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// Coverage and depth of opaque triangles in one tile.
#pragma once
#include "kernels/raster/edges.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// A tile is 2 x 8 blocks of 16 x 4 pixels: rows of a block are whole vectors on every instruction set.
inline constexpr int block_width = 16, block_height = 4;
inline constexpr int block_columns = tile_size / block_width, block_rows = tile_size / block_height;
inline constexpr int blocks_per_tile = block_columns * block_rows;
static_assert(blocks_per_tile == 16 && Int::lanes <= 16);

struct BlockMasks {      // bit: row * block_columns + column
  std::uint32_t alive;   // not wholly outside any edge, and touched by the bounding box
  std::uint32_t inside;  // every sample is covered
};

/// Tests all blocks of the tile at once, at the corner samples that are farthest inside and outside of each edge.
TESSERA_INLINE BlockMasks classify_blocks(const TileEdges& edges, const TileBox& box) {
  BlockMasks out{0, 0};
  for (int first = 0; first < blocks_per_tile; first += Int::lanes) {
    const Int index = lane_index() + Int(first);
    const Int x = (index & Int(block_columns - 1)) * Int(block_width), y = (index >> 1) * Int(block_height);
    Mask alive = (x <= Int(box.x1)) & (x >= Int(box.x0 - block_width + 1)) & (y <= Int(box.y1)) &
                 (y >= Int(box.y0 - block_height + 1));
    Mask inside(true);
    for (int e = 0; e < 3; ++e) {
      const std::int32_t a = edges.a[e], b = edges.b[e];
      const Int at_corner = Int(a) * x + Int(b) * y;
      const std::int32_t most = max(a, 0) * (block_width - 1) + max(b, 0) * (block_height - 1) + edges.c_max[e];
      const std::int32_t least = min(a, 0) * (block_width - 1) + min(b, 0) * (block_height - 1) + edges.c_min[e];
      alive &= at_corner + Int(most) >= Int(0);
      inside &= at_corner + Int(least) >= Int(0);
    }
    out.alive |= to_bits(alive) << first;
    out.inside |= to_bits(alive & inside) << first;
  }
  return out;
}

/// For each block a depth that no sample of it lies behind. Only ever too far: drawing brings samples nearer.
struct CoarseDepth {
  float least[blocks_per_tile];

  TESSERA_INLINE CoarseDepth() {
    for (float& depth : least) depth = 0;  // of a cleared tile
  }
  /// Reads the block again.
  TESSERA_INLINE void refresh(const VisibilityTile& tile, int block, int samples) {
    const float* first =
        tile.depth + block / block_columns * block_height * tile_size + block % block_columns * block_width;
    Float nearest = load<Float>(first);
    for (int s = 0; s < samples; ++s)
      for (int y = 0; y < block_height; ++y)
        for (int x = 0; x < block_width; x += Float::lanes)
          nearest = min(nearest, load<Float>(first + s * tile_pixels + y * tile_size + x));
    alignas(64) float lanes[Float::lanes];
    store(lanes, nearest);
    float depth = lanes[0];
    for (const float lane_depth : lanes) depth = lane_depth < depth ? lane_depth : depth;
    least[block] = depth;
  }
};

/// A triangle in a tile, ready for its rows.
struct TriangleInTile {
  const VisibilityTile& tile;
  const SetupTriangle& triangle;
  const SamplePattern& pattern;
  const TileEdges& edges;
  DepthPlane<Float> plane;
  Int lane, lane_a[3];
  Float lane_x;

  TESSERA_INLINE TriangleInTile(const VisibilityTile& v, const SetupTriangle& t, const SamplePattern& p,
                                const TileEdges& e)
      : tile(v), triangle(t), pattern(p), edges(e), plane(t), lane(lane_index()), lane_x(to_float(lane)) {
    for (int k = 0; k < 3; ++k) lane_a[k] = Int(e.a[k]) * lane;
  }

  [[nodiscard]] TESSERA_INLINE Int edge(int e, int x, int y, int s) const {
    return Int(edges.c[e][s] + edges.a[e] * x + edges.b[e] * y) + lane_a[e];
  }
  [[nodiscard]] TESSERA_INLINE Float along_x(int x, int s) const {
    const float first = from_vertex(tile.x << subpixel_bits, x, pattern.x[s], triangle.x[0]);
    return plane.along_x(Float(first) + lane_x);
  }
  [[nodiscard]] TESSERA_INLINE Float depth(Float along, int y, int s) const {
    return plane.at(along, Float(from_vertex(tile.y << subpixel_bits, y, pattern.y[s], triangle.y[0])));
  }
};

/// The triangle's greatest depth in a block. Depth is monotonic along x and along y, rounding included, so that it is
/// that of a corner.
TESSERA_INLINE float greatest_depth(const VisibilityTile& tile, const SetupTriangle& t, const SampleExtent& extent,
                                    int block_x, int block_y) {
  const DepthPlane<float> plane(t);
  const bool right = t.depth_dx > 0, below = t.depth_dy > 0;
  const float x = from_vertex(tile.x << subpixel_bits, block_x + (right ? block_width - 1 : 0),
                              right ? extent.x_max : extent.x_min, t.x[0]);
  const float y = from_vertex(tile.y << subpixel_bits, block_y + (below ? block_height - 1 : 0),
                              below ? extent.y_max : extent.y_min, t.y[0]);
  return plane.at(plane.along_x(x), y);
}

/// Nearer wins; at equal depth the lower triangle index, so that the order of triangles does not matter.
TESSERA_INLINE Mask depth_test(Mask covered, Float depth, Float old_depth, const std::uint32_t* old_triangle,
                               std::uint32_t triangle) {
  const Mask nearer = covered & (depth > old_depth), equal = covered & (depth == old_depth);
  if (none(equal)) return nearer;
  const Int sign(0x80000000u);  // turns a signed comparison into an unsigned one
  const Int old = load_int<Int>(reinterpret_cast<const std::int32_t*>(old_triangle));
  return nearer | (equal & ((Int(triangle) ^ sign) < (old ^ sign)));
}

/// Rows y0 to y1 of one sample plane, as many columns as a vector has lanes from x on.
TESSERA_INLINE void rasterize_rows(const TriangleInTile& t, int x, int y0, int y1, int s, bool inside, bool skip_empty,
                                   RasterCounters& counters) {
  const std::size_t offset = std::size_t(s) * tile_pixels + std::size_t(y0) * tile_size + std::size_t(x);
  float* depth_row = t.tile.depth + offset;
  std::uint32_t* triangle_row = t.tile.triangle + offset;
  const Mask visible = t.lane < Int(t.tile.width - x);
  const Float along = t.along_x(x, s);
  const Int id(t.triangle.triangle), b0(t.edges.b[0]), b1(t.edges.b[1]), b2(t.edges.b[2]);
  Int e0 = t.edge(0, x, y0, s), e1 = t.edge(1, x, y0, s), e2 = t.edge(2, x, y0, s);
  for (int y = y0; y <= y1; ++y) {
    const Mask covered = inside ? visible : visible & ((e0 | e1 | e2) >= Int(0));
    e0 += b0;
    e1 += b1;
    e2 += b2;
    if (!skip_empty || any(covered)) {
      const Float depth = t.depth(along, y, s), old_depth = load<Float>(depth_row);
      const Mask pass = depth_test(covered, depth, old_depth, triangle_row, t.triangle.triangle);
      auto* ids = reinterpret_cast<std::int32_t*>(triangle_row);
      store(depth_row, select(pass, depth, old_depth));
      store(ids, select(pass, id, load_int<Int>(ids)));
      counters.samples_tested += std::uint64_t(__builtin_popcount(to_bits(covered)));
      counters.samples_passed += std::uint64_t(__builtin_popcount(to_bits(pass)));
    }
    depth_row += tile_size;
    triangle_row += tile_size;
  }
}

/// Triangles whose bounding box is at most this large skip the blocks. Not a matter of lanes: blocks_rejected is the
/// same everywhere.
inline constexpr int small_width = 16, small_height = 8;
/// Whether a test for empty rows costs less than drawing them: where mul_add is emulated.
inline constexpr bool skip_empty_rows = Float::lanes == 4;

/// N: the number of samples where it is known at compile time, else 0.
template <int N>
TESSERA_INLINE void rasterize_triangle(const VisibilityTile& tile, const SetupTriangle& triangle,
                                       const SamplePattern& pattern, const SampleExtent& extent, CoarseDepth& coarse,
                                       RasterCounters& counters) {
  const int samples = N > 0 ? N : pattern.count;
  const TileBox box = tile_box(tile, triangle, extent);
  if (box.empty()) return;
  TileEdges edges;
  make_edges<N>(tile, triangle, pattern, edges);
  const TriangleInTile t(tile, triangle, pattern, edges);
  if (box.x1 - box.x0 < small_width && box.y1 - box.y0 < small_height) {
    for (int s = 0; s < samples; ++s) {
      // Aligned columns: a load that finds the store of the triangle before it at the same place is fast.
      for (int x = box.x0 & -Float::lanes; x <= box.x1; x += Float::lanes) {
        rasterize_rows(t, x, box.y0, box.y1, s, false, skip_empty_rows, counters);
      }
    }
    return;
  }
  const BlockMasks blocks = classify_blocks(edges, box);
  const int columns = box.x1 / block_width - box.x0 / block_width + 1;
  const int rows = box.y1 / block_height - box.y0 / block_height + 1;
  counters.blocks_rejected += std::uint64_t(columns * rows - __builtin_popcount(blocks.alive));
  for (std::uint32_t left = blocks.alive; left != 0; left &= left - 1) {
    const int block = __builtin_ctz(left);
    const bool inside = (blocks.inside >> block & 1) != 0;
    const int block_x = block % block_columns * block_width, block_y = block / block_columns * block_height;
    if (greatest_depth(tile, triangle, extent, block_x, block_y) < coarse.least[block]) continue;  // hidden
    const int y0 = max(block_y, box.y0), y1 = min(block_y + block_height - 1, box.y1);
    const int x_last = min(block_x + block_width - 1, box.x1);
    for (int s = 0; s < samples; ++s) {
      for (int x = block_x; x <= x_last; x += Float::lanes) {
        if (inside) {
          rasterize_rows(t, x, y0, y1, s, true, false, counters);
        } else {
          rasterize_rows(t, x, y0, y1, s, false, true, counters);
        }
      }
    }
    if (inside) coarse.refresh(tile, block, samples);
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

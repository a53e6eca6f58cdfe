// Which pixels of a tile a triangle covers, at what depth.
#pragma once
#include "kernels/raster/edges.hpp"
#include "kernels/raster/setup_lanes.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// A vector is 4 x 4, 4 x 2 or 4 x 1 pixels of the tile (tile_pixel()).
inline constexpr int vector_width = 4, vector_height = Float::lanes / vector_width;
TESSERA_INLINE Int lane_column() { return lane_index() & Int(vector_width - 1); }
TESSERA_INLINE Int lane_row() { return lane_index() >> 2; }

// A tile is 2 x 8 blocks of 16 x 4 pixels, each one after another in memory.
inline constexpr int block_width = 16, block_height = 4, block_pixels = block_width * block_height;
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

/// A triangle in a tile, ready for its vectors. Positions are those of a vector's first pixel, in the tile.
struct TriangleInTile {
  const VisibilityTile& tile;
  const SetupTriangle& triangle;
  const SamplePattern& pattern;
  const TileEdges& edges;
  DepthPlane<Float> plane;
  Int column, row, lane_edge[3];
  Float lane_x, lane_y;

  TESSERA_INLINE TriangleInTile(const VisibilityTile& v, const SetupTriangle& t, const SamplePattern& p,
                                const TileEdges& e)
      : tile(v),
        triangle(t),
        pattern(p),
        edges(e),
        plane(t),
        column(lane_column()),
        row(lane_row()),
        lane_x(to_float(column)),
        lane_y(to_float(row)) {
    for (int k = 0; k < 3; ++k) lane_edge[k] = Int(e.a[k]) * column + Int(e.b[k]) * row;
  }

  /// Lanes within the visible part of the tile.
  [[nodiscard]] TESSERA_INLINE Mask visible(int x, int y) const {
    return (column < Int(tile.width - x)) & (row < Int(tile.height - y));
  }
  [[nodiscard]] TESSERA_INLINE Int edge(int e, int x, int y, int s) const {
    return Int(edges.c[e][s] + edges.a[e] * x + edges.b[e] * y) + lane_edge[e];
  }
  [[nodiscard]] TESSERA_INLINE Mask covered(int x, int y, int s) const {
    return (edge(0, x, y, s) | edge(1, x, y, s) | edge(2, x, y, s)) >= Int(0);
  }
  [[nodiscard]] TESSERA_INLINE Float depth(int x, int y, int s) const {
    const float first_x = from_vertex(tile.x << subpixel_bits, x, pattern.x[s], triangle.x[0]);
    const float first_y = from_vertex(tile.y << subpixel_bits, y, pattern.y[s], triangle.y[0]);
    return plane.at(plane.along_x(Float(first_x) + lane_x), Float(first_y) + lane_y);
  }
};

/// Nearer wins; at equal depth the lower triangle index, so that the order of triangles does not matter.
TESSERA_INLINE Mask depth_test(Mask covered, Float depth, Float old_depth, const std::uint32_t* old_triangle,
                               std::uint32_t triangle) {
  const Mask nearer = covered & (depth > old_depth), equal = covered & (depth == old_depth);
  if (none(equal)) return nearer;
  const Int sign(0x80000000u);  // turns a signed comparison into an unsigned one
  const Int old = load_int<Int>(reinterpret_cast<const std::int32_t*>(old_triangle));
  return nearer | (equal & ((Int(triangle) ^ sign) < (old ^ sign)));
}

/// Whether a test for empty vectors costs less than drawing them: where mul_add is emulated.
inline constexpr bool skip_empty_vectors = Float::lanes == 4;

}  // namespace
}  // namespace tessera::TESSERA_ISA

// A vector of set-up triangles, one per lane, and where they lie in a tile.
#pragma once
#include "kernels/raster/edges.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Edges at most this long keep edge functions near the bounding box below 2^31, in units of (1/256 pixel)^2.
inline constexpr std::int32_t small_extent_in_tile = 1 << 14;
/// Kernels gather set-up with signed 32-bit offsets.
inline constexpr std::uint32_t max_gathered_setup = (1u << 31) / (sizeof(SetupTriangle) / sizeof(float)) - 1;

/// A vector's lanes in memory, to be read one by one.
template <class T>
struct alignas(64) LaneArray {
  T lane[Int::lanes];
};

/// A vector of SetupTriangle.
struct SetupVector {
  Int x[3], y[3];
  Float depth, depth_dx, depth_dy, depth_min, depth_max;
  Int triangle;

  TESSERA_INLINE SetupVector(const SetupTriangle* triangles, Int index) {
    static_assert(offsetof(SetupTriangle, depth) == 6 * sizeof(float) && sizeof(SetupTriangle) == 12 * sizeof(float));
    Float word[12];
    gather_quads(reinterpret_cast<const float*>(triangles), index * Int(12), word);
    for (int i = 0; i < 3; ++i) {
      x[i] = bits(word[i]);
      y[i] = bits(word[3 + i]);
    }
    depth = word[6], depth_dx = word[7], depth_dy = word[8], depth_min = word[9], depth_max = word[10];
    triangle = bits(word[11]);
  }
};

struct BoxVector {  // as TileBox
  Int x0, x1, y0, y1;
  Mask some, near, one_group;  // near: not huge; one_group: within 4 x 4 blocks of 4 x 4 pixels

  TESSERA_INLINE BoxVector(const VisibilityTile& tile, const SetupVector& t, const SampleExtent& extent) {
    const Int left(tile.x << subpixel_bits), top(tile.y << subpixel_bits);
    const Int x_min = min(min(t.x[0], t.x[1]), t.x[2]), x_max = max(max(t.x[0], t.x[1]), t.x[2]);
    const Int y_min = min(min(t.y[0], t.y[1]), t.y[2]), y_max = max(max(t.y[0], t.y[1]), t.y[2]);
    x0 = max((x_min - left + Int(255 - extent.x_max)) >> subpixel_bits, Int(0));
    x1 = min((x_max - left - Int(extent.x_min + 1)) >> subpixel_bits, Int(tile.width - 1));
    y0 = max((y_min - top + Int(255 - extent.y_max)) >> subpixel_bits, Int(0));
    y1 = min((y_max - top - Int(extent.y_min + 1)) >> subpixel_bits, Int(tile.height - 1));
    some = (x0 <= x1) & (y0 <= y1);
    near = some & (x_max - x_min < Int(small_extent_in_tile)) & (y_max - y_min < Int(small_extent_in_tile));
    one_group = near & ((x1 >> 2) - (x0 >> 2) < Int(4)) & ((y1 >> 2) - (y0 >> 2) < Int(4));
  }
};

/// tile_pixel()
TESSERA_INLINE Int pixel_number(Int x, Int y) {
  return ((y & Int(28)) << 5) + ((x & Int(28)) << 2) + ((y & Int(3)) << 2) + (x & Int(3));
}

/// One edge of each lane's triangle (edges.hpp), in (1/256 pixel)^2.
struct LaneEdge {
  Int a, b, at_corner;  // at_corner: its function at a point of the frame near the bounding box

  TESSERA_INLINE LaneEdge(const SetupVector& t, int e, Int corner_x, Int corner_y) {
    const int next = e == 2 ? 0 : e + 1;
    a = t.y[next] - t.y[e];
    b = t.x[e] - t.x[next];
    const Mask top_left = (a > Int(0)) | ((a == Int(0)) & (b > Int(0)));
    at_corner = a * (corner_x - t.x[e]) + b * (corner_y - t.y[e]) - select(top_left, Int(0), Int(1));
  }
};

}  // namespace
}  // namespace tessera::TESSERA_ISA

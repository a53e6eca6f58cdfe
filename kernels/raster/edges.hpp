// The exact edge functions of a triangle inside one tile, and its depth.
//
// Coordinates are integers, 1/256 pixel; x to the right, y down. For the edge from vertex i to j of a triangle of
// positive area,
//     E(p) = a px + b py + c,   a = yj - yi,   b = xi - xj,   c = -(a xi + b yi)
// is positive on the inner side. Top-left rule: a sample on the edge belongs to the triangle whose interior lies right
// of it (a > 0) or, on a level edge, below it (a = 0, b > 0); for other edges 1 is subtracted from c. So a sample is
// covered where E >= 0 for all three.
//
// Sample s of the tile's pixel (i, j) is at p = 256 (i, j) + (sx, sy) from the tile's corner, and because 256 divides
// the pixel's part, the sign of E is that of
//     floor(E / 256) = a i + b j + C_s,   C_s = floor((a sx + b sy + c) / 256),
// c taken relative to the tile's corner. |a|, |b| <= 3 * 2^22 (the guard band), so |a i + b j| <= 31 (|a| + |b|) <
// 2^30 in the tile; clamping C_s to +-2^30 keeps every sign, and every sum below 2^30 + 32 (|a| + |b|) < 2^31.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

struct TileEdges {
  std::int32_t a[3], b[3];
  std::int32_t c[3][max_samples];   // C_s
  std::int32_t c_min[3], c_max[3];  // over the samples
};

/// N: the number of samples where it is known at compile time, else 0.
template <int N = 0>
TESSERA_INLINE void make_edges(const VisibilityTile& tile, const SetupTriangle& t, const SamplePattern& pattern,
                               TileEdges& out) {
  const int samples = N > 0 ? N : pattern.count;
  constexpr std::int64_t limit = 1 << 30;
  const std::int32_t left = tile.x << subpixel_bits, top = tile.y << subpixel_bits;
  for (int e = 0; e < 3; ++e) {
    const int next = e == 2 ? 0 : e + 1;
    const std::int32_t a = t.y[next] - t.y[e], b = t.x[e] - t.x[next];
    const bool top_left = a > 0 || (a == 0 && b > 0);
    const std::int64_t c = std::int64_t(a) * (left - t.x[e]) + std::int64_t(b) * (top - t.y[e]) - (top_left ? 0 : 1);
    out.a[e] = a;
    out.b[e] = b;
    std::int32_t c_min = limit, c_max = -limit;
    for (int s = 0; s < samples; ++s) {
      const std::int64_t exact = (c + std::int64_t(a) * pattern.x[s] + std::int64_t(b) * pattern.y[s]) >> subpixel_bits;
      const auto clamped = static_cast<std::int32_t>(min(max(exact, -limit), limit));
      out.c[e][s] = clamped;
      c_min = min(c_min, clamped);
      c_max = max(c_max, clamped);
    }
    out.c_min[e] = c_min;
    out.c_max[e] = c_max;
  }
}

struct SampleExtent {
  std::int32_t x_min, x_max, y_min, y_max;
};

inline SampleExtent sample_extent(const SamplePattern& pattern) {
  SampleExtent e{pattern.x[0], pattern.x[0], pattern.y[0], pattern.y[0]};
  for (int s = 1; s < pattern.count; ++s) {
    e.x_min = min(e.x_min, pattern.x[s]);
    e.x_max = max(e.x_max, pattern.x[s]);
    e.y_min = min(e.y_min, pattern.y[s]);
    e.y_max = max(e.y_max, pattern.y[s]);
  }
  return e;
}

struct TileBox {  // pixels of the tile, both ends included; empty if an end lies before its beginning
  int x0, x1, y0, y1;
  [[nodiscard]] bool empty() const { return x0 > x1 || y0 > y1; }
};

/// The visible pixels that have a sample within the triangle's bounding box.
TESSERA_INLINE TileBox tile_box(const VisibilityTile& tile, const SetupTriangle& t, const SampleExtent& extent) {
  const std::int32_t left = tile.x << subpixel_bits, top = tile.y << subpixel_bits;
  const std::int32_t x_min = min(min(t.x[0], t.x[1]), t.x[2]) - left, x_max = max(max(t.x[0], t.x[1]), t.x[2]) - left;
  const std::int32_t y_min = min(min(t.y[0], t.y[1]), t.y[2]) - top, y_max = max(max(t.y[0], t.y[1]), t.y[2]) - top;
  return {max((x_min - extent.x_max + 255) >> subpixel_bits, 0),
          min((x_max - extent.x_min - 1) >> subpixel_bits, tile.width - 1),
          max((y_min - extent.y_max + 255) >> subpixel_bits, 0),
          min((y_max - extent.y_min - 1) >> subpixel_bits, tile.height - 1)};
}

/// Depth of a triangle at a sample, the same formula wherever it is asked for: depth + dx (x - x0), fused, then
/// + dy (y - y0), fused, then clamped to the range of the vertices. x - x0 is an integer below 2^24 over 256, so it is
/// exact and does not depend on the tile.
template <class F>
struct DepthPlane {
  F depth, dx, dy, low, high;

  TESSERA_INLINE explicit DepthPlane(const SetupTriangle& t)
      : depth(t.depth), dx(t.depth_dx), dy(t.depth_dy), low(t.depth_min), high(t.depth_max) {}
  [[nodiscard]] TESSERA_INLINE F along_x(F x) const { return mul_add(dx, x, depth); }
  [[nodiscard]] TESSERA_INLINE F at(F along, F y) const { return clamp(mul_add(dy, y, along), low, high); }
};

/// Distance in pixels of a sample from vertex 0: tile corner and vertex in 1/256 pixel, pixel inside the tile.
TESSERA_INLINE float from_vertex(std::int32_t corner, int pixel, std::int32_t sample, std::int32_t vertex) {
  return float(corner + (pixel << subpixel_bits) + sample - vertex) * (1.0f / 256);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

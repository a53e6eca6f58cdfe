// Triangles of a few pixels under many samples: a vector of triangles at a time, one per lane, instead of a vector of
// pixels of one triangle.
#pragma once
#include "kernels/raster/setup_lanes.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Depth and triangle of the covered lanes' samples, one after another: two lanes may see the same sample.
template <class Counter>
TESSERA_INLINE void draw_lanes(float* depth_plane, std::uint32_t* triangle_plane, std::uint32_t covered, Float depth,
                               Int pixel, const SetupTriangle* triangles, const std::uint32_t* list,
                               const Counter& counter) {
  alignas(64) float depths[Float::lanes];
  alignas(64) std::int32_t pixels[Int::lanes];
  store(depths, depth);
  store(pixels, pixel);
  std::uint32_t passed = 0;
  const std::uint32_t tested = covered;
  for (; covered != 0; covered &= covered - 1) {
    const int i = __builtin_ctz(covered);
    float& old_depth = depth_plane[pixels[i]];
    std::uint32_t& old_triangle = triangle_plane[pixels[i]];
    const std::uint32_t triangle = triangles[list[i]].triangle;
    if (depths[i] > old_depth || (depths[i] == old_depth && triangle < old_triangle)) {
      old_depth = depths[i];
      old_triangle = triangle;
      passed |= 1u << i;
    }
  }
  counter.add(from_mask_bits(tested), from_mask_bits(passed));
}

/// Every lane walks over its own bounding box: covered where its three edge functions (edges.hpp, here in units of
/// (1/256 pixel)^2) are not negative.
template <class Counter>
TESSERA_INLINE void rasterize_tiny(const VisibilityTile& tile, const SetupVector& t, const BoxVector& box,
                                   const SamplePattern& pattern, const SetupTriangle* triangles,
                                   const std::uint32_t* list, const Counter& counter) {
  Int a[3], b[3], at_corner[3];  // at_corner: of the pixel's corner (x0, y0)
  const Int corner_x = (box.x0 << subpixel_bits) + Int(tile.x << subpixel_bits);
  const Int corner_y = (box.y0 << subpixel_bits) + Int(tile.y << subpixel_bits);
  for (int e = 0; e < 3; ++e) {
    const LaneEdge edge(t, e, corner_x, corner_y);
    a[e] = edge.a;
    b[e] = edge.b;
    at_corner[e] = edge.at_corner;
  }
  const Int columns = box.x1 - box.x0, rows = box.y1 - box.y0;
  for (int s = 0; s < pattern.count; ++s) {
    const Int x = corner_x - t.x[0] + Int(pattern.x[s]), y = corner_y - t.y[0] + Int(pattern.y[s]);
    Int row_edge[3];
    for (int e = 0; e < 3; ++e) row_edge[e] = at_corner[e] + a[e] * Int(pattern.x[s]) + b[e] * Int(pattern.y[s]);
    float* depth_plane = tile.depth + s * tile_pixels;
    std::uint32_t* triangle_plane = tile.triangle + s * tile_pixels;
    Mask in_row = box.tiny;
    for (int dy = 0; any(in_row); ++dy) {
      Int edge[3] = {row_edge[0], row_edge[1], row_edge[2]};
      const Float from_y = to_float(y + Int(dy << subpixel_bits)) * Float(1.0f / 256);
      Mask here = in_row;
      for (int dx = 0; any(here); ++dx) {
        const std::uint32_t covered = to_bits(here & ((edge[0] | edge[1] | edge[2]) >= Int(0)));
        if (covered != 0) {
          // As DepthPlane.
          const Float from_x = to_float(x + Int(dx << subpixel_bits)) * Float(1.0f / 256);
          const Float depth =
              clamp(mul_add(t.depth_dy, from_y, mul_add(t.depth_dx, from_x, t.depth)), t.depth_min, t.depth_max);
          draw_lanes(depth_plane, triangle_plane, covered, depth, pixel_number(box.x0 + Int(dx), box.y0 + Int(dy)),
                     triangles, list, counter);
        }
        for (int e = 0; e < 3; ++e) edge[e] += a[e] << subpixel_bits;
        here &= columns > Int(dx);
      }
      for (int e = 0; e < 3; ++e) row_edge[e] += b[e] << subpixel_bits;
      in_row &= rows > Int(dy);
    }
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

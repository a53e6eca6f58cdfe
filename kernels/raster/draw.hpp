// Opaque triangles, ready to be drawn: groups of 4 x 4 blocks at a time, a lane per block to find out which ones the
// triangle meets, and those in vectors of pixels.
#pragma once
#include "kernels/raster/coarse_depth.hpp"
#include "kernels/raster/setup_lanes.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// What RasterCounters asks for, or nothing.
struct CountSamples {
  RasterCounters& sum;
  TESSERA_INLINE void add(Mask tested, Mask passed) const {
    sum.samples_tested += std::uint64_t(__builtin_popcount(to_bits(tested)));
    sum.samples_passed += std::uint64_t(__builtin_popcount(to_bits(passed)));
  }
};
struct CountNothing {
  TESSERA_INLINE void add(Mask, Mask) const {}
};

inline constexpr int group_size = 16;  // pixels along the side of 4 x 4 blocks

/// Set-up in one tile of as many triangles as a vector has lanes.
struct TileTriangles {
  // Pixels of the tile. The first group begins at (x0, y0), which is aligned to blocks of 4 x 4, and if the bounding
  // box is larger than a group, to groups.
  LaneArray<std::int32_t> x0, y0, x1, y1;
  LaneArray<std::int32_t> a[3], b[3];         // as in TileEdges
  LaneArray<std::int32_t> c[max_samples][3];  // at pixel (x0, y0)
  LaneArray<std::int32_t> most[3], least[3];  // of an edge function within a block, beyond its first pixel's
  LaneArray<float> from_x, from_y;            // of that pixel's corner, from vertex 0, in pixels
  LaneArray<float> depth, depth_dx, depth_dy, depth_min, depth_max;
  LaneArray<std::int32_t> triangle;

  /// Lanes of box.near.
  TESSERA_INLINE void set(const VisibilityTile& tile, const SetupVector& t, const BoxVector& box,
                          const SamplePattern& pattern, int samples) {
    const Int mask = select(box.one_group, Int(-vector_width), Int(-group_size));
    const Int first_x = box.x0 & mask, first_y = box.y0 & mask;
    store(x0.lane, first_x);
    store(y0.lane, first_y);
    store(x1.lane, box.x1);
    store(y1.lane, box.y1);
    const Int corner_x = (first_x << subpixel_bits) + Int(tile.x << subpixel_bits);
    const Int corner_y = (first_y << subpixel_bits) + Int(tile.y << subpixel_bits);
    for (int e = 0; e < 3; ++e) {
      const LaneEdge edge(t, e, corner_x, corner_y);
      const Int across = edge.a * Int(vector_width - 1), down = edge.b * Int(vector_width - 1);
      store(a[e].lane, edge.a);
      store(b[e].lane, edge.b);
      store(most[e].lane, max(across, Int(0)) + max(down, Int(0)));
      store(least[e].lane, min(across, Int(0)) + min(down, Int(0)));
      for (int s = 0; s < samples; ++s)
        store(c[s][e].lane,
              (edge.at_corner + edge.a * Int(pattern.x[s]) + edge.b * Int(pattern.y[s])) >> subpixel_bits);
    }
    store(from_x.lane, to_float(corner_x - t.x[0]) * Float(1.0f / 256));
    store(from_y.lane, to_float(corner_y - t.y[0]) * Float(1.0f / 256));
    store(depth.lane, t.depth);
    store(depth_dx.lane, t.depth_dx);
    store(depth_dy.lane, t.depth_dy);
    store(depth_min.lane, t.depth_min);
    store(depth_max.lane, t.depth_max);
    store(triangle.lane, t.triangle);
  }

  /// Lane i, from a triangle of any size.
  template <int N>
  TESSERA_INLINE void set(int i, const VisibilityTile& tile, const SetupTriangle& t, const TileBox& box,
                          const SamplePattern& pattern) {
    TileEdges edges;
    make_edges<N>(tile, t, pattern, edges);
    const int first_x = box.x0 & -group_size, first_y = box.y0 & -group_size;
    x0.lane[i] = first_x, y0.lane[i] = first_y, x1.lane[i] = box.x1, y1.lane[i] = box.y1;
    for (int e = 0; e < 3; ++e) {
      const std::int32_t across = edges.a[e] * (vector_width - 1), down = edges.b[e] * (vector_width - 1);
      a[e].lane[i] = edges.a[e];
      b[e].lane[i] = edges.b[e];
      most[e].lane[i] = max(across, 0) + max(down, 0);
      least[e].lane[i] = min(across, 0) + min(down, 0);
      for (int s = 0; s < (N > 0 ? N : pattern.count); ++s)
        c[s][e].lane[i] = edges.c[e][s] + edges.a[e] * first_x + edges.b[e] * first_y;
    }
    from_x.lane[i] = from_vertex(tile.x << subpixel_bits, first_x, 0, t.x[0]);
    from_y.lane[i] = from_vertex(tile.y << subpixel_bits, first_y, 0, t.y[0]);
    depth.lane[i] = t.depth, depth_dx.lane[i] = t.depth_dx, depth_dy.lane[i] = t.depth_dy;
    depth_min.lane[i] = t.depth_min, depth_max.lane[i] = t.depth_max;
    triangle.lane[i] = static_cast<std::int32_t>(t.triangle);
  }
};

/// Where the blocks of a group begin, in pixels.
alignas(64) inline constexpr float block_x[16] = {0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12};
alignas(64) inline constexpr float block_y[16] = {0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12};

/// Depth and triangle of one sample of a vector of pixels, the first of which is `pixel`.
template <class Counter>
TESSERA_INLINE void draw_vector(const VisibilityTile& tile, int s, int pixel, Mask covered, Float depth,
                                std::uint32_t triangle, const Counter& counter) {
  float* const depths = tile.depth + s * tile_pixels + pixel;
  std::uint32_t* const triangles = tile.triangle + s * tile_pixels + pixel;
  auto* const ids = reinterpret_cast<std::int32_t*>(triangles);
  const Float old_depth = load<Float>(depths);
  const Mask pass = depth_test(covered, depth, old_depth, triangles, triangle);
  store(depths, select(pass, depth, old_depth));
  store(ids, select(pass, Int(triangle), load_int<Int>(ids)));
  counter.add(covered, pass);
}

/// Bit k: block k of a group lies before (or at) the end of the bounding box. right, below: pixels from the group's
/// first one to the end, not negative.
TESSERA_INLINE std::uint32_t blocks_before(int right, int below) {
  const int columns = min(right >> 2, 3), rows = min(below >> 2, 3);
  return ((2u << columns) - 1u) * (0x1111u & ((16u << (4 * rows)) - 1u));
}

/// Draws triangle i of t.
template <int N, class Counter>
TESSERA_INLINE void draw_triangle(const VisibilityTile& tile, const TileTriangles& t, int i,
                                  const SamplePattern& pattern, const SampleExtent& extent, CoarseDepth& coarse,
                                  const SetupTriangle& setup, const Counter& counter) {
  const int samples = N > 0 ? N : pattern.count;
  const bool whole = tile.width == tile_size && tile.height == tile_size;
  const Int column = lane_column(), row = lane_row();
  Int b[3], lane_edge[3], most[3], least[3];
  for (int e = 0; e < 3; ++e) {
    b[e] = Int(t.b[e].lane[i]);
    lane_edge[e] = Int(t.a[e].lane[i]) * column + b[e] * row;
    most[e] = Int(t.most[e].lane[i]);
    least[e] = Int(t.least[e].lane[i]);
  }
  const Float depth(t.depth.lane[i]), dx(t.depth_dx.lane[i]), dy(t.depth_dy.lane[i]);
  const Float low(t.depth_min.lane[i]), high(t.depth_max.lane[i]);
  const auto triangle = static_cast<std::uint32_t>(t.triangle.lane[i]);
  const int x0 = t.x0.lane[i], x1 = t.x1.lane[i], y0 = t.y0.lane[i], y1 = t.y1.lane[i];
  const bool many = x1 - x0 >= group_size || y1 - y0 >= group_size;  // then groups are aligned
  for (int group_y = y0; group_y <= y1; group_y += group_size)
    for (int group_x = x0; group_x <= x1; group_x += group_size) {
      std::uint32_t wanted = blocks_before(x1 - group_x, y1 - group_y);
      if (many) wanted &= ~coarse.hidden(tile, setup, extent, group_x, group_y);
      if (wanted == 0) continue;
      std::uint32_t filled = 0xffff;  // by every sample
      for (int s = 0; s < samples; ++s) {
        alignas(64) std::int32_t at_block[3][16];  // edge functions at the blocks' first pixels
        Int first[3];
        for (int e = 0; e < 3; ++e)
          first[e] = Int(t.c[s][e].lane[i] + t.a[e].lane[i] * (group_x - x0) + t.b[e].lane[i] * (group_y - y0)) +
                     (lane_edge[e] << 2);
        std::uint32_t alive = 0, inside = 0;
        for (int k = 0; k < 16; k += Int::lanes) {
          Int meets(0), fills(0);
          for (int e = 0; e < 3; ++e) {
            const Int edge = k == 0 ? first[e] : first[e] + b[e] * Int(k);
            store(at_block[e] + k, edge);
            meets |= edge + most[e];
            fills |= edge + least[e];
          }
          alive |= to_bits(meets >= Int(0)) << k;
          inside |= to_bits(fills >= Int(0)) << k;
        }
        filled &= inside;
        const Float from_x = Float(t.from_x.lane[i] + float(pattern.x[s]) * (1.0f / 256)) + to_float(column);
        const Float from_y = Float(t.from_y.lane[i] + float(pattern.y[s]) * (1.0f / 256)) + to_float(row);
        const int group = tile_pixel(group_x, group_y);
        for (std::uint32_t left = alive & wanted; left != 0; left &= left - 1) {
          const int k = __builtin_ctz(left);
          const int pixel = group + (k >> 2) * 128 + (k & 3) * 16;
          // Distances are multiples of 1/256 below 2^16: their sums are exact, as from_vertex() is.
          const Float x = from_x + Float(block_x[k] + float(group_x - x0));
          const Float along = mul_add(dx, x, depth);
          for (int v = 0; v < 4; v += vector_height) {
            Int edge(0);
            for (int e = 0; e < 3; ++e)
              edge |= Int(at_block[e][k]) + (v == 0 ? lane_edge[e] : lane_edge[e] + b[e] * Int(v));
            Mask covered = edge >= Int(0);
            if (!whole)
              covered &= (column < Int(tile.width - group_x - (k & 3) * 4)) &
                         (row < Int(tile.height - group_y - (k >> 2) * 4 - v));
            if (skip_empty_vectors && none(covered)) continue;
            const Float y = from_y + Float(block_y[k] + float(group_y - y0 + v));
            // As DepthPlane.
            const Float z = clamp(mul_add(dy, y, along), low, high);
            draw_vector(tile, s, pixel + v * 4, covered, z, triangle, counter);
          }
        }
      }
      if (many) coarse.refresh(tile, group_x, group_y, filled & wanted, samples);
    }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// Triangles of a few pixels, which most of a fine mesh are: a vector of triangles at a time, one per lane, instead of a
// vector of pixels of one triangle.
#pragma once
#include "kernels/raster/coverage.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Pixels along each side of the bounding box, at most.
inline constexpr int tiny_size = 4;
/// Edges at most this long keep a b + b a of the edge functions near the box below 2^31.
inline constexpr std::int32_t tiny_extent = 1 << 14;
/// Kernels gather set-up with signed 32-bit offsets.
inline constexpr std::uint32_t max_gathered_setup = (1u << 31) / (sizeof(SetupTriangle) / sizeof(float)) - 1;

/// A vector of SetupTriangle.
struct SetupVector {
  Int x[3], y[3];
  Float depth, depth_dx, depth_dy, depth_min, depth_max;

  TESSERA_INLINE SetupVector(const SetupTriangle* triangles, Int index) {
    static_assert(offsetof(SetupTriangle, depth) == 6 * sizeof(float) && sizeof(SetupTriangle) == 12 * sizeof(float));
    Float word[12];
    gather_quads(reinterpret_cast<const float*>(triangles), index * Int(12), word);
    for (int i = 0; i < 3; ++i) {
      x[i] = bits(word[i]);
      y[i] = bits(word[3 + i]);
    }
    depth = word[6], depth_dx = word[7], depth_dy = word[8], depth_min = word[9], depth_max = word[10];
  }
};

struct BoxVector {  // as TileBox
  Int x0, x1, y0, y1;
  Mask some, tiny;

  TESSERA_INLINE BoxVector(const VisibilityTile& tile, const SetupVector& t, const SampleExtent& extent) {
    const Int left(tile.x << subpixel_bits), top(tile.y << subpixel_bits);
    const Int x_min = min(min(t.x[0], t.x[1]), t.x[2]), x_max = max(max(t.x[0], t.x[1]), t.x[2]);
    const Int y_min = min(min(t.y[0], t.y[1]), t.y[2]), y_max = max(max(t.y[0], t.y[1]), t.y[2]);
    x0 = max((x_min - left + Int(255 - extent.x_max)) >> subpixel_bits, Int(0));
    x1 = min((x_max - left - Int(extent.x_min + 1)) >> subpixel_bits, Int(tile.width - 1));
    y0 = max((y_min - top + Int(255 - extent.y_max)) >> subpixel_bits, Int(0));
    y1 = min((y_max - top - Int(extent.y_min + 1)) >> subpixel_bits, Int(tile.height - 1));
    some = (x0 <= x1) & (y0 <= y1);
    tiny = some & (x1 - x0 < Int(tiny_size)) & (y1 - y0 < Int(tiny_size)) & (x_max - x_min < Int(tiny_extent)) &
           (y_max - y_min < Int(tiny_extent));
  }
};

/// Depth and triangle of the covered lanes' samples, one after another: two lanes may see the same sample.
TESSERA_INLINE void draw_lanes(float* depth_plane, std::uint32_t* triangle_plane, std::uint32_t covered, Float depth,
                               Int pixel, const SetupTriangle* triangles, const std::uint32_t* list,
                               RasterCounters& counters) {
  alignas(64) float depths[Float::lanes];
  alignas(64) std::int32_t pixels[Int::lanes];
  store(depths, depth);
  store(pixels, pixel);
  counters.samples_tested += std::uint64_t(__builtin_popcount(covered));
  for (; covered != 0; covered &= covered - 1) {
    const int i = __builtin_ctz(covered);
    float& old_depth = depth_plane[pixels[i]];
    std::uint32_t& old_triangle = triangle_plane[pixels[i]];
    const std::uint32_t triangle = triangles[list[i]].triangle;
    if (depths[i] > old_depth || (depths[i] == old_depth && triangle < old_triangle)) {
      old_depth = depths[i];
      old_triangle = triangle;
      ++counters.samples_passed;
    }
  }
}

/// Every lane walks over its own bounding box: covered where its three edge functions (edges.hpp, here in units of
/// (1/256 pixel)^2) are not negative.
TESSERA_INLINE void rasterize_tiny(const VisibilityTile& tile, const SetupVector& t, const BoxVector& box,
                                   const SamplePattern& pattern, int samples, const SetupTriangle* triangles,
                                   const std::uint32_t* list, RasterCounters& counters) {
  Int a[3], b[3], at_corner[3];  // at_corner: of the pixel's corner (x0, y0)
  const Int corner_x = (box.x0 << subpixel_bits) + Int(tile.x << subpixel_bits);
  const Int corner_y = (box.y0 << subpixel_bits) + Int(tile.y << subpixel_bits);
  for (int e = 0; e < 3; ++e) {
    const int next = e == 2 ? 0 : e + 1;
    a[e] = t.y[next] - t.y[e];
    b[e] = t.x[e] - t.x[next];
    const Mask top_left = (a[e] > Int(0)) | ((a[e] == Int(0)) & (b[e] > Int(0)));
    at_corner[e] = a[e] * (corner_x - t.x[e]) + b[e] * (corner_y - t.y[e]) - select(top_left, Int(0), Int(1));
  }
  const Int columns = box.x1 - box.x0, rows = box.y1 - box.y0;
  const Int first_pixel = (box.y0 << 5) + box.x0;
  static_assert(tile_size == 1 << 5);
  for (int s = 0; s < samples; ++s) {
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
          draw_lanes(depth_plane, triangle_plane, covered, depth, first_pixel + Int(dy * tile_size + dx), triangles,
                     list, counters);
        }
        for (int e = 0; e < 3; ++e) edge[e] += a[e] << subpixel_bits;
        here &= columns > Int(dx);
      }
      for (int e = 0; e < 3; ++e) row_edge[e] += b[e] << subpixel_bits;
      in_row &= rows > Int(dy);
    }
  }
}

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

/// A list of triangles, a vector at a time: tiny ones together, the others one by one.
template <int N>
TESSERA_INLINE void rasterize_list(const RasterizeArgs& args, const SamplePattern& pattern, const SampleExtent& extent,
                                   RasterCounters& counters) {
  const VisibilityTile& tile = args.tile;
  CoarseDepth coarse;
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
    std::uint32_t left = (1u << count) - 1u;
    if (largest <= max_gathered_setup) {
      const SetupVector t(args.triangles, load_int<Int>(index));
      BoxVector box(tile, t, extent);
      box.tiny &= first_lanes(count);
      left &= to_bits(box.some & !box.tiny);
      if (any(box.tiny))
        rasterize_tiny(tile, t, box, pattern, N > 0 ? N : pattern.count, args.triangles, list, counters);
    }
    for (; left != 0; left &= left - 1)
      rasterize_triangle<N>(tile, args.triangles[list[__builtin_ctz(left)]], pattern, extent, coarse, counters);
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

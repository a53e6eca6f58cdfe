// Triangles in window coordinates -> SetupTriangle: culling, orientation, depth plane.
#pragma once
#include "kernels/raster/clip.hpp"
#include "kernels/raster/edges.hpp"
#include "kernels/raster/pattern.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Twice the signed area in (1/256 pixel)^2; positive when a, b, c run counter-clockwise on the screen. Exact:
/// coordinates differ by less than 2^24.
inline std::int64_t twice_area(const SnappedVertex& a, const SnappedVertex& b, const SnappedVertex& c) {
  return std::int64_t(c.x - a.x) * (b.y - a.y) - std::int64_t(b.x - a.x) * (c.y - a.y);
}

template <class F>
struct DepthSlope {
  F dx, dy;
};

/// The plane through three depths. With edges (x1,y1), (x2,y2) from vertex 0 in 1/256 pixel, solving
///   dz1 = dx x1 + dy y1,  dz2 = dx x2 + dy y2   gives   dx = (y1 dz2 - y2 dz1) / A,  dy = (x2 dz1 - x1 dz2) / A
/// with A = x2 y1 - x1 y2, twice the area. The factor 256 makes it per pixel.
template <class F>
inline DepthSlope<F> depth_slope(F x1, F y1, F dz1, F x2, F y2, F dz2, F area) {
  const F scale = F(subpixel_scale) / area;
  return {difference_of_products(y1, dz2, y2, dz1) * scale, difference_of_products(x2, dz1, x1, dz2) * scale};
}

/// area = twice_area(a, b, c) > 0.
inline SetupTriangle setup_triangle(const SnappedVertex& a, const SnappedVertex& b, const SnappedVertex& c,
                                    std::int64_t area, std::uint32_t triangle) {
  const DepthSlope<float> slope = depth_slope(float(b.x - a.x), float(b.y - a.y), b.depth - a.depth, float(c.x - a.x),
                                              float(c.y - a.y), c.depth - a.depth, float(area));
  return {{a.x, b.x, c.x},
          {a.y, b.y, c.y},
          a.depth,
          slope.dx,
          slope.dy,
          min(min(a.depth, b.depth), c.depth),
          max(max(a.depth, b.depth), c.depth),
          triangle};
}

inline std::int32_t least(std::int32_t a, std::int32_t b) { return a < b ? a : b; }
inline std::int32_t greatest(std::int32_t a, std::int32_t b) { return a > b ? a : b; }

/// Whether the triangle of positive area covers the sample at (x, y); edges.hpp has the rule.
inline bool covers(const SnappedVertex& a, const SnappedVertex& b, const SnappedVertex& c, std::int32_t x,
                   std::int32_t y) {
  const auto inside = [=](const SnappedVertex& from, const SnappedVertex& to) {
    const std::int32_t dy = to.y - from.y, dx = from.x - to.x;
    const bool top_left = dy > 0 || (dy == 0 && dx > 0);
    return std::int64_t(dy) * (x - from.x) + std::int64_t(dx) * (y - from.y) - (top_left ? 0 : 1) >= 0;
  };
  return inside(a, b) && inside(b, c) && inside(c, a);
}

/// Whether the triangle of positive area may cover a sample of the frame: one lies in its bounding box, and where that
/// holds at most 2 x 2 of a kind, the triangle covers one. The box's right and bottom border are excluded: a point of
/// the largest x (y) is on a right (bottom) edge, which the top-left rule gives to the neighbour.
inline bool has_sample(const SnappedVertex& a, const SnappedVertex& b, const SnappedVertex& c,
                       const SamplePattern& pattern, int width, int height) {
  const std::int32_t x_min = least(least(a.x, b.x), c.x), x_max = greatest(greatest(a.x, b.x), c.x);
  const std::int32_t y_min = least(least(a.y, b.y), c.y), y_max = greatest(greatest(a.y, b.y), c.y);
  for (int s = 0; s < pattern.count; ++s) {
    const std::int32_t x_first = greatest((x_min - pattern.x[s] + 255) >> subpixel_bits, 0);
    const std::int32_t x_last = least((x_max - pattern.x[s] - 1) >> subpixel_bits, width - 1);
    const std::int32_t y_first = greatest((y_min - pattern.y[s] + 255) >> subpixel_bits, 0);
    const std::int32_t y_last = least((y_max - pattern.y[s] - 1) >> subpixel_bits, height - 1);
    if (x_first > x_last || y_first > y_last) continue;
    if (x_last - x_first > 1 || y_last - y_first > 1) return true;
    for (std::int32_t y = y_first; y <= y_last; ++y)
      for (std::int32_t x = x_first; x <= x_last; ++x)
        if (covers(a, b, c, (x << subpixel_bits) + pattern.x[s], (y << subpixel_bits) + pattern.y[s])) return true;
  }
  return false;
}

inline bool strictly_inside(const SnappedVertex& p, const SnappedVertex& a, const SnappedVertex& b,
                            const SnappedVertex& c) {
  return twice_area(a, b, p) > 0 && twice_area(b, c, p) > 0 && twice_area(c, a, p) > 0;
}

/// Cuts a polygon of positive area into triangles by its ears. A clipped triangle is convex, and this is then the fan
/// of vertex 0; but snapping can dent it by 1/256 pixel, and a fan would then cover samples twice. Calls emit(a, b, c,
/// area) for each piece, area > 0.
template <class Emit>
inline void triangulate(SnappedVertex (&v)[max_polygon], int count, Emit emit) {
  while (count >= 3) {
    int ear = -1, fallback = 1;
    for (int k = 0; k < count && ear < 0; ++k) {
      const int i = (k + 1) % count, before = k, after = (k + 2) % count;
      const std::int64_t area = twice_area(v[before], v[i], v[after]);
      if (area > 0) fallback = i;
      bool blocked = area < 0;
      for (int j = 0; j < count && area > 0 && !blocked; ++j) {
        if (j != before && j != i && j != after) blocked = strictly_inside(v[j], v[before], v[i], v[after]);
      }
      if (!blocked) ear = i;
    }
    if (ear < 0) ear = fallback;
    const SnappedVertex &a = v[(ear + count - 1) % count], &b = v[ear], &c = v[(ear + 1) % count];
    const std::int64_t area = twice_area(a, b, c);
    if (area > 0) emit(a, b, c, area);
    --count;
    for (int j = ear; j < count; ++j) v[j] = v[j + 1];
  }
}

/// The path of the few triangles that are clipped. Returns how many pieces were written.
inline std::uint32_t setup_clipped(const SetupTrianglesArgs& args, const SamplePattern& pattern, std::uint32_t index,
                                   SetupTriangle* out) {
  const Triangle& triangle = args.geometry.triangles[index];
  GeometryCounters& counters = *args.counters;
  SnappedVertex polygon[max_polygon];
  const int count = clip_triangle(args.view, args.geometry.positions, args.vertices, triangle.vertex, polygon);
  if (count == 0) {
    ++counters.outside;
    return 0;
  }
  ++counters.clipped;
  std::int64_t area = 0;
  for (int i = 2; i < count; ++i) area += twice_area(polygon[0], polygon[i - 1], polygon[i]);
  if (area < 0) {
    if (args.double_sided[triangle.binding] == 0) {
      ++counters.back_face;
      return 0;
    }
    for (int i = 1, j = count - 1; i < j; ++i, --j) {
      const SnappedVertex swapped = polygon[i];
      polygon[i] = polygon[j];
      polygon[j] = swapped;
    }
  }
  std::uint32_t written = 0;
  if (area != 0) {
    triangulate(polygon, count,
                [&](const SnappedVertex& a, const SnappedVertex& b, const SnappedVertex& c, std::int64_t piece_area) {
                  if (has_sample(a, b, c, pattern, args.view.width, args.view.height)) {
                    out[written++] = setup_triangle(a, b, c, piece_area, index);
                  }
                });
  }
  ++(written == 0 ? counters.empty : counters.kept);
  return written;
}

/// Any triangle, one at a time: what the vector path must equal.
inline std::uint32_t setup_one(const SetupTrianglesArgs& args, const SamplePattern& pattern, std::uint32_t index,
                               SetupTriangle* out) {
  const Triangle& triangle = args.geometry.triangles[index];
  GeometryCounters& counters = *args.counters;
  const ProjectedVertex& v0 = args.vertices[triangle.vertex[0]];
  const ProjectedVertex& v1 = args.vertices[triangle.vertex[1]];
  const ProjectedVertex& v2 = args.vertices[triangle.vertex[2]];
  constexpr std::uint32_t outside =
      outside_left | outside_right | outside_top | outside_bottom | outside_near | outside_far;
  const std::uint32_t any_flag = v0.flags | v1.flags | v2.flags;
  if ((any_flag & not_finite) != 0 || (v0.flags & v1.flags & v2.flags & outside) != 0) {
    ++counters.outside;
    return 0;
  }
  if ((any_flag & needs_clip) != 0) return setup_clipped(args, pattern, index, out);
  const SnappedVertex a{v0.x, v0.y, v0.depth};
  SnappedVertex b{v1.x, v1.y, v1.depth}, c{v2.x, v2.y, v2.depth};
  std::int64_t area = twice_area(a, b, c);
  if (area < 0) {
    if (args.double_sided[triangle.binding] == 0) {
      ++counters.back_face;
      return 0;
    }
    const SnappedVertex swapped = b;
    b = c;
    c = swapped;
    area = -area;
  }
  if (area == 0 || !has_sample(a, b, c, pattern, args.view.width, args.view.height)) {
    ++counters.empty;
    return 0;
  }
  *out = setup_triangle(a, b, c, area, index);
  ++counters.kept;
  return 1;
}

inline TouchedBox touched_box(const SetupTriangle& t, const SampleExtent& extent, const ViewTransform& view) {
  const std::int32_t x_min = least(least(t.x[0], t.x[1]), t.x[2]), x_max = greatest(greatest(t.x[0], t.x[1]), t.x[2]);
  const std::int32_t y_min = least(least(t.y[0], t.y[1]), t.y[2]), y_max = greatest(greatest(t.y[0], t.y[1]), t.y[2]);
  const auto tile = [](std::int32_t pixel, int size) {
    return static_cast<std::uint16_t>(least(greatest(pixel, 0), size - 1) / tile_size);
  };
  return {tile((x_min - extent.x_max + 255) >> subpixel_bits, view.width),
          tile((x_max - extent.x_min - 1) >> subpixel_bits, view.width),
          tile((y_min - extent.y_max + 255) >> subpixel_bits, view.height),
          tile((y_max - extent.y_min - 1) >> subpixel_bits, view.height)};
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// Homogeneous clipping: triangles that reach nearer than the near plane or leave the guard band.
#pragma once
#include "kernels/raster/project.hpp"

namespace tessera::TESSERA_ISA {
namespace {

inline constexpr int max_polygon = 8;  // a triangle gains at most one vertex from each of the five planes

struct SnappedVertex {
  std::int32_t x, y;
  float depth;
};

struct PolygonVertex {
  double x, y, z, w;
  bool kept;  // an original vertex that needs no clipping: it keeps the coordinates its other triangles see
  SnappedVertex snapped;
};

struct Polygon {
  int count;
  PolygonVertex v[max_polygon + 1];
};

/// Signed distance to a clip plane; negative is outside. Plane 0 is the near plane, 1 to 4 are the guard band.
inline double plane_distance(int plane, const PolygonVertex& v) {
  constexpr double low = double(guard_low) / 256, high = double(guard_high) / 256;
  double d = 0;
  switch (plane) {
    case 0:
      d = v.w - v.z;
      break;
    case 1:
      d = v.x - low * v.w;
      break;
    case 2:
      d = high * v.w - v.x;
      break;
    case 3:
      d = v.y - low * v.w;
      break;
    default:
      d = high * v.w - v.y;
      break;
  }
  // A vertex that project() accepts is inside whatever rounding says: its other triangles are not clipped there.
  return v.kept && d < 0 ? 0 : d;
}

/// The point of edge inside-outside on the plane. Always computed from the inner end, so that the two triangles that
/// share the edge, and run along it in opposite directions, get the same bits.
inline PolygonVertex intersect(const PolygonVertex& inside, const PolygonVertex& outside, double d_in, double d_out) {
  const double t = d_in / (d_in - d_out);
  return {inside.x + t * (outside.x - inside.x),
          inside.y + t * (outside.y - inside.y),
          inside.z + t * (outside.z - inside.z),
          inside.w + t * (outside.w - inside.w),
          false,
          {}};
}

/// Sutherland and Hodgman 1974, "Reentrant polygon clipping", one plane.
inline void clip_by_plane(int plane, Polygon& polygon) {
  double d[max_polygon + 1];
  bool crosses = false;
  for (int i = 0; i < polygon.count; ++i) {
    d[i] = plane_distance(plane, polygon.v[i]);
    crosses |= !(d[i] >= 0);
  }
  if (!crosses) return;
  Polygon out{};
  for (int i = 0; i < polygon.count; ++i) {
    const int j = i + 1 == polygon.count ? 0 : i + 1;
    const bool in_i = d[i] >= 0, in_j = d[j] >= 0;
    if (in_i && out.count <= max_polygon) out.v[out.count++] = polygon.v[i];
    if (in_i != in_j && out.count <= max_polygon) {
      out.v[out.count++] =
          in_i ? intersect(polygon.v[i], polygon.v[j], d[i], d[j]) : intersect(polygon.v[j], polygon.v[i], d[j], d[i]);
    }
  }
  polygon = out;
}

inline std::int32_t snap(double pixels) {
  const double scaled = clamp(pixels * 256, double(guard_low), double(guard_high));
  return static_cast<std::int32_t>(round_to_int(scaled));
}

/// Clips a triangle of finite vertices; the window coordinates of what is left, in the triangle's order.
/// Returns how many vertices it has: 0, or 3 to max_polygon.
inline int clip_triangle(const ViewTransform& view, const float* positions, const ProjectedVertex* projected,
                         const std::uint32_t (&vertex)[3], SnappedVertex (&out)[max_polygon]) {
  Polygon polygon{};
  polygon.count = 3;
  for (int i = 0; i < 3; ++i) {
    const float* p = positions + std::size_t(3) * vertex[i];
    const ProjectedVertex& v = projected[vertex[i]];
    const ClipPosition<float> c = to_clip(view, p[0], p[1], p[2]);
    polygon.v[i] = {double(c.x),        double(c.y), double(c.z), double(c.w), (v.flags & needs_clip) == 0,
                    {v.x, v.y, v.depth}};
  }
  for (int plane = 0; plane < 5; ++plane) clip_by_plane(plane, polygon);
  // Rounding can make a polygon that is thinner than a double's last bit lose its convexity; it has no samples.
  if (polygon.count < 3 || polygon.count > max_polygon) return 0;
  for (int i = 0; i < polygon.count; ++i) {
    const PolygonVertex& v = polygon.v[i];
    const double depth = clamp(v.z / v.w, -1152921504606846976.0, 1.0);
    out[i] = v.kept ? v.snapped : SnappedVertex{snap(v.x / v.w), snap(v.y / v.w), static_cast<float>(depth)};
  }
  return polygon.count;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

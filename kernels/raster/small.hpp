// Triangles whose bounding box lies within 16 x 16 pixels of a tile, which is most of a mesh. A vector of them, one per
// lane, finds out which vectors of pixels each of them meets; then those are drawn, one after another, without a branch
// on a triangle's shape.
#pragma once
#include "kernels/raster/draw.hpp"

namespace tessera::TESSERA_ISA {
namespace {

inline constexpr int small_columns = 4, small_rows = 16 / vector_height;  // vectors in a box, at most

/// Edge functions of near triangles (BoxVector) are integers below 2^23 within their box: |a|, |b| < 2^14 and distances
/// below 64 + 16 pixels. Floats hold them exactly.
struct SmallTriangles {
  LaneArray<float> a[3], b[3];
  // With one sample: at each vector's first pixel's sample. With several: beyond what it is at the first vector, which
  // is `first`.
  LaneArray<float> edge[small_columns * small_rows][3], first[max_samples][3];
  // Of that pixel's sample, or with several of its corner, from vertex 0, in pixels.
  LaneArray<float> from_x[small_columns], from_y[small_rows];
  LaneArray<float> depth, depth_dx, depth_dy, depth_min, depth_max;
  LaneArray<std::int32_t> triangle, x0, y0;   // (x0, y0): the first vector's first pixel
  LaneArray<std::int32_t> pixel[small_rows];  // tile_pixel() of each row's first vector
};

/// A vector of pixels that a triangle meets: (column + small_columns * row) * lanes + lane.
using SmallItem = std::int32_t;

/// a b + c of integers that a float holds exactly, products and sums too: fused or not, it is the same.
TESSERA_INLINE Float exact_mul_add(Float a, Float b, Float c) {
#ifdef __SSE4_2__
#ifndef __FMA__
  return a * b + c;  // where fusing is emulated
#endif
#endif
  return mul_add(a, b, c);
}

/// The vectors that the wanted lanes' triangles meet, at any of `samples` samples. Returns how many.
TESSERA_INLINE int find_items(const VisibilityTile& tile, const SetupVector& t, const BoxVector& box, Mask wanted,
                              const SamplePattern& pattern, int samples, SmallTriangles& out, SmallItem* items) {
  store(out.depth.lane, t.depth);
  store(out.depth_dx.lane, t.depth_dx);
  store(out.depth_dy.lane, t.depth_dy);
  store(out.depth_min.lane, t.depth_min);
  store(out.depth_max.lane, t.depth_max);
  store(out.triangle.lane, t.triangle);
  const Int x0 = box.x0 & Int(-vector_width), y0 = box.y0 & Int(-vector_height);
  store(out.x0.lane, x0);
  store(out.y0.lane, y0);
  const bool one = samples == 1;
  const Int at_x = (x0 << subpixel_bits) + Int((tile.x << subpixel_bits) + (one ? pattern.x[0] : 0));
  const Int at_y = (y0 << subpixel_bits) + Int((tile.y << subpixel_bits) + (one ? pattern.y[0] : 0));
  // first: as out.edge at the first vector; reach: the most that is added within a vector, and by samples.
  Int first[3], step_x[3], step_y[3], reach[3];
  for (int e = 0; e < 3; ++e) {
    const LaneEdge edge(t, e, at_x, at_y);
    store(out.a[e].lane, to_float(edge.a));
    store(out.b[e].lane, to_float(edge.b));
    step_x[e] = edge.a << 2;
    step_y[e] = edge.b * Int(vector_height);
    reach[e] = max(edge.a * Int(vector_width - 1), Int(0)) + max(edge.b * Int(vector_height - 1), Int(0));
    if (one) {
      first[e] = edge.at_corner >> subpixel_bits;
      continue;
    }
    Int most(-0x7fffffff);
    for (int s = 0; s < samples; ++s) {
      const Int at_sample = (edge.at_corner + edge.a * Int(pattern.x[s]) + edge.b * Int(pattern.y[s])) >> subpixel_bits;
      store(out.first[s][e].lane, to_float(at_sample));
      most = max(most, at_sample);
    }
    first[e] = Int(0);
    reach[e] += most;
  }
  const Float from_x = to_float(at_x - t.x[0]) * Float(1.0f / 256),
              from_y = to_float(at_y - t.y[0]) * Float(1.0f / 256);
  const Int columns = (box.x1 - x0) >> 2,
            rows = (box.y1 - y0) >> (vector_height == 4 ? 2 : vector_height - 1);  // the last ones' numbers
  int count = 0;
  Mask in_row = wanted;
  for (int row = 0; any(in_row); ++row) {
    Int edge[3] = {first[0], first[1], first[2]};
    store(out.from_y[row].lane, from_y + Float(float(row * vector_height)));
    store(out.pixel[row].lane, pixel_number(x0, y0 + Int(row * vector_height)));
    Mask here = in_row;
    for (int column = 0; any(here); ++column) {
      const int k = row * small_columns + column;
      if (row == 0) store(out.from_x[column].lane, from_x + Float(float(column * vector_width)));
      Int meets(0);
      for (int e = 0; e < 3; ++e) {
        store(out.edge[k][e].lane, to_float(edge[e]));
        meets |= edge[e] + reach[e];
        edge[e] += step_x[e];
      }
      count += compress_store(items + count, lane_index() + Int(k * Int::lanes), here & (meets >= Int(0)));
      here &= columns > Int(column);
    }
    for (int e = 0; e < 3; ++e) first[e] += step_y[e];
    in_row &= rows > Int(row);
  }
  return count;
}

/// Draws what find_items() found. masked: the visible part of the tile does not consist of whole vectors.
template <bool masked, class Counter>
TESSERA_INLINE void draw_items(const VisibilityTile& tile, const SamplePattern& pattern, int samples,
                               const SmallTriangles& t, const SmallItem* items, int count, const Counter& counter) {
  const Float column = to_float(lane_column()), row = to_float(lane_row());
  for (int n = 0; n < count; ++n) {
    const auto item = static_cast<std::uint32_t>(items[n]);
    const std::uint32_t i = item % Int::lanes, k = item / Int::lanes;
    const std::uint32_t column_of = k % small_columns, row_of = k / small_columns;
    Float edge[3];
    for (int e = 0; e < 3; ++e)
      edge[e] = exact_mul_add(Float(t.b[e].lane[i]), row,
                              exact_mul_add(Float(t.a[e].lane[i]), column, Float(t.edge[k][e].lane[i])));
    Mask visible(true);
    if (masked)
      visible = (lane_column() < Int(tile.width - t.x0.lane[i] - int(column_of) * vector_width)) &
                (lane_row() < Int(tile.height - t.y0.lane[i] - int(row_of) * vector_height));
    const Float x = Float(t.from_x[column_of].lane[i]) + column, y = Float(t.from_y[row_of].lane[i]) + row;
    const int pixel = t.pixel[row_of].lane[i] + int(column_of) * 16;
    const auto draw = [&](int s, Float inside, Float at_x, Float at_y) {
      Mask covered = inside >= Float(0);
      if (masked) covered &= visible;
      // As DepthPlane. Distances are multiples of 1/256 below 2^16: their sums are exact, as from_vertex() is.
      const Float along = mul_add(Float(t.depth_dx.lane[i]), at_x, Float(t.depth.lane[i]));
      const Float depth = clamp(mul_add(Float(t.depth_dy.lane[i]), at_y, along), Float(t.depth_min.lane[i]),
                                Float(t.depth_max.lane[i]));
      draw_vector(tile, s, pixel, covered, depth, static_cast<std::uint32_t>(t.triangle.lane[i]), counter);
    };
    if (samples == 1) {
      draw(0, min(min(edge[0], edge[1]), edge[2]), x, y);
      continue;
    }
    for (int s = 0; s < samples; ++s) {
      Float at[3];
      for (int e = 0; e < 3; ++e) at[e] = edge[e] + Float(t.first[s][e].lane[i]);
      draw(s, min(min(at[0], at[1]), at[2]), x + Float(float(pattern.x[s]) * (1.0f / 256)),
           y + Float(float(pattern.y[s]) * (1.0f / 256)));
    }
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

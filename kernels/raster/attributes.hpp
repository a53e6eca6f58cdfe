// Fragments and the vertices of their triangles, a vector at a time.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/raster/barycentric.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

inline constexpr int tile_shift = 5;
static_assert(1 << tile_shift == tile_size);

/// Means of sample positions, in pixels from a pixel's top-left corner.
struct SampleMeans {
  std::uint32_t full;  // every sample of the pattern
  float x, y;          // mean of all
};

inline SampleMeans sample_means(const SamplePattern& pattern) {
  std::int32_t x = 0, y = 0;
  for (int s = 0; s < pattern.count; ++s) {
    x += pattern.x[s];
    y += pattern.y[s];
  }
  const float scale = 1.0f / (256.0f * static_cast<float>(pattern.count));  // exact: counts are powers of two
  return {(1u << pattern.count) - 1u, static_cast<float>(x) * scale, static_cast<float>(y) * scale};
}

/// The lanes' fragments, the points at which they are shaded, and the vertices of their triangles.
struct FragmentLanes {
  Float x, y;  // pixels, in the window
  Int vertex[3];
  bool one_triangle;  // all lanes see the same one: its vertices are read once
  std::uint32_t shared[3];
};

/// Mean position of the covered samples. A fragment that covers none (which no rasterizer makes) counts as full.
inline void mean_of_samples(const SamplePattern& pattern, const SampleMeans& means, Int samples, Float& x, Float& y) {
  x = Float(means.x);
  y = Float(means.y);
  samples = samples & Int(static_cast<std::int32_t>(means.full));
  const Mask partial = (samples != Int(static_cast<std::int32_t>(means.full))) & (samples != Int(0));
  if (none(partial)) return;
  Int sum_x(0), sum_y(0), count(0);
  for (int s = 0; s < pattern.count; ++s) {
    const Mask covered = (samples & Int(1 << s)) != Int(0);
    sum_x = sum_x + select(covered, Int(pattern.x[s]), Int(0));
    sum_y = sum_y + select(covered, Int(pattern.y[s]), Int(0));
    count = count + select(covered, Int(1), Int(0));
  }
  const Float divisor = to_float(select(partial, count, Int(1)) << 8);
  x = select(partial, to_float(sum_x) / divisor, x);
  y = select(partial, to_float(sum_y) / divisor, y);
}

/// Fragments [begin, begin + lanes) of count. Lanes past the end repeat the last fragment.
template <class Args>
inline FragmentLanes load_fragments(const Args& args, const SampleMeans& means, std::uint32_t begin) {
  const Int last(static_cast<std::int32_t>(args.count - 1 - begin));
  const Int lane = select(lane_index() > last, last, lane_index());
  const Fragment* fragments = args.fragments + begin;
  const Int triangle = gather_bytes(fragments, lane << 3);
  const Int pixel_samples = gather_bytes(fragments, (lane << 3) + Int(4));
  const Int pixel = pixel_samples & Int(0xffff);
  FragmentLanes f;
  Float mean_x, mean_y;
  mean_of_samples(args.pattern, means, shift_right_logical(pixel_samples, 16), mean_x, mean_y);
  f.x = to_float(Int(args.tile_x) + (pixel & Int(tile_size - 1))) + mean_x;
  f.y = to_float(Int(args.tile_y) + shift_right_logical(pixel, tile_shift)) + mean_y;

  f.one_triangle = all(triangle == Int(static_cast<std::int32_t>(fragments->triangle)));
  const Triangle* triangles = args.geometry.triangles;
  for (int i = 0; i < 3; ++i) {
    if (f.one_triangle) {
      f.shared[i] = triangles[fragments->triangle].vertex[i];
    } else {
      const auto* base = reinterpret_cast<const std::int32_t*>(triangles->vertex + i);
      f.vertex[i] = gather(base, triangle << 2);
    }
  }
  return f;
}

inline void fetch_positions(const GeometryView& geometry, const FragmentLanes& f, Vec3<Float> (&p)[3]) {
  for (int i = 0; i < 3; ++i) {
    if (f.one_triangle) {
      const float* at = geometry.positions + std::size_t{f.shared[i]} * 3;
      p[i] = {Float(at[0]), Float(at[1]), Float(at[2])};
    } else {
      const Int index = f.vertex[i] * Int(3);
      p[i] = {gather(geometry.positions, index), gather(geometry.positions + 1, index),
              gather(geometry.positions + 2, index)};
    }
  }
}

/// Where an attribute lies in VertexAttributes, in floats.
enum AttributeOffset { normal_offset = 0, tangent_offset = 3, uv_offset = 7, color_offset = 11 };
static_assert(offsetof(VertexAttributes, tangent) == tangent_offset * sizeof(float));
static_assert(offsetof(VertexAttributes, uv) == uv_offset * sizeof(float));
static_assert(offsetof(VertexAttributes, color) == color_offset * sizeof(float));

/// `size` floats from `offset` on, of the three vertices.
template <int size>
inline void fetch_attribute(const GeometryView& geometry, const FragmentLanes& f, int offset, Float (&out)[size][3]) {
  constexpr int stride = sizeof(VertexAttributes) / sizeof(float);
  const float* base = geometry.attributes->normal + offset;
  for (int i = 0; i < 3; ++i) {
    if (f.one_triangle) {
      const float* at = base + std::size_t{f.shared[i]} * stride;
      for (int c = 0; c < size; ++c) out[c][i] = Float(at[c]);
    } else {
      const Int index = f.vertex[i] * Int(stride);
      for (int c = 0; c < size; ++c) out[c][i] = gather(base + c, index);
    }
  }
}

/// The same, interpolated at the shaded point.
template <int size>
inline void interpolate_attribute(const GeometryView& geometry, const FragmentLanes& f, const Barycentrics<Float>& b,
                                  int offset, Float (&out)[size]) {
  Float corners[size][3];
  fetch_attribute(geometry, f, offset, corners);
  for (int c = 0; c < size; ++c) out[c] = interpolate(b, corners[c][0], corners[c][1], corners[c][2]);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

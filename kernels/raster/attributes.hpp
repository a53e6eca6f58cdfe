// Fragments and the vertices of their triangles, a vector at a time.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/raster/barycentric.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

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

/// Triangles whose vertices fit in two registers, a quad of floats at a time.
inline constexpr int few_triangles = 2 * records_per_register;

/// The lanes' fragments, the points at which they are shaded, and the vertices of their triangles.
struct FragmentLanes {
  Float x, y;  // pixels, in the window
  // Where lanes see few different triangles, those triangles' vertices are read once each and spread over the lanes.
  int registers;                         // 1 or 2 registers hold them; 0: more triangles, gather by `vertex`
  std::size_t shared[3][few_triangles];  // the triangles' vertices
  Int place4;                            // as in DistinctLanes
  Int vertex[3];
};

/// Mean position of the covered samples. A fragment that covers none (which no rasterizer makes) counts as full.
TESSERA_INLINE void mean_of_samples(const SamplePattern& pattern, const SampleMeans& means, Int samples, Float& x,
                                    Float& y) {
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
TESSERA_INLINE FragmentLanes load_fragments(const Args& args, const SampleMeans& means, std::uint32_t begin) {
  const Fragment* fragments = args.fragments + begin;
  Fragment padded[Int::lanes];
  const int left = static_cast<int>(min(std::int64_t{args.count - begin}, std::int64_t{Int::lanes}));
  if (left < Int::lanes) {
    for (int i = 0; i < Int::lanes; ++i) padded[i] = fragments[i < left ? i : left - 1];
    fragments = padded;
  }
  const IntPair words = load_pairs(fragments);
  const Int triangle = words.low, pixel_samples = words.high;
  const Int pixel = pixel_samples & Int(0xffff);
  FragmentLanes f;
  Float mean_x, mean_y;
  mean_of_samples(args.pattern, means, shift_right_logical(pixel_samples, 16), mean_x, mean_y);
  // tile_pixel_x() and tile_pixel_y().
  const Int x = (shift_right_logical(pixel, 2) & Int(28)) + (pixel & Int(3));
  const Int y = (shift_right_logical(pixel, 5) & Int(28)) + (shift_right_logical(pixel, 2) & Int(3));
  f.x = to_float(Int(args.tile_x) + x) + mean_x;
  f.y = to_float(Int(args.tile_y) + y) + mean_y;

  const Triangle* triangles = args.geometry.triangles;
  DistinctLanes different;
  find_distinct(triangle, different);
  f.registers = different.count <= records_per_register ? 1 : different.count <= few_triangles ? 2 : 0;
  if (f.registers != 0) {
    f.place4 = different.place4;
    const int read = f.registers * records_per_register;  // beyond the count, triangle 0: there is one
    for (int n = 0; n < read; ++n) {
      const Triangle& t = triangles[static_cast<std::uint32_t>(different.values[n])];
      for (int i = 0; i < 3; ++i) f.shared[i][n] = t.vertex[i];
      asm("" : "+m"(f.shared));
    }
    return f;
  }
  f.registers = 0;
  Float record[4];
  gather_quads(reinterpret_cast<const float*>(triangles), triangle << 2, record);
  for (int i = 0; i < 3; ++i) f.vertex[i] = bits(record[i]);
  return f;
}

/// Words `offset` on, `size` of them (three, or a multiple of four), of vertex i of the lanes' triangles: records of
/// `stride` floats at base. registers: what f says.
template <int registers, int stride, int size>
TESSERA_INLINE void fetch_words(const FragmentLanes& f, const float* base, int offset, int i, Float (&out)[size]) {
  if constexpr (registers == 0) {
    if constexpr (size == 3)
      gather_triples(base + offset, f.vertex[i] * Int(stride), out);
    else
      gather_quads(base + offset, f.vertex[i] * Int(stride), out);
  } else {
    const float* record[few_triangles];
    for (int n = 0; n < registers * records_per_register; ++n) record[n] = base + offset + f.shared[i][n] * stride;
    spread_records<registers>(record, f.place4, out);
  }
}
/// The same, registers as f says.
template <int stride, int size>
TESSERA_INLINE void fetch_any_words(const FragmentLanes& f, const float* base, int offset, int i, Float (&out)[size]) {
  if (f.registers == 1) return fetch_words<1, stride>(f, base, offset, i, out);
  if (f.registers == 2) return fetch_words<2, stride>(f, base, offset, i, out);
  fetch_words<0, stride>(f, base, offset, i, out);
}

TESSERA_INLINE void fetch_positions(const GeometryView& geometry, const FragmentLanes& f, Vec3<Float> (&p)[3]) {
  for (int i = 0; i < 3; ++i) {
    Float at[3];
    fetch_any_words<3>(f, geometry.positions, 0, i, at);
    p[i] = {at[0], at[1], at[2]};
  }
}

/// Where an attribute lies in VertexAttributes, in floats.
enum AttributeOffset { normal_offset = 0, tangent_offset = 3, uv_offset = 7, color_offset = 11 };
static_assert(offsetof(VertexAttributes, tangent) == tangent_offset * sizeof(float));
static_assert(offsetof(VertexAttributes, uv) == uv_offset * sizeof(float));
static_assert(offsetof(VertexAttributes, color) == color_offset * sizeof(float));

/// `size` floats (at most four) from `offset` on, of the three vertices. No offset is so far back that four floats
/// would leave the vertex.
template <int size>
inline void fetch_attribute(const GeometryView& geometry, const FragmentLanes& f, int offset, Float (&out)[size][3]) {
  constexpr int stride = sizeof(VertexAttributes) / sizeof(float);
  for (int i = 0; i < 3; ++i) {
    Float at[4];
    fetch_any_words<stride>(f, geometry.attributes->normal, offset, i, at);
    for (int c = 0; c < size; ++c) out[c][i] = at[c];
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

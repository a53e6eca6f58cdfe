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

inline constexpr int few_triangles = 4;

/// The lanes' fragments, the points at which they are shaded, and the vertices of their triangles.
struct FragmentLanes {
  Float x, y;  // pixels, in the window
  // Where lanes see few different triangles, those triangles' vertices are read once each and spread over the lanes.
  int triangles;                           // 1 to few_triangles; 0: more, gather by `vertex`
  std::uint32_t shared[few_triangles][3];  // vertices of each
  Mask sees[few_triangles];                // lanes
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
  f.x = to_float(Int(args.tile_x) + (pixel & Int(tile_size - 1))) + mean_x;
  f.y = to_float(Int(args.tile_y) + shift_right_logical(pixel, tile_shift)) + mean_y;

  const Triangle* triangles = args.geometry.triangles;
  f.triangles = 0;
  std::uint32_t unseen = to_bits(Mask(true));
  for (int n = 0; n < few_triangles; ++n) {
    const std::uint32_t of_lane = fragments[__builtin_ctz(unseen)].triangle;
    f.sees[n] = triangle == Int(of_lane);
    for (int i = 0; i < 3; ++i) f.shared[n][i] = triangles[of_lane].vertex[i];
    unseen &= ~to_bits(f.sees[n]);
    if (unseen == 0) {
      f.triangles = n + 1;
      return f;
    }
  }
  Float record[4];
  gather_quads(reinterpret_cast<const float*>(triangles), triangle << 2, record);
  for (int i = 0; i < 3; ++i) f.vertex[i] = bits(record[i]);
  return f;
}

/// `size` floats of vertex i of the lanes' triangles, of which there are n: records of `stride` floats at base.
template <int n, int size>
TESSERA_INLINE void spread_few(const FragmentLanes& f, const float* base, std::size_t stride, int i,
                               Float (&out)[size]) {
  const float* at[n];
  for (int k = 0; k < n; ++k) at[k] = base + f.shared[k][i] * stride;
  for (int c = 0; c < size; ++c) {
    out[c] = Float(at[0][c]);
    for (int k = 1; k < n; ++k) out[c] = select(f.sees[k], Float(at[k][c]), out[c]);
  }
}

template <int size>
TESSERA_INLINE void spread_records(const FragmentLanes& f, const float* base, std::size_t stride, int i,
                                   Float (&out)[size]) {
  static_assert(few_triangles == 4);
  if (f.triangles == 1) return spread_few<1>(f, base, stride, i, out);
  if (f.triangles == 2) return spread_few<2>(f, base, stride, i, out);
  if (f.triangles == 3) return spread_few<3>(f, base, stride, i, out);
  spread_few<4>(f, base, stride, i, out);
}

/// What later fragments read, fetched while earlier ones are worked on: triangles some vectors ahead, their vertices a
/// vector ahead. Neighbours mostly see the same triangle.
TESSERA_INLINE void prefetch_fragments(const ResolveArgs& args, std::uint32_t at) {
  constexpr auto lanes = std::uint32_t(Int::lanes);
  constexpr std::uint32_t far = lanes >= 16 ? 3 * lanes : 48, near = lanes >= 16 ? lanes : 16;
  const auto changes = [&](std::uint32_t begin) {  // lanes whose triangle is not that of the fragment before
    if (begin + lanes > args.count) return 0u;
    const Int here = load_pairs(args.fragments + begin).low, before = load_pairs(args.fragments + begin - 1).low;
    return to_bits(here != before);
  };
  for (std::uint32_t left = changes(at + far); left != 0; left &= left - 1)
    __builtin_prefetch(args.geometry.triangles + args.fragments[at + far + __builtin_ctz(left)].triangle);
  for (std::uint32_t left = changes(at + near); left != 0; left &= left - 1) {
    const Triangle& triangle = args.geometry.triangles[args.fragments[at + near + __builtin_ctz(left)].triangle];
    for (const std::uint32_t vertex : triangle.vertex) {
      if (args.geometry.surfaces != nullptr) {
        __builtin_prefetch(args.geometry.surfaces + vertex);
        __builtin_prefetch(reinterpret_cast<const char*>(args.geometry.surfaces + vertex + 1) - 1);
      } else {
        __builtin_prefetch(args.geometry.positions + std::size_t{3} * vertex);
        __builtin_prefetch(args.geometry.attributes + vertex);
      }
    }
  }
}

TESSERA_INLINE void fetch_positions(const GeometryView& geometry, const FragmentLanes& f, Vec3<Float> (&p)[3]) {
  for (int i = 0; i < 3; ++i) {
    Float at[3];
    if (f.triangles != 0) {
      spread_records(f, geometry.positions, 3, i, at);
    } else {
      gather_triples(geometry.positions, f.vertex[i] * Int(3), at);
    }
    p[i] = {at[0], at[1], at[2]};
  }
}

/// Where an attribute lies in VertexAttributes, in floats.
enum AttributeOffset { normal_offset = 0, tangent_offset = 3, uv_offset = 7, color_offset = 11 };
static_assert(offsetof(VertexAttributes, tangent) == tangent_offset * sizeof(float));
static_assert(offsetof(VertexAttributes, uv) == uv_offset * sizeof(float));
static_assert(offsetof(VertexAttributes, color) == color_offset * sizeof(float));

/// `size` floats (at most four) from `offset` on, of the three vertices.
template <int size>
inline void fetch_attribute(const GeometryView& geometry, const FragmentLanes& f, int offset, Float (&out)[size][3]) {
  constexpr int stride = sizeof(VertexAttributes) / sizeof(float);
  const float* base = geometry.attributes->normal + offset;
  for (int i = 0; i < 3; ++i) {
    if (f.triangles != 0) {
      Float at[size];
      spread_records(f, base, stride, i, at);
      for (int c = 0; c < size; ++c) out[c][i] = at[c];
    } else {
      Float record[4];  // no offset is so far back that four floats would leave the vertex
      gather_quads(base, f.vertex[i] * Int(stride), record);
      for (int c = 0; c < size; ++c) out[c][i] = record[c];
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

/// The three vertices, twelve floats each: SurfaceVertex's members in order.
struct SurfaceCorners {
  Float vertex[3][12];
};
static_assert(offsetof(SurfaceVertex, normal) == 3 * sizeof(float));
static_assert(offsetof(SurfaceVertex, base_color) == 6 * sizeof(float));
static_assert(offsetof(SurfaceVertex, metallic) == 9 * sizeof(float));

TESSERA_INLINE void fetch_surfaces(const GeometryView& geometry, const FragmentLanes& f, SurfaceCorners& out) {
  constexpr int size = 12;
  const float* base = geometry.surfaces->position;
  for (int i = 0; i < 3; ++i) {
    if (f.triangles != 0) {
      spread_records(f, base, size, i, out.vertex[i]);
    } else {
      gather_quads(base, f.vertex[i] * Int(size), out.vertex[i]);
    }
  }
}

TESSERA_INLINE Float interpolate(const SurfaceCorners& corners, const Barycentrics<Float>& b, int word) {
  return interpolate(b, corners.vertex[0][word], corners.vertex[1][word], corners.vertex[2][word]);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

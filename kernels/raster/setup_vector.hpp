// Set-up of a vector of triangles at a time: rejection, and the whole set-up of triangles up to 128 pixels. What is
// larger or needs clipping goes one at a time through setup.hpp; both give the same bits.
#pragma once
#include "kernels/raster/setup.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// Edges below 2^15 units: products stay below 2^30 and twice the area below 2^31, exact in 32 bits.
inline constexpr std::int32_t small_extent = 1 << 15;
// gather() counts 32-bit words in 31 bits; a vertex has four.
inline constexpr std::uint32_t max_gathered_vertices = 1u << 29;

struct VectorTriangles {
  Int x[3], y[3];
  Float depth[3];
};

struct BoxLanes {
  Int x_min, x_max, y_min, y_max;
};

/// has_sample() for every wanted lane, of triangles whose vertices are in order. Both terms of an edge function at a
/// point of the bounding box are below small_extent^2 = 2^30: no overflow.
TESSERA_INLINE Mask has_sample(const Int (&vx)[3], const Int (&vy)[3], const BoxLanes& box, Mask wanted,
                               const SamplePattern& pattern, int width, int height) {
  Mask found = !wanted;
  for (int s = 0; s < pattern.count && !all(found); ++s) {
    const Int x_first = max((box.x_min + Int(255 - pattern.x[s])) >> subpixel_bits, Int(0));
    const Int x_last = min((box.x_max - Int(pattern.x[s] + 1)) >> subpixel_bits, Int(width - 1));
    const Int y_first = max((box.y_min + Int(255 - pattern.y[s])) >> subpixel_bits, Int(0));
    const Int y_last = min((box.y_max - Int(pattern.y[s] + 1)) >> subpixel_bits, Int(height - 1));
    const Int columns = x_last - x_first, rows = y_last - y_first;
    const Mask some = (columns >= Int(0)) & (rows >= Int(0)), many = some & ((columns > Int(1)) | (rows > Int(1)));
    found |= many;
    const Mask few = some & !found;
    if (none(few)) continue;
    const Int x = (x_first << subpixel_bits) + Int(pattern.x[s]), y = (y_first << subpixel_bits) + Int(pattern.y[s]);
    Int edge[3], a[3], b[3];
    for (int e = 0; e < 3; ++e) {
      const int next = e == 2 ? 0 : e + 1;
      a[e] = vy[next] - vy[e];
      b[e] = vx[e] - vx[next];
      const Mask top_left = (a[e] > Int(0)) | ((a[e] == Int(0)) & (b[e] > Int(0)));
      edge[e] = a[e] * (x - vx[e]) + b[e] * (y - vy[e]) - select(top_left, Int(0), Int(1));
      a[e] = a[e] << subpixel_bits;
      b[e] = b[e] << subpixel_bits;
    }
    const auto covered = [&](int dx, int dy) {
      Int all_edges(0);
      for (int e = 0; e < 3; ++e) {
        Int at = edge[e];
        if (dx != 0) at += a[e];
        if (dy != 0) at += b[e];
        all_edges |= at;
      }
      return all_edges >= Int(0);
    };
    const Mask two_columns = columns > Int(0), two_rows = rows > Int(0);
    found |= few & (covered(0, 0) | (two_columns & covered(1, 0)) | (two_rows & covered(0, 1)) |
                    (two_columns & two_rows & covered(1, 1)));
  }
  return found & wanted;
}

/// Which of the lanes, which are of these triangles, have bindings that keep back faces. A run of triangles usually has
/// one binding.
TESSERA_INLINE Mask double_sided_lanes(const std::uint8_t* double_sided, const Triangle* triangles, Int binding,
                                       Mask lanes) {
  const std::uint32_t wanted = to_bits(lanes);
  if (wanted == 0) return lanes;
  const std::uint32_t one = triangles[__builtin_ctz(wanted)].binding;
  if (all((binding == Int(one)) | !lanes)) return double_sided[one] != 0 ? lanes : Mask(false);
  std::uint32_t out = 0;
  for (std::uint32_t left = wanted; left != 0; left &= left - 1) {
    const int i = __builtin_ctz(left);
    out |= std::uint32_t(double_sided[triangles[i].binding] != 0) << i;
  }
  return from_mask_bits(out);
}

/// Set-up of all lanes, record by record of twelve words: put() takes them in three parts of four. Lanes of `turned`
/// are back faces.
template <class Put>
TESSERA_INLINE void setup_lanes(const VectorTriangles& t, Mask turned, Int area, Int triangle, const Put& put) {
  const Int bx = select(turned, t.x[2], t.x[1]), cx = select(turned, t.x[1], t.x[2]);
  const Int by = select(turned, t.y[2], t.y[1]), cy = select(turned, t.y[1], t.y[2]);
  const Float b_depth = select(turned, t.depth[2], t.depth[1]), c_depth = select(turned, t.depth[1], t.depth[2]);
  const Float a_depth = t.depth[0];
  const DepthSlope<Float> slope =
      depth_slope(to_float(bx - t.x[0]), to_float(by - t.y[0]), b_depth - a_depth, to_float(cx - t.x[0]),
                  to_float(cy - t.y[0]), c_depth - a_depth, to_float(select(turned, -area, area)));
  const Float low = min(min(a_depth, b_depth), c_depth), high = max(max(a_depth, b_depth), c_depth);
  put(0, {from_bits(t.x[0]), from_bits(bx), from_bits(cx), from_bits(t.y[0])});
  put(1, {from_bits(by), from_bits(cy), a_depth, slope.dx});
  put(2, {slope.dy, low, high, from_bits(triangle)});
}

/// TouchedBox of each lane, as touched_box(): its two words.
struct TouchedLanes {
  Int first, last;
};
TESSERA_INLINE TouchedLanes touched_lanes(const BoxLanes& box, const SampleExtent& extent, const ViewTransform& view) {
  const auto tile = [](Int pixel, int size) {
    static_assert(tile_size == 1 << 5);
    return clamp(pixel, Int(0), Int(size - 1)) >> 5;
  };
  const Int x0 = tile((box.x_min + Int(255 - extent.x_max)) >> subpixel_bits, view.width);
  const Int x1 = tile((box.x_max - Int(extent.x_min + 1)) >> subpixel_bits, view.width);
  const Int y0 = tile((box.y_min + Int(255 - extent.y_max)) >> subpixel_bits, view.height);
  const Int y1 = tile((box.y_max - Int(extent.y_min + 1)) >> subpixel_bits, view.height);
  static_assert(sizeof(TouchedBox) == 8);
  return {x0 | (x1 << 16), y0 | (y1 << 16)};
}

/// setup_one() of triangle `index`, behind what is written already.
inline std::uint32_t setup_one_more(const SetupTrianglesArgs& args, const SamplePattern& pattern,
                                    const SampleExtent& extent, std::uint32_t index, std::uint32_t written) {
  const std::uint32_t pieces = setup_one(args, pattern, index, args.out + written);
  if (args.touched != nullptr)
    for (std::uint32_t i = written; i < written + pieces; ++i)
      args.touched[i] = touched_box(args.out[i], extent, args.view);
  return pieces;
}

/// Triangles first to first + count, at most a vector of them, behind what is written already. Returns how many were.
TESSERA_INLINE std::uint32_t setup_vector(const SetupTrianglesArgs& args, const SamplePattern& pattern,
                                          const SampleExtent& extent, std::uint32_t first, int count,
                                          std::uint32_t before) {
  const Triangle* triangles = args.geometry.triangles + first;
  const Mask active = first_lanes(count);
  Float record[4];
  if (count == Int::lanes) {
    load_quads(reinterpret_cast<const float*>(triangles), record);
  } else {
    gather_quads(reinterpret_cast<const float*>(triangles), select(active, lane_index(), Int(0)) << 2, record);
  }
  VectorTriangles t;
  Int any_flag(0), all_flags(-1);
  for (int i = 0; i < 3; ++i) {
    Float vertex[4];
    gather_quads(reinterpret_cast<const float*>(args.vertices), bits(record[i]) << 2, vertex);
    t.x[i] = bits(vertex[0]);
    t.y[i] = bits(vertex[1]);
    t.depth[i] = vertex[2];
    const Int flags = bits(vertex[3]);
    any_flag |= flags;
    all_flags &= flags;
  }
  constexpr int outside = outside_left | outside_right | outside_top | outside_bottom | outside_near | outside_far;
  GeometryCounters& counters = *args.counters;
  const Mask rejected = ((any_flag & Int(not_finite)) | (all_flags & Int(outside))) != Int(0);
  counters.outside += std::uint64_t(__builtin_popcount(to_bits(active & rejected)));
  const Mask candidates = active & !rejected;
  if (none(candidates)) return 0;

  const Int x_min = min(min(t.x[0], t.x[1]), t.x[2]), x_max = max(max(t.x[0], t.x[1]), t.x[2]);
  const Int y_min = min(min(t.y[0], t.y[1]), t.y[2]), y_max = max(max(t.y[0], t.y[1]), t.y[2]);
  const Mask fits = (x_max - x_min < Int(small_extent)) & (y_max - y_min < Int(small_extent)) &
                    ((any_flag & Int(needs_clip)) == Int(0));
  const Mask here = candidates & fits;
  const Int area = (t.x[2] - t.x[0]) * (t.y[1] - t.y[0]) - (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]);  // as twice_area()
  const Mask negative = here & (area < Int(0));
  const Mask turned = double_sided_lanes(args.double_sided, triangles, bits(record[3]), negative);
  const Mask culled = negative & !turned;
  const Mask facing = here & !culled;
  const Int in_order_x[3] = {t.x[0], select(turned, t.x[2], t.x[1]), select(turned, t.x[1], t.x[2])};
  const Int in_order_y[3] = {t.y[0], select(turned, t.y[2], t.y[1]), select(turned, t.y[1], t.y[2])};
  const Mask kept = has_sample(in_order_x, in_order_y, {x_min, x_max, y_min, y_max}, facing & (area != Int(0)), pattern,
                               args.view.width, args.view.height);
  const std::uint32_t kept_lanes = to_bits(kept);
  const auto kept_count = std::uint64_t(__builtin_popcount(kept_lanes));
  counters.back_face += std::uint64_t(__builtin_popcount(to_bits(culled)));
  counters.empty += std::uint64_t(__builtin_popcount(to_bits(facing))) - kept_count;
  counters.kept += kept_count;

  const std::uint32_t others = to_bits(candidates & !fits);
  const BoxLanes box = {x_min, x_max, y_min, y_max};
  if (others == 0 && count == Int::lanes) {
    // Straight to their places; what lies behind the last of them has room.
    if (kept_lanes == 0) return 0;
    setup_lanes(t, turned, area, Int(first) + lane_index(), [&](int part, const Float(&words)[4]) {
      const Float dense[4] = {compress(words[0], kept), compress(words[1], kept), compress(words[2], kept),
                              compress(words[3], kept)};
      scatter_quads(reinterpret_cast<float*>(args.out + before) + 4 * part, 12, dense);
    });
    if (args.touched != nullptr) {
      const TouchedLanes touched = touched_lanes(box, extent, args.view);
      store_pairs(args.touched + before, bits(compress(from_bits(touched.first), kept)),
                  bits(compress(from_bits(touched.last), kept)));
    }
    return static_cast<std::uint32_t>(kept_count);
  }

  SetupTriangle setup[Int::lanes];
  TouchedBox touched_box_of[Int::lanes];
  if (kept_lanes != 0) {
    setup_lanes(t, turned, area, Int(first) + lane_index(), [&](int part, const Float(&words)[4]) {
      scatter_quads(reinterpret_cast<float*>(setup) + 4 * part, 12, words);
    });
    const TouchedLanes touched = touched_lanes(box, extent, args.view);
    store_pairs(touched_box_of, touched.first, touched.last);
  }
  std::uint32_t written = before;
  for (std::uint32_t left = kept_lanes | others; left != 0; left &= left - 1) {
    const int i = __builtin_ctz(left);
    if ((kept_lanes >> i & 1) != 0) {
      if (args.touched != nullptr) args.touched[written] = touched_box_of[i];
      args.out[written++] = setup[i];
    } else {
      written += setup_one_more(args, pattern, extent, first + std::uint32_t(i), written);
    }
  }
  return written - before;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

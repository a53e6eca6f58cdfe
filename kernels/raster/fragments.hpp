// Fragments: what one triangle, or the finished tile, shows in each pixel.
#pragma once
#include "kernels/raster/coverage.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// The fragments of a vector of pixels, of which lanes see these samples.
TESSERA_INLINE std::uint32_t lane_fragments(std::uint32_t triangle, int first, Int samples, bool split, Fragment* out) {
  std::uint32_t count = 0, left = to_bits(samples != Int(0));
  if (left == 0) return 0;
  alignas(64) std::int32_t lane_samples[Int::lanes];
  store(lane_samples, samples);
  for (; left != 0; left &= left - 1) {
    const int i = __builtin_ctz(left);
    const auto pixel = static_cast<std::uint16_t>(first + i);
    auto bits = static_cast<std::uint32_t>(lane_samples[i]);
    if (!split) {
      out[count++] = {triangle, pixel, static_cast<std::uint16_t>(bits)};
      continue;
    }
    for (; bits != 0; bits &= bits - 1) out[count++] = {triangle, pixel, static_cast<std::uint16_t>(bits & -bits)};
  }
  return count;
}

/// A triangle's fragments that pass the depth test, pixels ascending, samples ascending in a pixel if split.
inline std::uint32_t triangle_fragments(const VisibilityTile& tile, const SetupTriangle& triangle,
                                        const SamplePattern& pattern, bool split, Fragment* out) {
  const TileBox box = tile_box(tile, triangle, sample_extent(pattern));
  if (box.empty()) return 0;
  TileEdges edges;
  make_edges(tile, triangle, pattern, edges);
  const BlockMasks blocks = classify_blocks(edges, box);
  const TriangleInTile t(tile, triangle, pattern, edges);
  std::uint32_t count = 0;
  const int x_first = box.x0 & -vector_width, y_first = box.y0 & -block_height;
  for (int block_y = y_first; block_y <= box.y1; block_y += block_height) {
    for (int x = x_first; x <= box.x1; x += vector_width) {
      const int block = block_y / block_height * block_columns + x / block_width;
      if ((blocks.alive >> block & 1) == 0) continue;
      const bool inside = (blocks.inside >> block & 1) != 0;
      for (int y = block_y; y < block_y + block_height; y += vector_height) {
        const Mask visible = t.visible(x, y);
        const int first = tile_pixel(x, y);
        Int samples(0);
        for (int s = 0; s < pattern.count; ++s) {
          const Mask covered = inside ? visible : visible & t.covered(x, y, s);
          if (none(covered)) continue;
          const std::size_t offset = std::size_t(s) * tile_pixels + std::size_t(first);
          const Mask pass = depth_test(covered, t.depth(x, y, s), load<Float>(tile.depth + offset),
                                       tile.triangle + offset, triangle.triangle);
          samples |= select(pass, Int(1 << s), Int(0));
        }
        count += lane_fragments(triangle.triangle, first, samples, split, out + count);
      }
    }
  }
  return count;
}

/// Writes the fragments that are kept. Tests depth again: the caller may have collected several triangles before it
/// commits them.
inline void write_fragments(const VisibilityTile& tile, const SetupTriangle& triangle, const SamplePattern& pattern,
                            const Fragment* fragments, const std::uint8_t* keep, std::uint32_t count) {
  const DepthPlane<float> plane(triangle);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (keep[i] == 0) continue;
    const int pixel = fragments[i].pixel, x = tile_pixel_x(pixel), y = tile_pixel_y(pixel);
    for (std::uint32_t left = fragments[i].samples; left != 0; left &= left - 1) {
      const int s = __builtin_ctz(left);
      const float along = plane.along_x(from_vertex(tile.x << subpixel_bits, x, pattern.x[s], triangle.x[0]));
      const float from_y = from_vertex(tile.y << subpixel_bits, y, pattern.y[s], triangle.y[0]);
      const float depth = plane.at(along, from_y);
      float& old_depth = tile.depth[s * tile_pixels + pixel];
      std::uint32_t& old_triangle = tile.triangle[s * tile_pixels + pixel];
      if (depth > old_depth || (depth == old_depth && triangle.triangle < old_triangle)) {
        old_depth = depth;
        old_triangle = triangle.triangle;
      }
    }
  }
}

/// The fragments of a vector of pixels whose samples all see the same: `triangle`, or nothing.
TESSERA_INLINE std::uint32_t uniform_fragments(Int triangle, int first, std::uint32_t samples, Fragment* out) {
  const Mask seen = triangle != Int(no_triangle);
  if (none(seen)) return 0;
  if (all(seen)) {  // a Fragment is two words: the triangle, and the pixel below the samples
    static_assert(offsetof(Fragment, pixel) == 4 && offsetof(Fragment, samples) == 6);
    store_pairs(out, triangle, lane_index() + Int(first + static_cast<std::int32_t>(samples << 16)));
    return std::uint32_t(Int::lanes);
  }
  alignas(64) std::int32_t pixels[Int::lanes], triangles[Int::lanes];
  const int n = compress_store(triangles, triangle, seen);
  compress_store(pixels, lane_index() + Int(first), seen);
  for (int i = 0; i < n; ++i)
    out[i] = {std::uint32_t(triangles[i]), static_cast<std::uint16_t>(pixels[i]), static_cast<std::uint16_t>(samples)};
  return static_cast<std::uint32_t>(n);
}

/// One sample per pixel: the pixels that are not empty.
inline std::uint32_t visible_single(const VisibilityTile& tile, Fragment* out) {
  std::uint32_t count = 0;
  const auto* plane = reinterpret_cast<const std::int32_t*>(tile.triangle);
  for (int first = 0; first < tile_pixels; first += Int::lanes)  // what lies outside of the visible part is empty
    count += uniform_fragments(load_int<Int>(plane + first), first, 1, out + count);
  return count;
}

/// The distinct triangles of one pixel, ascending, with their samples.
inline std::uint32_t pixel_fragments(const VisibilityTile& tile, int pixel, Fragment* out) {
  std::uint32_t count = 0;
  for (int s = 0; s < tile.samples; ++s) {
    const std::uint32_t triangle = tile.triangle[s * tile_pixels + pixel];
    if (triangle == no_triangle) continue;
    std::uint32_t at = 0;
    while (at < count && out[at].triangle < triangle) ++at;
    if (at == count || out[at].triangle != triangle) {
      for (std::uint32_t i = count++; i > at; --i) out[i] = out[i - 1];
      out[at] = {triangle, static_cast<std::uint16_t>(pixel), 0};
    }
    out[at].samples = static_cast<std::uint16_t>(out[at].samples | 1u << s);
  }
  return count;
}

inline std::uint32_t visible_multi(const VisibilityTile& tile, Fragment* out) {
  std::uint32_t count = 0;
  const auto all_samples = static_cast<std::uint16_t>((1u << tile.samples) - 1);
  const auto* plane = reinterpret_cast<const std::int32_t*>(tile.triangle);
  for (int first = 0; first < tile_pixels; first += Int::lanes) {
    const Int triangle = load_int<Int>(plane + first);
    Mask same(true);
    for (int s = 1; s < tile.samples; ++s) same &= load_int<Int>(plane + s * tile_pixels + first) == triangle;
    if (all(same)) {
      count += uniform_fragments(triangle, first, all_samples, out + count);
      continue;
    }
    const std::uint32_t uniform = to_bits(same), empty = to_bits(triangle == Int(no_triangle)) & uniform;
    for (std::uint32_t left = to_bits(Mask(true)) & ~empty; left != 0; left &= left - 1) {
      const int pixel = first + __builtin_ctz(left);
      if ((uniform & left & -left) != 0) {
        out[count++] = {tile.triangle[pixel], static_cast<std::uint16_t>(pixel), all_samples};
      } else {
        count += pixel_fragments(tile, pixel, out + count);
      }
    }
  }
  return count;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

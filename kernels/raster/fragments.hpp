// Fragments: what one triangle, or the finished tile, shows in each pixel.
#pragma once
#include "kernels/raster/coverage.hpp"

namespace tessera::TESSERA_ISA {
namespace {

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
  for (int y = box.y0; y <= box.y1; ++y) {
    for (int x = box.x0 & -Float::lanes; x <= box.x1; x += Float::lanes) {
      const int block = y / block_height * block_columns + x / block_width;
      if ((blocks.alive >> block & 1) == 0) continue;
      const bool inside = (blocks.inside >> block & 1) != 0;
      const Mask visible = t.lane < Int(tile.width - x);
      Int samples(0);
      for (int s = 0; s < pattern.count; ++s) {
        const Mask covered =
            inside ? visible : visible & ((t.edge(0, x, y, s) | t.edge(1, x, y, s) | t.edge(2, x, y, s)) >= Int(0));
        if (none(covered)) continue;
        const std::size_t offset = std::size_t(s) * tile_pixels + std::size_t(y) * tile_size + std::size_t(x);
        const Float depth = t.depth(t.along_x(x, s), y, s);
        const Mask pass =
            depth_test(covered, depth, load<Float>(tile.depth + offset), tile.triangle + offset, triangle.triangle);
        samples |= select(pass, Int(1 << s), Int(0));
      }
      std::uint32_t left = to_bits(samples != Int(0));
      if (left == 0) continue;
      alignas(64) std::int32_t lane_samples[Int::lanes];
      store(lane_samples, samples);
      for (; left != 0; left &= left - 1) {
        const int i = __builtin_ctz(left);
        const auto pixel = static_cast<std::uint16_t>(y * tile_size + x + i);
        auto bits = static_cast<std::uint32_t>(lane_samples[i]);
        if (!split) {
          out[count++] = {triangle.triangle, pixel, static_cast<std::uint16_t>(bits)};
          continue;
        }
        for (; bits != 0; bits &= bits - 1) {
          out[count++] = {triangle.triangle, pixel, static_cast<std::uint16_t>(bits & -bits)};
        }
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
    const int pixel = fragments[i].pixel, x = pixel % tile_size, y = pixel / tile_size;
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

/// One sample per pixel: the pixels that are not empty.
inline std::uint32_t visible_single(const VisibilityTile& tile, Fragment* out) {
  std::uint32_t count = 0;
  alignas(64) std::int32_t pixels[Int::lanes], triangles[Int::lanes];
  const auto* plane = reinterpret_cast<const std::int32_t*>(tile.triangle);
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; x += Int::lanes) {
      const int first = y * tile_size + x;
      const Int triangle = load_int<Int>(plane + first);
      const Mask seen = triangle != Int(no_triangle);
      if (none(seen)) continue;
      const int n = compress_store(triangles, triangle, seen);
      compress_store(pixels, lane_index() + Int(first), seen);
      for (int i = 0; i < n; ++i) {
        out[count++] = {std::uint32_t(triangles[i]), static_cast<std::uint16_t>(pixels[i]), 1};
      }
    }
  }
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
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; x += Int::lanes) {
      const int first = y * tile_size + x;
      const Int triangle = load_int<Int>(plane + first);
      Mask same(true);
      for (int s = 1; s < tile.samples; ++s) same &= load_int<Int>(plane + s * tile_pixels + first) == triangle;
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
  }
  return count;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

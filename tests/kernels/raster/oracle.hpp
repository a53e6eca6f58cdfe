// What rasterization must give, written from the definition in wide integers, one sample at a time.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "kernels/interface.hpp"

namespace tessera::raster_test {

/// SplitMix64 (Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  /// low to high, both included
  int between(int low, int high) {
    return low + static_cast<int>(next() % (static_cast<std::uint64_t>(std::int64_t{high} - low) + 1));
  }
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  float real(double low, double high) { return static_cast<float>(low + (high - low) * unit()); }

 private:
  std::uint64_t state_;
};

/// Positive for counter-clockwise on the screen (y down).
inline __int128 twice_area(const SetupTriangle& t) {
  return static_cast<__int128>(t.x[2] - t.x[0]) * (t.y[1] - t.y[0]) -
         static_cast<__int128>(t.x[1] - t.x[0]) * (t.y[2] - t.y[0]);
}

/// Whether a triangle of positive area covers a point (1/256 pixel). The top-left rule is the point moved right by an
/// infinitesimal amount, and down by one infinitely smaller still.
inline bool covers(const SetupTriangle& t, std::int64_t px, std::int64_t py) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const auto side = [&](std::int64_t x, std::int64_t y) {
      return static_cast<__int128>(x - t.x[i]) * (t.y[j] - t.y[i]) -
             static_cast<__int128>(y - t.y[i]) * (t.x[j] - t.x[i]);
    };
    const __int128 here = side(px, py);
    if (here > 0) continue;
    if (here < 0) return false;
    const __int128 right = side(px + 1, py);
    if (right > 0) continue;
    if (right < 0) return false;
    if (side(px, py + 1) <= 0) return false;
  }
  return true;
}

template <class T>
bool same_bits(const T* a, const T* b, std::size_t count) {
  return count == 0 || std::memcmp(a, b, count * sizeof(T)) == 0;
}

struct Tile {  // memory of a VisibilityTile
  std::vector<float> depth;
  std::vector<std::uint32_t> triangle;
  VisibilityTile view;

  Tile(int x, int y, int width, int height, int samples)
      : depth(std::size_t(samples) * tile_pixels),
        triangle(std::size_t(samples) * tile_pixels, no_triangle),
        view{x, y, width, height, samples, depth.data(), triangle.data()} {}
  Tile(const Tile&) = delete;
  Tile& operator=(const Tile&) = delete;
};

inline SetupTriangle make_triangle(int x0, int y0, int x1, int y1, int x2, int y2, std::uint32_t id = 0) {
  return {{x0, x1, x2}, {y0, y1, y2}, 0.5f, 0, 0, 0.5f, 0.5f, id};
}

/// Turns it round if needed; false if it has no area.
inline bool orient(SetupTriangle& t) {
  const __int128 area = twice_area(t);
  if (area < 0) {
    std::swap(t.x[1], t.x[2]);
    std::swap(t.y[1], t.y[2]);
  }
  return area != 0;
}

/// Depth at a sample: the formula of kernels/raster/edges.hpp, written out.
inline float depth_at(const SetupTriangle& t, std::int64_t px, std::int64_t py) {
  const float x = static_cast<float>(static_cast<double>(px - t.x[0]) / 256);
  const float y = static_cast<float>(static_cast<double>(py - t.y[0]) / 256);
  const float z = std::fma(t.depth_dy, y, std::fma(t.depth_dx, x, t.depth));
  return std::min(std::max(z, t.depth_min), t.depth_max);
}

/// What the tile must hold after all triangles, in any order.
inline void draw(const Tile& out, const SamplePattern& pattern, const std::vector<SetupTriangle>& triangles) {
  for (int s = 0; s < pattern.count; ++s)
    for (int y = 0; y < out.view.height; ++y)
      for (int x = 0; x < out.view.width; ++x) {
        const int i = s * tile_pixels + tile_pixel(x, y);
        const std::int64_t px = (out.view.x + x) * 256 + pattern.x[s], py = (out.view.y + y) * 256 + pattern.y[s];
        for (const SetupTriangle& t : triangles) {
          if (!covers(t, px, py)) continue;
          const float z = depth_at(t, px, py);
          if (z > out.view.depth[i] || (z == out.view.depth[i] && t.triangle < out.view.triangle[i])) {
            out.view.depth[i] = z;
            out.view.triangle[i] = t.triangle;
          }
        }
      }
}

/// Overlapping triangles of all sizes at a tile, with depth planes; some coplanar, so that depths are equal.
inline std::vector<SetupTriangle> random_soup(Random& random, int tile_x, int tile_y, int count) {
  std::vector<SetupTriangle> soup;
  while (static_cast<int>(soup.size()) < count) {
    const int extent = 256 << random.between(0, 6);
    const int x = tile_x * 256 + random.between(-extent, tile_size * 256);
    const int y = tile_y * 256 + random.between(-extent, tile_size * 256);
    const auto at = [&](int from) { return from + random.between(0, extent); };
    const int x0 = at(x), y0 = at(y), x1 = at(x), y1 = at(y), x2 = at(x);
    SetupTriangle t = make_triangle(x0, y0, x1, y1, x2, at(y), static_cast<std::uint32_t>(random.next() >> 33));
    if (!orient(t)) continue;
    if (random.between(0, 2) != 0) {
      t.depth = random.real(0.1, 0.9);
      t.depth_dx = random.real(-0.02, 0.02);
      t.depth_dy = random.real(-0.02, 0.02);
      t.depth_min = t.depth - random.real(0, 0.3);
      t.depth_max = t.depth + random.real(0, 0.3);
    }
    soup.push_back(t);
  }
  return soup;
}

}  // namespace tessera::raster_test

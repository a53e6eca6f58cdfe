// A cubemap of random texels and its lookups in double, written from the definition: bilinear in a face, linear between
// levels, seamless across faces.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "kernels/interface.hpp"

namespace tessera::test {

struct Direction {
  double x, y, z;
};

// Face and (s, t) in [0, 1] by the table of OpenGL and Vulkan.
inline int face_of(const Direction& d, double& s, double& t) {
  const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  int face = 0;
  double sc = 0, tc = 0, ma = 0;
  if (ax >= ay && ax >= az) {
    face = d.x < 0 ? 1 : 0, ma = ax, sc = d.x < 0 ? d.z : -d.z, tc = -d.y;
  } else if (ay >= az) {
    face = d.y < 0 ? 3 : 2, ma = ay, sc = d.x, tc = d.y < 0 ? -d.z : d.z;
  } else {
    face = d.z < 0 ? 5 : 4, ma = az, sc = d.z < 0 ? -d.x : d.x, tc = -d.y;
  }
  s = (sc / ma + 1) / 2;
  t = (tc / ma + 1) / 2;
  return face;
}

inline Direction direction_of(int face, double s, double t) {
  const double u = 2 * s - 1, v = 2 * t - 1;
  const Direction directions[6] = {{1, -v, -u}, {-1, -v, u}, {u, 1, v}, {u, -1, -v}, {u, -v, 1}, {-u, -v, -1}};
  return directions[face];
}

using Color = std::array<double, 3>;

// Random texels without borders; views with borders are made from them. Values are multiples of 3 below 2^9, so that
// the mean of three is a half, and a nine-bit mantissa, exactly.
class TestCube {
 public:
  explicit TestCube(int size) : size_(size) {
    std::mt19937 random(static_cast<unsigned>(size));
    for (int n = size; n >= 1; n /= 2) {
      levels_.emplace_back(std::size_t(6 * n * n));
      for (Color& texel : levels_.back())
        for (double& value : texel) value = 3.0 * (random() % 170);
    }
    const std::size_t texels = cube_texel_count(size, int(levels_.size()));
    halves_.resize(4 * texels);
    packed_.resize(2 * texels);
    for (int level = 0; level < int(levels_.size()); ++level) store_bordered(level);
  }

  CubeView view() const { return {halves_.data(), size_, int(levels_.size())}; }
  // The same values in words of 9 + 9 + 9 bits times 2^(24 - 24).
  CubeView packed_view() const { return {packed_.data(), size_, int(levels_.size()), CubeFormat::rgb9_e5}; }

  Color sample(const Direction& d, double lod) const {
    const double last = double(levels_.size() - 1);
    lod = !(lod > 0) ? 0 : std::min(lod, last);
    const int fine = int(lod);
    const double w = lod - fine;
    double s = 0, t = 0;
    const int face = face_of(d, s, t);
    const Color a = bilinear(fine, face, s, t), b = bilinear(std::min(fine + 1, int(last)), face, s, t);
    return {a[0] * (1 - w) + b[0] * w, a[1] * (1 - w) + b[1] * w, a[2] * (1 - w) + b[2] * w};
  }

 private:
  // A tap one step outside an edge is the neighbour's edge texel: found by walking over the edge in space.
  Color tap(int level, int face, int i, int j) const {
    const int n = size_ >> level;
    if (i < 0 || j < 0 || i >= n || j >= n) {
      const double beyond = 1e-7;
      const double s = i < 0 ? -beyond : i >= n ? 1 + beyond : (i + 0.5) / n;
      const double t = j < 0 ? -beyond : j >= n ? 1 + beyond : (j + 0.5) / n;
      double s2 = 0, t2 = 0;
      face = face_of(direction_of(face, s, t), s2, t2);
      i = std::clamp(int(std::floor(s2 * n)), 0, n - 1);
      j = std::clamp(int(std::floor(t2 * n)), 0, n - 1);
    }
    return levels_[std::size_t(level)][std::size_t((face * n + j) * n + i)];
  }

  // The four taps from (i, j) to (i + 1, j + 1): one outside two edges is the mean of the other three.
  std::array<Color, 4> footprint(int level, int face, int i, int j) const {
    const int n = size_ >> level;
    std::array<Color, 4> taps{};
    int corner = -1;
    for (int k = 0; k < 4; ++k) {
      const int x = i + k % 2, y = j + k / 2;
      if ((x < 0 || x >= n) && (y < 0 || y >= n)) {
        corner = k;
      } else {
        taps[std::size_t(k)] = tap(level, face, x, y);
      }
    }
    if (corner >= 0) {
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (int k = 0; k < 4; ++k)
          if (k != corner) sum += taps[std::size_t(k)][c];
        taps[std::size_t(corner)][c] = sum / 3;
      }
    }
    return taps;
  }

  Color bilinear(int level, int face, double s, double t) const {
    const int n = size_ >> level;
    const double x = s * n - 0.5, y = t * n - 0.5;
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const double wx = x - i, wy = y - j;
    const std::array<Color, 4> taps = footprint(level, face, i, j);
    Color result{};
    for (std::size_t c = 0; c < 3; ++c)
      result[c] = (taps[0][c] * (1 - wx) + taps[1][c] * wx) * (1 - wy) + (taps[2][c] * (1 - wx) + taps[3][c] * wx) * wy;
    return result;
  }

  void store_bordered(int level) {
    const int n = size_ >> level;
    for (int face = 0; face < 6; ++face) {
      for (int j = -1; j <= n; ++j) {
        for (int i = -1; i <= n; ++i) {
          // A footprint that holds (i, j), with at least one texel inside the face.
          const int left = std::min(i, n - 1), top = std::min(j, n - 1);
          const std::array<Color, 4> taps = footprint(level, face, left, top);
          const std::size_t k = std::size_t((j - top) * 2 + (i - left));
          const std::size_t at = cube_texel_index(size_, int(levels_.size()), level, face, i, j);
          for (std::size_t c = 0; c < 3; ++c) halves_[4 * at + c] = half(taps[k][c]);
          halves_[4 * at + 3] = half(1);
          const unsigned red = unsigned(taps[k][0]), green = unsigned(taps[k][1]), blue = unsigned(taps[k][2]);
          packed_[2 * at] = std::uint16_t((red + green * 512) % 65536);
          packed_[2 * at + 1] = std::uint16_t((green / 128 + blue * 4 + 24 * 2048) % 65536);
        }
      }
    }
  }

  // Integers up to 2048.
  static std::uint16_t half(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return value == 0 ? std::uint16_t{0} : std::uint16_t((exponent + 14) * 1024 + int(mantissa * 2048) - 1024);
  }

  int size_;
  std::vector<std::vector<Color>> levels_;
  std::vector<std::uint16_t> halves_, packed_;
};

}  // namespace tessera::test

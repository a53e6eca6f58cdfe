#include "precompute/cube.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include "base/half.hpp"
#include "base/parallel.hpp"

namespace tessera {
namespace {

constexpr std::uint16_t no_sign = 0x7fff;  // radiance is not below 0, and kernels read texels without their signs

struct TexelOfFace {
  int face, i, j;
};

struct FacePoint {
  int x, y, z;
};

// The point (s, t) of a face whose half width and distance are n.
FacePoint face_point(int face, int s, int t, int n) {
  switch (face) {
    case 0:
      return {n, -t, -s};
    case 1:
      return {-n, -t, s};
    case 2:
      return {s, n, t};
    case 3:
      return {s, -n, -t};
    case 4:
      return {s, -t, n};
    default:
      return {-s, -t, -n};
  }
}

// The texel across the edge from (i, j), which lies one step outside one edge of the face: the neighbour's edge texel
// with the same coordinate along the edge. In units of half a texel all is integer: a face is the plane at distance n,
// texel centres are odd numbers from 1 - n to n - 1, and a step outside ends at n + 1, which the larger axis tells.
TexelOfFace across_edge(int face, int i, int j, int n) {
  const auto [x, y, z] = face_point(face, 2 * i + 1 - n, 2 * j + 1 - n, n);
  TexelOfFace to{};
  int sc = 0, tc = 0;
  if (std::abs(x) > n) {
    to.face = x < 0 ? 1 : 0;
    sc = x < 0 ? z : -z, tc = -y;
  } else if (std::abs(y) > n) {
    to.face = y < 0 ? 3 : 2;
    sc = x, tc = y < 0 ? -z : z;
  } else {
    to.face = z < 0 ? 5 : 4;
    sc = z < 0 ? -x : x, tc = -y;
  }
  to.i = (std::clamp(sc, 1 - n, n - 1) + n - 1) / 2;
  to.j = (std::clamp(tc, 1 - n, n - 1) + n - 1) / 2;
  return to;
}

}  // namespace

void for_cube_rows(int size, const std::function<void(CubeRows)>& work) {
  const int rows = std::clamp(1024 / size, 1, size), pieces = (size + rows - 1) / rows;
  parallel_for(std::size_t{6} * std::size_t(pieces), [&](std::size_t i) {
    const int face = int(i) / pieces, begin = int(i) % pieces * rows;
    work({face, size, begin, std::min(begin + rows, size), nullptr});
  });
}

CubeDirection texel_direction(int face, int i, int j, int size) {
  const FacePoint p = face_point(face, 2 * i + 1 - size, 2 * j + 1 - size, size);
  const float n = float(size), length2 = float(p.x * p.x + p.y * p.y + p.z * p.z), length = std::sqrt(length2);
  return {float(p.x) / length, float(p.y) / length, float(p.z) / length, 4 * n / (length2 * length)};
}

FaceDirection face_direction(int face, double s, double t) {
  switch (face) {
    case 0:
      return {1, -t, -s};
    case 1:
      return {-1, -t, s};
    case 2:
      return {s, 1, t};
    case 3:
      return {s, -1, -t};
    case 4:
      return {s, -t, 1};
    default:
      return {-s, -t, -1};
  }
}

CubeLevel halved(const CubeLevel& level) {
  CubeLevel below(level.size / 2);
  const int n = level.size;
  const int half = below.size;
  // Solid angle of a texel up to a common factor: (1 + s^2 + t^2)^(-3/2) at its centre; the same on all faces.
  std::vector<float> squares(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const float s = float(2 * i + 1 - n) / float(n);
    squares[std::size_t(i)] = s * s;
  }
  parallel_for(std::size_t{6} * std::size_t(half), [&](std::size_t row) {
    const int face = int(row) / half, j = int(row) % half;
    const float* above = level.face(face) + 2 * std::size_t(j) * std::size_t(n) * 4;
    float* out = below.face(face) + std::size_t(j) * std::size_t(half) * 4;
    for (int i = 0; i < half; ++i, out += 4) {
      float sum[4] = {0, 0, 0, 0}, total = 0;
      for (int k = 0; k < 4; ++k) {
        const int dj = k >> 1;
        const std::size_t x = 2 * std::size_t(i) + std::size_t(k & 1), y = 2 * std::size_t(j) + std::size_t(dj);
        const float q = 1.0f + squares[x] + squares[y];
        const float weight = 1.0f / (q * std::sqrt(q));
        const float* texel = above + (std::size_t(dj) * std::size_t(n) + x) * 4;
        for (int c = 0; c < 4; ++c) sum[c] += weight * texel[c];
        total += weight;
      }
      for (int c = 0; c < 4; ++c) out[c] = sum[c] / total;
    }
  });
  return below;
}

Cube::Cube(int size, int levels) : texels_(cube_texel_count(size, levels) * 4), size_(size), levels_(levels) {
  assert(size >= 1 && size <= max_cube_size && (size & (size - 1)) == 0 && levels >= 1 && size >> (levels - 1) >= 1);
}

Cube::Cube(int size, int levels, AlignedVector<std::uint16_t> texels)
    : texels_(std::move(texels)), size_(size), levels_(levels) {
  assert(texels_.size() == cube_texel_count(size, levels) * 4);
  for (std::uint16_t& half : texels_) half &= no_sign;
}

std::size_t Cube::offset(int level, int face, int i, int j) const {
  return cube_texel_index(size_, levels_, level, face, i, j) * 4;
}

std::size_t Cube::store(int level, const CubeLevel& from, const Kernels& kernels) {
  assert(from.size == size_ >> level);
  const std::size_t n = std::size_t(from.size);
  std::vector<std::size_t> clamped(6 * n);
  parallel_for(6 * n, [&](std::size_t row) {
    const int face = int(row / n), j = int(row % n);
    const float* source = from.face(face) + std::size_t(j) * n * 4;
    AlignedVector<float> line(source, source + n * 4);
    AlignedVector<std::uint16_t> halves(n * 4);
    for (std::size_t i = 0; i < n; ++i) {
      float* texel = line.data() + i * 4;
      if (std::max({texel[0], texel[1], texel[2]}) <= max_half) continue;
      ++clamped[row];
      for (int c = 0; c < 3; ++c) texel[c] = std::min(texel[c], max_half);
    }
    kernels.pack_half(line.data(), halves.data(), n * 4);
    std::transform(halves.begin(), halves.end(), texel(level, face, 0, j),
                   [](std::uint16_t half) { return std::uint16_t(half & no_sign); });
  });
  for (int face = 0; face < 6; ++face) fill_border(level, face, kernels);
  return std::accumulate(clamped.begin(), clamped.end(), std::size_t{0});
}

CubeLevel Cube::load(int level, const Kernels& kernels) const {
  CubeLevel to(size_ >> level);
  const std::size_t row_floats = std::size_t(to.size) * 4;
  for (int row = 0; row < 6 * to.size; ++row)
    kernels.unpack_half(texels_.data() + offset(level, row / to.size, 0, row % to.size),
                        to.texels.data() + std::size_t(row) * row_floats, row_floats);
  return to;
}

void Cube::fill_border(int level, int face, const Kernels& kernels) {
  const int n = size_ >> level;
  const auto copy = [&](int i, int j) {
    const TexelOfFace to = across_edge(face, i, j, n);
    std::copy_n(texel(level, to.face, to.i, to.j), 4, texel(level, face, i, j));
  };
  for (int k = 0; k < n; ++k) {
    copy(-1, k);
    copy(n, k);
    copy(k, -1);
    copy(k, n);
  }
  // At a corner of the cube three faces meet: the fourth tap of a footprint there is the mean of the other three, which
  // are the same three from every side. Sums of three halves are exact in double, in any order.
  for (const int j : {-1, n}) {
    for (const int i : {-1, n}) {
      const int inner_i = i < 0 ? 0 : n - 1, inner_j = j < 0 ? 0 : n - 1;
      const std::uint16_t* taps[3] = {texel(level, face, inner_i, inner_j), texel(level, face, i, inner_j),
                                      texel(level, face, inner_i, j)};
      float mean[4];
      for (int c = 0; c < 4; ++c) {
        double sum = 0;
        for (const std::uint16_t* tap : taps) sum += double(half_to_float(tap[c]));
        mean[c] = float(sum / 3);
      }
      std::uint16_t halves[4];
      kernels.pack_half(mean, halves, 4);
      std::copy_n(halves, 4, texel(level, face, i, j));
    }
  }
}

}  // namespace tessera

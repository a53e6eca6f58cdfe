// Reads texels of a CubeView, for tests: geometry written out, independent of src/precompute.
#pragma once
#include <cmath>
#include <cstddef>

#include "base/half.hpp"
#include "kernels/interface.hpp"

namespace tessera::test {

struct Unit {
  double x, y, z;
};

inline double dot(const Unit& a, const Unit& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Centre of texel (i, j) of a face with n texels along its side; outside the face, of a texel in its plane.
inline Unit texel_centre(int face, int i, int j, int n) {
  const double s = (2 * i + 1.0) / n - 1, t = (2 * j + 1.0) / n - 1, length = std::sqrt(1 + s * s + t * t);
  const Unit points[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
  const Unit p = points[face];
  return {p.x / length, p.y / length, p.z / length};
}

/// Exact solid angle of a texel (Arvo 1995: the area of a rectangle seen from the cube's centre).
inline double texel_solid_angle(int i, int j, int n) {
  const auto corner = [&](int a, int b) {
    const double s = 2.0 * a / n - 1, t = 2.0 * b / n - 1;
    return std::atan2(s * t, std::sqrt(1 + s * s + t * t));
  };
  return corner(i + 1, j + 1) - corner(i, j + 1) - corner(i + 1, j) + corner(i, j);
}

/// Channel c of a texel; i and j from -1 to the level's size.
inline double texel_value(const CubeView& cube, int level, int face, int i, int j, int c) {
  const std::size_t texel = cube_texel_index(cube.size, cube.levels, level, face, i, j);
  return double(half_to_float(cube.texels[texel * 4 + std::size_t(c)]));
}

/// f(face, i, j) for every texel of a level.
template <class Function>
void for_each_texel(int n, const Function& f) {
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) f(face, i, j);
}

}  // namespace tessera::test

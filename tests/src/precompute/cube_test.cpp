#include "precompute/cube.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "frame/dispatch.hpp"
#include "src/precompute/cube_texels.hpp"

namespace tessera::test {
namespace {

CubeLevel random_level(int size) {
  CubeLevel level(size);
  std::mt19937 random(static_cast<unsigned>(size));
  for (float& value : level.texels) value = float(random() % 340) * 3;  // means of three are halves
  return level;
}

// The face and texel that a point just beyond an edge belongs to, by the largest coordinate.
void locate(const Unit& p, int n, int& face, int& i, int& j) {
  double best = -2;
  for (int f = 0; f < 6; ++f) {
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const double closeness = dot(p, texel_centre(f, x, y, n));
        if (closeness > best) best = closeness, face = f, i = x, j = y;
      }
  }
}

TEST(Cube, BordersHoldTheNearestTexelsOfTheNeighbours) {
  for (const int size : {1, 2, 4, 8}) {
    const CubeLevel level = random_level(size);
    Cube cube(size, 1);
    EXPECT_EQ(cube.store(0, level, select_kernels()), 0u);
    const CubeView view = cube.view();
    for (int face = 0; face < 6; ++face) {
      for (int j = -1; j <= size; ++j) {
        for (int i = -1; i <= size; ++i) {
          const bool out_i = i < 0 || i >= size, out_j = j < 0 || j >= size;
          for (int c = 0; c < 3; ++c) {
            double expected = 0;
            if (out_i && out_j) {
              const int ii = std::clamp(i, 0, size - 1), jj = std::clamp(j, 0, size - 1);
              expected = (texel_value(view, 0, face, ii, jj, c) + texel_value(view, 0, face, i, jj, c) +
                          texel_value(view, 0, face, ii, j, c)) /
                         3;
            } else {
              // Beyond the edge by a hair, at the texel's own coordinate along it: the closest texel over there.
              int f = face, x = i, y = j;
              if (out_i || out_j) {
                const double s = out_i ? (i < 0 ? -1.0001 : 1.0001) : (2 * i + 1.0) / size - 1;
                const double t = out_j ? (j < 0 ? -1.0001 : 1.0001) : (2 * j + 1.0) / size - 1;
                const Unit points[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
                // Half a texel further along its normal, in the plane across the edge.
                Unit p = points[face];
                const double inward = 1.0 / size;
                for (double* axis : {&p.x, &p.y, &p.z}) {
                  if (std::abs(*axis) == 1) *axis *= 1 - inward;
                }
                const double length = std::sqrt(dot(p, p));
                locate({p.x / length, p.y / length, p.z / length}, size, f, x, y);
              }
              expected = double(level.face(f)[(y * size + x) * 4 + c]);
            }
            ASSERT_EQ(texel_value(view, 0, face, i, j, c), expected) << size << " " << face << " " << i << " " << j;
          }
        }
      }
    }
  }
}

TEST(Cube, HalvingKeepsTheTotalOverTheSphere) {
  for (const int size : {2, 8, 64}) {
    const CubeLevel level = random_level(size);
    const CubeLevel below = halved(level);
    ASSERT_EQ(below.size, size / 2);
    const auto total = [](const CubeLevel& l) {
      double sum = 0;
      for_each_texel(l.size, [&](int face, int i, int j) {
        sum += double(l.face(face)[(j * l.size + i) * 4]) * texel_solid_angle(i, j, l.size);
      });
      return sum;
    };
    // Weights are solid angles at the texels' centres: off by a few percent on the coarsest faces.
    EXPECT_NEAR(total(below) / total(level), 1, 0.05 / size);
  }
}

TEST(Cube, TexelDirectionsAndSolidAngles) {
  for (const int size : {1, 2, 16, 256}) {
    double total = 0;
    for_each_texel(size, [&](int face, int i, int j) {
      const CubeDirection d = texel_direction(face, i, j, size);
      const Unit u = texel_centre(face, i, j, size);
      ASSERT_NEAR(double(d.x), u.x, 1e-6);
      ASSERT_NEAR(double(d.y), u.y, 1e-6);
      ASSERT_NEAR(double(d.z), u.z, 1e-6);
      const double exact = texel_solid_angle(i, j, size);
      ASSERT_NEAR(double(d.solid_angle) / exact, 1, 1.2 / (size * size) + 1e-6);
      total += exact;
    });
    EXPECT_NEAR(total, 4 * std::acos(-1.0), 1e-9);
  }
}

TEST(Cube, ClampsToTheLargestHalfAndCounts) {
  CubeLevel level(4);
  level.face(2)[0] = 1e6f;
  level.face(2)[1] = 65504;
  level.face(5)[4 * 7 + 2] = 65519;  // rounds to 65504, but is beyond it
  level.face(5)[4 * 8 + 2] = 65504;
  Cube cube(4, 3);
  EXPECT_EQ(cube.store(0, level, select_kernels()), 2u);
  EXPECT_EQ(texel_value(cube.view(), 0, 2, 0, 0, 0), 65504);
  EXPECT_EQ(texel_value(cube.view(), 0, 5, 3, 1, 2), 65504);
}

}  // namespace
}  // namespace tessera::test

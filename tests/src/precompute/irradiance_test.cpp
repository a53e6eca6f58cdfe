#include "precompute/irradiance.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "frame/dispatch.hpp"

namespace tessera {
namespace {

const double pi = std::acos(-1.0);

// E / pi = sum of these constants times integral of L times the basis function (Ramamoorthi and Hanrahan 2001, with the
// constants of the real spherical harmonics multiplied out).
std::array<double, 9> basis(double x, double y, double z) {
  return {1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y};
}
const std::array<double, 9> constants = {0.25, 0.5, 0.5, 0.5, 15.0 / 16, 15.0 / 16, 5.0 / 64, 15.0 / 16, 15.0 / 64};

TEST(Irradiance, WhiteIsOne) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {64, 32}, {1000, 501}}) {
    const std::vector<float> white(std::size_t(width * height * 3), 1.0f);
    const IrradianceSh sh = project_irradiance({white.data(), width, height}, 0.3f, select_kernels());
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(sh.coefficients[0][c], 1, 1e-6);
      for (int k = 1; k < 9; ++k) EXPECT_NEAR(sh.coefficients[k][c], 0, 1e-6) << width << " " << k;
    }
  }
}

// One texel at a time, integrated by a fine midpoint rule inside it.
TEST(Irradiance, IntegratesEachTexelExactly) {
  constexpr int width = 12, height = 6, fine = 200;
  const float rotation = 0.7f;
  for (const auto& [column, row] : {std::pair{0, 0}, {5, 2}, {11, 5}, {3, 3}}) {
    std::vector<float> texels(width * height * 3);
    texels[std::size_t((row * width + column) * 3 + 1)] = 2;
    const IrradianceSh sh = project_irradiance({texels.data(), width, height}, rotation, select_kernels());
    std::array<double, 9> sum{};
    for (int b = 0; b < fine; ++b) {
      for (int a = 0; a < fine; ++a) {
        const double theta = pi * (row + (b + 0.5) / fine) / height;
        const double phi = 2 * pi * ((column + (a + 0.5) / fine) / width - 0.5);
        // Column u lies along atan2(z, x) = 2 pi (u - 1/2); turning by an angle about +Y takes z towards x.
        const double sx = std::sin(theta) * std::cos(phi), sz = std::sin(theta) * std::sin(phi);
        const double x = sx * std::cos(rotation) + sz * std::sin(rotation);
        const double z = sz * std::cos(rotation) - sx * std::sin(rotation);
        const std::array<double, 9> f = basis(x, std::cos(theta), z);
        const double area = std::sin(theta) * (pi / height / fine) * (2 * pi / width / fine);
        for (std::size_t k = 0; k < 9; ++k) sum[k] += 2 * f[k] * area * constants[k] / pi;
      }
    }
    for (std::size_t k = 0; k < 9; ++k) {
      EXPECT_NEAR(double(sh.coefficients[k][1]), sum[k], 2e-6) << column << " " << row << " " << k;
      EXPECT_EQ(sh.coefficients[k][0], 0.0f);
    }
  }
}

TEST(IrradianceOfFaces, WhiteIsOne) {
  for (const int n : {1, 2, 5, 64, 200}) {
    const std::vector<float> white(std::size_t(n) * std::size_t(n) * 18, 1.0f);
    const IrradianceSh sh = project_irradiance(CubeFacesView{white.data(), n}, 0.3f, select_kernels());
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(sh.coefficients[0][c], 1, 1e-6);
      for (int k = 1; k < 9; ++k) EXPECT_NEAR(sh.coefficients[k][c], 0, 1e-6) << n << " " << k;
    }
  }
}

// A texel at a time, by a fine midpoint rule on the cube's face.
TEST(IrradianceOfFaces, IntegratesEachTexelExactly) {
  constexpr int n = 4, fine = 300;
  for (const int face : {0, 1, 2, 3, 4, 5}) {
    std::vector<float> texels(n * n * 18);
    texels[std::size_t(((face * n + 1) * n + 3) * 3 + 2)] = 5;
    const IrradianceSh sh = project_irradiance(CubeFacesView{texels.data(), n}, 0, select_kernels());
    std::array<double, 9> sum{};
    for (int b = 0; b < fine; ++b)
      for (int a = 0; a < fine; ++a) {
        const double s = (3 + (a + 0.5) / fine) * 2 / n - 1, t = (1 + (b + 0.5) / fine) * 2 / n - 1;
        const double points[6][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
        const double l2 = 1 + s * s + t * t, l = std::sqrt(l2), area = 4.0 / (n * n * fine * fine) / (l2 * l);
        const std::array<double, 9> f = basis(points[face][0] / l, points[face][1] / l, points[face][2] / l);
        for (std::size_t k = 0; k < 9; ++k) sum[k] += 5 * f[k] * area * constants[k] / pi;
      }
    for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(double(sh.coefficients[k][2]), sum[k], 2e-6) << face << " " << k;
  }
}

// Sloan's window by hand; L_lm of a constant is L sqrt(4 pi) in the first band and 0 in the others.
TEST(Irradiance, WindowAndRadianceHarmonics) {
  IrradianceSh sh;
  for (auto& row : sh.coefficients) row[0] = row[1] = row[2] = 1;
  const IrradianceSh damped = windowed(sh, 0.05f);
  EXPECT_EQ(damped.coefficients[0][0], 1.0f);
  EXPECT_NEAR(damped.coefficients[2][1], 1 / (1 + 0.05 * 1 * 4), 1e-6);
  EXPECT_NEAR(damped.coefficients[8][2], 1 / (1 + 0.05 * 4 * 9), 1e-6);
  EXPECT_LT(least_irradiance(sh), least_irradiance(damped));

  // c + d z as radiance: L_00 = c sqrt(4 pi), L_10 = d sqrt(4 pi / 3); its irradiance over pi is c + 2/3 d z.
  IrradianceSh linear;
  linear.coefficients[0][0] = 3;
  linear.coefficients[2][0] = float(2.0 / 3 * 0.5);
  const IrradianceSh radiance = radiance_harmonics(linear);
  EXPECT_NEAR(radiance.coefficients[0][0], 3 * std::sqrt(4 * pi), 1e-5);
  EXPECT_NEAR(radiance.coefficients[2][0], 0.5 * std::sqrt(4 * pi / 3), 1e-5);
  EXPECT_NEAR(least_irradiance(linear), 1 - 1.0 / 9, 1e-3);
}

}  // namespace
}  // namespace tessera

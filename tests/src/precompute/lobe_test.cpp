#include "precompute/lobe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "frame/dispatch.hpp"
#include "reference/microfacet.hpp"
#include "reference/quadrature.hpp"

namespace tessera {
namespace {

const double pi = std::acos(-1.0);

// D(h) n.l for n = v, with the half-vector at half of l's angle.
double lobe_at(double theta_l, double alpha) {
  return reference::ggx_distribution(theta_l / 2, alpha) * std::cos(theta_l);
}
double integral_to(double end, double alpha) {
  return reference::integrate([&](double t) { return lobe_at(t, alpha) * 2 * pi * std::sin(t); }, 0, end, 32, 64);
}

TEST(GgxLobe, PointsCarryTheLobesWeight) {
  for (const float r : {0.15f, 0.5f, 1.0f}) {
    const double alpha = double(r) * double(r);
    const Lobe lobe = ggx_lobe(r, 1024, 128, select_kernels());
    const double whole = integral_to(pi / 2, alpha);
    double total = 0, mean_x = 0, mean_y = 0;
    for (std::size_t i = 0; i < lobe.x.size(); ++i) {
      const double x = double(lobe.x[i]), y = double(lobe.y[i]), z = double(lobe.z[i]);
      ASSERT_NEAR(x * x + y * y + z * z, 1, 1e-6);
      ASSERT_GT(z, 0);
      total += double(lobe.weight[i]);
      mean_x += double(lobe.weight[i]) * x;
      mean_y += double(lobe.weight[i]) * y;
    }
    EXPECT_NEAR(total, 1, 1e-6);
    EXPECT_NEAR(mean_x, 0, 1e-3);
    EXPECT_NEAR(mean_y, 0, 1e-3);
    for (const double share : {0.2, 0.5, 0.9}) {
      const double angle = share * pi / 2;
      double inside = 0;
      for (std::size_t i = 0; i < lobe.z.size(); ++i) {
        if (double(lobe.z[i]) > std::cos(angle)) inside += double(lobe.weight[i]);
      }
      EXPECT_NEAR(inside, integral_to(angle, alpha) / whole, 2e-3) << r << " " << share;
    }
    // The closed form that bright texels are weighted with.
    for (const double angle : {0.0, 0.05, 0.5, 1.5}) {
      const double t = double(lobe.alpha2) + (1 - double(lobe.alpha2)) * (1 - std::cos(angle)) / 2;
      EXPECT_NEAR(double(lobe.scale) * std::cos(angle) / (t * t) / (lobe_at(angle, alpha) / whole), 1, 1e-4);
    }
  }
}

// 4 pi / (6 N^2) for a texel; a point's share of the sphere is one over the density of points there.
TEST(GgxLobe, ReadsTheLevelThatAPointStandsFor) {
  constexpr int count = 512, size = 256;
  const double alpha = 0.25;
  const Lobe lobe = ggx_lobe(0.5f, count, size, select_kernels());
  const double above = 1 / (1 + alpha * alpha);  // share of half-vectors that reflect above the horizon
  for (std::size_t i = 0; i < count; i += 37) {
    const double density = reference::ggx_distribution(std::acos(double(lobe.z[i])) / 2, alpha) / 4 / above;
    const double solid_angle = 1 / (count * density), texel = 4 * pi / (6.0 * size * size);
    EXPECT_NEAR(double(lobe.lod[i]), 0.5 * std::log2(solid_angle / texel), 2e-3);
  }
}

}  // namespace
}  // namespace tessera

#include "reference/convolution.hpp"

#include <gtest/gtest.h>

#include <array>

namespace tessera::reference {
namespace {

// Of radiance 2 + 1.5 d.y the lobe leaves 2 + 1.5 g n.y, g the lobe's mean cosine: an integral over one angle.
double mean_cosine(double roughness) {
  const double alpha2 = std::pow(roughness, 4);
  double sum = 0, weights = 0;
  constexpr int steps = 200000;
  for (int k = 0; k < steps; ++k) {
    const double c = (k + 0.5) / steps, cos2_h = std::pow(std::cos(std::acos(c) / 2), 2);
    const double weight = c / std::pow(cos2_h * (alpha2 - 1) + 1, 2);
    sum += c * weight;
    weights += weight;
  }
  return sum / weights;
}

TEST(Convolution, LinearRadianceShrinksByTheMeanCosine) {
  constexpr int n = 128;
  SpherePicture faces{n, 6 * n, {}, true};
  for (int row = 0; row < 6 * n; ++row)
    for (int i = 0; i < n; ++i) {
      const Vec3 d = cube_texel_direction(row / n, i, row % n, n);
      EXPECT_NEAR(length(d), 1, 1e-14);
      faces.rgb.insert(faces.rgb.end(), {1, float(2 + 1.5 * d.y), float(1 + d.x)});
    }
  const CubeSum sum(faces);
  const std::array<Vec3, 17> axes = [] {
    std::array<Vec3, 17> list;
    for (std::size_t k = 0; k < list.size(); ++k) list[k] = from_angles(0.1 + 0.17 * double(k), 1.3 * double(k));
    return list;
  }();
  for (const double r : {0.3, 0.6, 1.0}) {
    const double g = mean_cosine(r);
    const std::vector<Vec3> found = sum.convolved(axes, r);
    ASSERT_EQ(found.size(), axes.size());
    for (std::size_t k = 0; k < axes.size(); ++k) {
      EXPECT_NEAR(found[k].x, 1, 1e-12);
      EXPECT_NEAR(found[k].y, 2 + 1.5 * g * axes[k].y, 1e-4) << r;
      EXPECT_NEAR(found[k].z, 1 + g * axes[k].x, 1e-4) << r;
    }
  }
}

}  // namespace
}  // namespace tessera::reference

#define TESSERA_ISA blending_test
#include "kernels/bsdf/blending.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reference/microfacet.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;

struct Geometry {
  double NoH, sin2, NoV, NoL, lobe_a, lobe_b;  // with D V of each layer by the reference
};

// A pair of directions, as the reference takes them.
Geometry geometry(std::mt19937& random, double alpha_a, double alpha_b) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto direction = [&] { return reference::from_angles(1.5 * unit(random), 6.28 * unit(random)); };
  const reference::Vec3 v = direction(), l = direction(), h = reference::normalize(v + l);
  return {h.z,
          h.x * h.x + h.y * h.y,
          v.z,
          l.z,
          reference::specular_brdf_over_fresnel(v, l, alpha_a),
          reference::specular_brdf_over_fresnel(v, l, alpha_b)};
}

TEST(Blending, EndsOfTheMaskAreTheLayers) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const double a = 0.3, b = 0.8;
    const Geometry g = geometry(random, a * a, b * b);
    for (const auto blend : {kernel::blend_Shaded<double>, kernel::blend_Roughness<double>, kernel::blend_Alpha<double>,
                             kernel::blend_Variance<double>}) {
      EXPECT_NEAR(blend(g.NoH, g.sin2, g.NoV, g.NoL, a, b, 0.0) / g.lobe_a, 1, 1e-9);
      EXPECT_NEAR(blend(g.NoH, g.sin2, g.NoV, g.NoL, a, b, 1.0) / g.lobe_b, 1, 1e-9);
      EXPECT_NEAR(blend(g.NoH, g.sin2, g.NoV, g.NoL, b, b, 0.37) / g.lobe_b, 1, 1e-9);
    }
  }
}

TEST(Blending, ShadedIsTheMixtureOfTheLobes) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const Geometry g = geometry(random, 0.01, 0.49);
    const double mixed = 0.25 * g.lobe_a + 0.75 * g.lobe_b;
    EXPECT_NEAR(kernel::blend_Shaded(g.NoH, g.sin2, g.NoV, g.NoL, 0.1, 0.7, 0.75) / mixed, 1, 1e-9);
  }
}

// Each form uses the alpha that it says, at half the mask.
TEST(Blending, MiddlesAreTheirMeans) {
  std::mt19937 random(3);
  const double a = 0.2, b = 0.9, mean_r = std::pow((a + b) / 2, 2), mean_alpha = (a * a + b * b) / 2,
               mean_variance = std::sqrt((std::pow(a, 4) + std::pow(b, 4)) / 2);
  EXPECT_LT(mean_r, mean_alpha);
  EXPECT_LT(mean_alpha, mean_variance);
  for (int i = 0; i < 100; ++i) {
    Geometry g = geometry(random, mean_r, mean_alpha);
    EXPECT_NEAR(kernel::blend_Roughness(g.NoH, g.sin2, g.NoV, g.NoL, a, b, 0.5) / g.lobe_a, 1, 1e-9);
    EXPECT_NEAR(kernel::blend_Alpha(g.NoH, g.sin2, g.NoV, g.NoL, a, b, 0.5) / g.lobe_b, 1, 1e-9);
    g = geometry(random, mean_variance, 1);
    EXPECT_NEAR(kernel::blend_Variance(g.NoH, g.sin2, g.NoV, g.NoL, a, b, 0.5) / g.lobe_a, 1, 1e-9);
  }
}

TEST(Blending, ParametersAndF0) {
  const kernel::LayerParameters<double> a = {{1, 0.5, 0}, 1, 0.2, 1}, b = {{0, 0.5, 1}, 0, 0.6, 0.5};
  const auto middle = kernel::blend_layers(a, b, 0.25);
  EXPECT_DOUBLE_EQ(middle.base_color.x, 0.75);
  EXPECT_DOUBLE_EQ(middle.base_color.z, 0.25);
  EXPECT_DOUBLE_EQ(middle.metallic, 0.75);
  EXPECT_DOUBLE_EQ(middle.roughness, 0.3);
  EXPECT_DOUBLE_EQ(middle.cavity, 0.875);
  // White metal over black dielectric, half and half: F0 is 0.52; of the blended parameters 0.27.
  EXPECT_DOUBLE_EQ(kernel::blend_F0(1.0, 1.0, 0.0, 0.0, 0.5), 0.52);
  EXPECT_DOUBLE_EQ(kernel::blend_F0Parameters(1.0, 1.0, 0.0, 0.0, 0.5), 0.27);
  // Of one kind both, the two agree.
  EXPECT_NEAR(kernel::blend_F0Parameters(0.9, 1.0, 0.3, 1.0, 0.4), kernel::blend_F0(0.9, 1.0, 0.3, 1.0, 0.4), 1e-15);
}

}  // namespace
}  // namespace tessera::test

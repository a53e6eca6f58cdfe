#define TESSERA_ISA color_test
#include "kernels/math/color.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tessera::TESSERA_ISA {
namespace {

TEST(Color, TransferFunctionsMeetWhiteBlackAndTheKnee) {
  EXPECT_EQ(srgb_to_linear(0.0f), 0);
  EXPECT_NEAR(srgb_to_linear(1.0f), 1, 1e-6);
  EXPECT_NEAR(linear_to_srgb(1.0f), 1, 1e-6);
  EXPECT_NEAR(srgb_to_linear(0.5), 0.21404114048, 1e-10);  // a commonly printed value
  EXPECT_NEAR(srgb_to_linear(0.04045f), srgb_to_linear(0.0404501f), 1e-7);
}

TEST(Color, EveryByteSurvivesTheRoundTrip) {
  for (int i = 0; i < 256; ++i) {
    const float back = linear_to_srgb(srgb_to_linear(static_cast<float>(i) / 255.0f));
    EXPECT_EQ(static_cast<int>(back * 255 + 0.5f), i);
  }
}

TEST(Color, IncreasesEverywhere) {
  float last_linear = -1, last_encoded = -1;
  for (int i = 0; i <= 100000; ++i) {
    const float x = static_cast<float>(i) / 100000.0f, linear = srgb_to_linear(x), encoded = linear_to_srgb(x);
    EXPECT_GT(linear, last_linear) << x;
    EXPECT_GT(encoded, last_encoded) << x;
    last_linear = linear;
    last_encoded = encoded;
  }
}

TEST(Color, OutOfRangeInputs) {
  EXPECT_LT(srgb_to_linear(-0.5f), 0);
  EXPECT_TRUE(std::isfinite(srgb_to_linear(__builtin_inff())));
  EXPECT_TRUE(std::isfinite(linear_to_srgb(__builtin_inff())));
  EXPECT_TRUE(std::isnan(srgb_to_linear(__builtin_nanf(""))));
  EXPECT_TRUE(std::isnan(linear_to_srgb(__builtin_nanf(""))));
}

TEST(Color, LuminanceOfWhiteIsOne) {
  EXPECT_NEAR(luminance(Vec3<double>{1, 1, 1}), 1, 1e-12);
  EXPECT_GT(luminance(Vec3<double>{0, 1, 0}), luminance(Vec3<double>{1, 0, 0}));
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

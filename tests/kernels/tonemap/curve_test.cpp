#define TESSERA_ISA curve_test
#include "kernels/tonemap/curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tessera::TESSERA_ISA {
namespace {

using Color = Vec3<double>;

TEST(ToneCurve, ReinhardIsHalfAtOne) {
  const Color c = tone_reinhard(Color{0, 1, 3});
  EXPECT_DOUBLE_EQ(c.x, 0);
  EXPECT_DOUBLE_EQ(c.y, 0.5);
  EXPECT_DOUBLE_EQ(c.z, 0.75);
}

TEST(ToneCurve, AcesFitsItsPrintedFormula) {
  for (const double x : {0.0, 0.01, 0.18, 1.0, 10.0}) {
    const double expected = (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
    EXPECT_NEAR(tone_aces(Color{x, x, x}).y, expected, 1e-12);
  }
  EXPECT_NEAR(tone_aces(1e6), 2.51 / 2.43, 1e-5);  // its limit is above 1: encode clamps
}

// Written from the specification's text, channel by channel.
void neutral_reference(const double in[3], double out[3]) {
  const double f90 = 0.04, ks = 0.8 - f90, kd = 0.15;
  const double x = std::min({in[0], in[1], in[2]});
  const double f = x <= 2 * f90 ? x - x * x / (4 * f90) : f90;
  const double p = std::max({in[0], in[1], in[2]}) - f;
  for (int k = 0; k < 3; ++k) {
    if (p <= ks) {
      out[k] = in[k] - f;
    } else {
      const double pn = 1 - (1 - ks) * (1 - ks) / (p + 1 - 2 * ks);
      const double g = 1 / (kd * (p - pn) + 1);
      out[k] = (in[k] - f) * (pn / p) * g + pn * (1 - g);
    }
  }
}

TEST(ToneCurve, KhronosNeutralFollowsItsSpecification) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-8, 6);
  for (int round = 0; round < 10000; ++round) {
    const double in[3] = {std::exp2(exponent(random)), std::exp2(exponent(random)), std::exp2(exponent(random))};
    double expected[3];
    neutral_reference(in, expected);
    const Color exact = tone_khronos_neutral(Color{in[0], in[1], in[2]});
    const Vec3<float> single = tone_khronos_neutral(
        Vec3<float>{static_cast<float>(in[0]), static_cast<float>(in[1]), static_cast<float>(in[2])});
    const double got[3] = {exact.x, exact.y, exact.z}, got_float[3] = {single.x, single.y, single.z};
    for (int k = 0; k < 3; ++k) {
      ASSERT_NEAR(got[k], expected[k], 1e-12);
      ASSERT_NEAR(got_float[k], expected[k], 5e-7);
      ASSERT_TRUE(got[k] >= 0 && got[k] <= 1);
    }
  }
}

TEST(ToneCurve, KhronosNeutralKeepsBaseColours) {
  // A diffuse base colour b under a white furnace of 1 reflects b + 0.04 or so: it comes out as b.
  const Color c = tone_khronos_neutral(Color{0.24, 0.54, 0.64});
  EXPECT_NEAR(c.x, 0.2, 1e-12);
  EXPECT_NEAR(c.y, 0.5, 1e-12);
  EXPECT_NEAR(c.z, 0.6, 1e-12);
}

TEST(ToneCurve, IncreaseAndStayFinite) {
  double last[3] = {-1, -1, -1};
  for (double x = 1e-4; x <= 1e18; x *= 1.5) {
    const float f = static_cast<float>(x);
    const double now[3] = {tone_reinhard(Vec3<float>{f, f, f}).x, tone_aces(f),
                           tone_khronos_neutral(Vec3<float>{f, f, f}).x};
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(std::isfinite(now[k])) << x;
      EXPECT_GE(now[k], last[k] - 1e-6) << x;
      last[k] = now[k];
    }
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

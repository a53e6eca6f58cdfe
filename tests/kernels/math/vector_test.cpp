#define TESSERA_ISA vector_test
#include "kernels/math/vector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tessera::TESSERA_ISA {
namespace {

TEST(Vector, ProductsOfTheAxes) {
  const Vec3<float> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Vec3<float> xy = cross(x, y), yz = cross(y, z), zx = cross(z, x);
  EXPECT_EQ(dot(xy, z), 1);
  EXPECT_EQ(dot(yz, x), 1);
  EXPECT_EQ(dot(zx, y), 1);
  EXPECT_EQ(dot(x, y) + dot(y, z) + dot(z, x), 0);
}

TEST(Vector, CrossOfNearlyParallelVectorsKeepsItsDigits) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> component(-1, 1);
  for (int round = 0; round < 10000; ++round) {
    const Vec3<float> a{component(random), component(random), component(random)};
    const Vec3<float> b{a.x + 1e-6f * component(random), a.y + 1e-6f * component(random), a.z};
    const Vec3<float> c = cross(a, b);
    // Products of floats are exact in double.
    const double exact = double{a.x} * b.y - double{a.y} * b.x;
    ASSERT_LE(std::fabs(c.z - exact), 1.5 * 0x1p-23 * std::fabs(exact));
  }
}

TEST(Vector, NormalizedIsOfUnitLengthAndSameDirection) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> component(-1, 1), exponent(-55, 55);
  for (int round = 0; round < 10000; ++round) {
    const float scale = std::exp2(exponent(random));
    const Vec3<float> a{scale * component(random), scale * component(random), scale * component(random)};
    const Vec3<float> n = normalize(a);
    const double size = std::hypot(double{a.x}, double{a.y}, double{a.z});
    ASSERT_NEAR(n.x, a.x / size, 2e-7);
    ASSERT_NEAR(n.y, a.y / size, 2e-7);
    ASSERT_NEAR(n.z, a.z / size, 2e-7);
    ASSERT_NEAR(length(n), 1, 3e-7);
  }
}

TEST(Vector, NormalizeFallsBackWhereThereIsNoDirection) {
  const float bad[] = {0.0f, 1e-30f, 1e30f, __builtin_inff(), __builtin_nanf("")};
  for (const float b : bad) {
    const Vec3<float> n = normalize(Vec3<float>{0, b, 0}), own = normalize(Vec3<float>{b, 0, 0}, {0, 1, 0});
    EXPECT_TRUE(n.x == 0 && n.y == 0 && n.z == 1) << b;
    EXPECT_TRUE(own.x == 0 && own.y == 1 && own.z == 0) << b;
  }
}

TEST(Vector, LerpMeetsItsEnds) {
  EXPECT_EQ(lerp(2.0f, 5.0f, 0.0f), 2);
  EXPECT_EQ(lerp(2.0f, 5.0f, 1.0f), 5);
  const Vec3<float> middle = lerp(Vec3<float>{0, 2, -4}, Vec3<float>{1, 4, 4}, 0.5f);
  EXPECT_EQ(middle.x, 0.5f);
  EXPECT_EQ(middle.y, 3);
  EXPECT_EQ(middle.z, 0);
}

TEST(Vector, DotIsFusedInTheOrderXyz) {
  const Vec3<float> a{0x1.000002p0f, 0x1.000002p0f, 1}, b{0x1.000002p0f, -0x1.000002p0f, 0};
  // x x' is rounded, the rest is fused: what remains is the rounding error of x x'.
  const double error = double{a.x * b.x} - double{a.x} * b.x;
  EXPECT_NE(error, 0);
  EXPECT_EQ(dot(a, b), error);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

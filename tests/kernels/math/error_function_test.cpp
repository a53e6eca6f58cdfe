#define TESSERA_ISA error_function_test
#include "kernels/math/error_function.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;

TEST(Erf, SpecialValuesAreThoseOfC) {
  constexpr float inf = std::numeric_limits<float>::infinity(), denormal = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(kernel::erf(inf), 1.0f);
  EXPECT_EQ(kernel::erf(-inf), -1.0f);
  EXPECT_EQ(kernel::erf(3.4e38f), 1.0f);
  EXPECT_TRUE(std::isnan(kernel::erf(std::nanf(""))));
  EXPECT_FALSE(std::signbit(kernel::erf(0.0f)));
  EXPECT_TRUE(std::signbit(kernel::erf(-0.0f)));
  EXPECT_EQ(kernel::erf(denormal), denormal);
}

// It never falls by more than a rounding, and never leaves [-1, 1]; by ulps where its two pieces meet.
TEST(Erf, RisesAndStaysBelowOne) {
  const auto walk = [](float from, float to, float stride) {
    float previous = kernel::erf(from);
    for (float x = from; x < to; x = std::max(x * stride, std::nextafter(x, 10.0f))) {
      const float value = kernel::erf(x);
      ASSERT_GE(value, previous - 6e-8f) << x;
      ASSERT_LE(value, 1.0f) << x;
      previous = value;
    }
  };
  walk(0.999f, 1.001f, 1);
  walk(1e-6f, 10, 1.00003f);
}

TEST(Erf, SameBitsOnEveryInstructionSet) {
  std::vector<float> x;
  for (int i = 0; i < 20003; ++i) x.push_back(float(i - 10000) * 5e-4f);
  for (const Kernels* kernels : runnable_kernels()) {
    const auto value = evaluate_term(*kernels, "erf", {&x});
    for (std::size_t i = 0; i < x.size(); ++i)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(value[i]), std::bit_cast<std::uint32_t>(kernel::erf(x[i]))) << x[i];
  }
}

}  // namespace
}  // namespace tessera::test

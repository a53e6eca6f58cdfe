// Special values as C has them, and one result for every instruction set, vector position and plain float.
#define TESSERA_ISA scalar_test
#include "kernels/math/approx.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "kernels/math/color.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera {
namespace {

namespace scalar = TESSERA_ISA;
constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float denormal = std::numeric_limits<float>::denorm_min();
const float specials[] = {0.0f,      -0.0f,    denormal, -denormal, 1e-40f, 0.5f, -0.5f, 1,     -1,
                          1.5f,      -1.5f,    2,        -2,        3,      -3,   2.5f,  -2.5f, 16777215,
                          -16777215, 16777216, 3e38f,    -3e38f,    inf,    -inf, nan};

struct Row {
  const char* name;
  MathFunction function;
  float (*scalar)(float, float);
  double (*libm)(double, double);  // null: C has none; those rows are the last two
};
#define UNARY(name)                                                                                   \
  {                                                                                                   \
#name, MathFunction::name,                                                                        \
        [](float x, float) { return scalar::name(x); }, [](double x, double) { return std::name(x); } \
  }
#define BINARY(name)                                                                                            \
  {                                                                                                             \
#name, MathFunction::name,                                                                                  \
        [](float x, float y) { return scalar::name(x, y); }, [](double x, double y) { return std::name(x, y); } \
  }
const Row rows[] = {
    UNARY(exp2),
    UNARY(log2),
    UNARY(exp),
    UNARY(log),
    BINARY(pow),
    UNARY(sin),
    UNARY(cos),
    UNARY(tan),
    UNARY(asin),
    UNARY(acos),
    BINARY(atan2),
    UNARY(cbrt),
    {"srgb_to_linear", MathFunction::srgb_to_linear, [](float x, float) { return scalar::srgb_to_linear(x); }, nullptr},
    {"linear_to_srgb", MathFunction::linear_to_srgb, [](float x, float) { return scalar::linear_to_srgb(x); }, nullptr},
};

struct Approx : testing::TestWithParam<Row> {};
struct ApproxInC : Approx {};

std::string printed(const testing::TestParamInfo<Row>& info) { return info.param.name; }

TEST_P(ApproxInC, SpecialValuesAreThoseOfC) {
  const Row& row = GetParam();
  const bool trigonometric =
      row.function == MathFunction::sin || row.function == MathFunction::cos || row.function == MathFunction::tan;
  for (const Kernels* kernels : runnable_kernels())
    for (const float x : specials)
      for (const float y : specials) {
        if (trigonometric && std::isfinite(x) && std::fabs(x) > 131072) continue;
        float out;
        kernels->evaluate(row.function, &x, &y, &out, 1);
        const float expected = static_cast<float>(row.libm(x, y));
        if (std::isnan(expected)) {
          EXPECT_TRUE(std::isnan(out)) << kernels->isa << " " << x << ", " << y << ": " << out;
        } else if (expected == 0 || std::isinf(expected)) {
          EXPECT_EQ(std::bit_cast<std::uint32_t>(out), std::bit_cast<std::uint32_t>(expected))
              << kernels->isa << " " << x << ", " << y << ": " << out << ", not " << expected;
        } else {
          EXPECT_NEAR(out, expected, std::fabs(expected) * 3e-7 + denormal) << kernels->isa << " " << x << ", " << y;
        }
      }
}

// Any bit patterns at all; counts that leave every length of tail.
TEST_P(Approx, OneResultOnEveryInstructionSetAndForPlainFloat) {
  const Row& row = GetParam();
  constexpr std::size_t count = 100003;
  std::mt19937 random(9);
  std::vector<float> a(count), b(count);
  for (std::size_t i = 0; i < count; ++i) {
    // Every other pair of a moderate size, where the functions have most of their branches.
    const std::uint32_t any_a = static_cast<std::uint32_t>(random()), any_b = static_cast<std::uint32_t>(random());
    a[i] = std::bit_cast<float>(i % 2 ? any_a : (any_a & 0x80ffffff) | std::uint32_t(0x3a + i / 2 % 10) << 24);
    b[i] = std::bit_cast<float>(i % 2 ? any_b : (any_b & 0x80ffffff) | std::uint32_t(0x3a + i / 3 % 10) << 24);
  }
  std::vector<float> expected(count), out(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float value = row.scalar(a[i], b[i]);
    expected[i] = std::isnan(value) ? nan : value;
  }
  for (const Kernels* kernels : runnable_kernels()) {
    for (std::size_t start = 0, length = 1; start < count; start += length, length = length % 37 + 1) {
      const std::size_t n = std::min(length, count - start);
      kernels->evaluate(row.function, a.data() + start, b.data() + start, out.data() + start, n);
    }
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (std::bit_cast<std::uint32_t>(out[i]) != std::bit_cast<std::uint32_t>(expected[i]) && wrong++ == 0)
        ADD_FAILURE() << kernels->isa << std::hexfloat << ": f(" << a[i] << ", " << b[i] << ") = " << out[i]
                      << ", plain float " << expected[i];
    EXPECT_EQ(wrong, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Functions, Approx, testing::ValuesIn(rows), printed);
INSTANTIATE_TEST_SUITE_P(Functions, ApproxInC, testing::ValuesIn(std::begin(rows), std::end(rows) - 2), printed);

TEST(ApproxTail, WritesNothingBeyondTheCount) {
  const float in[64] = {};
  for (const Kernels* kernels : runnable_kernels())
    for (std::size_t count = 0; count < 40; ++count) {
      float out[64];
      std::fill(std::begin(out), std::end(out), -7.0f);
      kernels->evaluate(MathFunction::exp2, in, nullptr, out, count);
      for (std::size_t i = 0; i < 64; ++i) ASSERT_EQ(out[i], i < count ? 1 : -7) << kernels->isa << " " << count;
    }
}

TEST(ApproxBeyondRange, SineAndCosineStayWithinOne) {
  std::mt19937 random(2);
  std::vector<float> a(4096), out(4096);
  for (float& x : a) x = std::bit_cast<float>(0x48000000u + static_cast<std::uint32_t>(random() % 0x37800000u));
  for (const Kernels* kernels : runnable_kernels())
    for (const MathFunction f : {MathFunction::sin, MathFunction::cos}) {
      kernels->evaluate(f, a.data(), nullptr, out.data(), a.size());
      for (const float value : out) ASSERT_TRUE(value >= -1 && value <= 1);
    }
}

TEST(ApproxHalf, TravelsAsIntegersInFloats) {
  for (const Kernels* kernels : runnable_kernels()) {
    const float in[] = {0, 15360, 31743, 32768 + 15360, 31744, 1};
    const float expected[] = {0, 1, 65504, -1, inf, 0x1p-24f};
    float out[6], back[6];
    kernels->evaluate(MathFunction::half_to_float, in, nullptr, out, 6);
    kernels->evaluate(MathFunction::float_to_half, out, nullptr, back, 6);
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(out[i], expected[i]);
      EXPECT_EQ(back[i], in[i]);
    }
  }
}

TEST(Pow5, IsTheFifthPower) {
  for (const double x : {0.0, 0.25, -1.5, 3.0}) {
    EXPECT_EQ(scalar::pow5(x), std::pow(x, 5));
    EXPECT_EQ(scalar::pow5(static_cast<float>(x)), static_cast<float>(std::pow(x, 5)));
  }
}

}  // namespace
}  // namespace tessera

// The accuracy table: every function of kernels/math, its range and its bound. The reference is libm in double, whose
// own error is 2^-29 of a float's last place.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera {
namespace {

double srgb_to_linear(double x, double) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }
double linear_to_srgb(double x, double) { return x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }
template <double (*f)(double)>
double unary(double x, double) {
  return f(x);
}

enum class Sampling { uniform, any_magnitude };  // any_magnitude: every bit pattern between the ends alike

struct Row {
  const char* name;
  MathFunction function;
  double (*reference)(double, double);
  Sampling sampling;
  float low, high;
  float second_low, second_high;
  double bound;  // in units of the exact value's last place
};

// clang-format off
const Row table[] = {
    {"exp2",            MathFunction::exp2,  unary<std::exp2>, Sampling::uniform,       -149, 128, 0, 0, 0.9},
    {"exp2_near_0",     MathFunction::exp2,  unary<std::exp2>, Sampling::any_magnitude, 0, 1,      0, 0, 0.9},
    {"exp",             MathFunction::exp,   unary<std::exp>,  Sampling::uniform,       -103, 88,  0, 0, 1.0},
    {"exp_near_0",      MathFunction::exp,   unary<std::exp>,  Sampling::any_magnitude, 0, 1,      0, 0, 1.0},
    {"log2",            MathFunction::log2,  unary<std::log2>, Sampling::any_magnitude, 0, 3e38f,  0, 0, 1.1},
    {"log2_near_1",     MathFunction::log2,  unary<std::log2>, Sampling::uniform,       0.5, 2,    0, 0, 1.1},
    {"log",             MathFunction::log,   unary<std::log>,  Sampling::any_magnitude, 0, 3e38f,  0, 0, 0.9},
    {"log_near_1",      MathFunction::log,   unary<std::log>,  Sampling::uniform,       0.5, 2,    0, 0, 0.9},
    {"pow",             MathFunction::pow,   std::pow, Sampling::any_magnitude, 0, 3e38f,   -3, 3,         1.0},
    {"pow_large_power", MathFunction::pow,   std::pow, Sampling::uniform,       0.7f, 1.42f, -250, 250,    1.0},
    {"pow_near_1",      MathFunction::pow,   std::pow, Sampling::uniform,       0.99f, 1.01f, -8000, 8000, 1.0},
    {"sin",             MathFunction::sin,   unary<std::sin>,  Sampling::uniform,       -10, 10,   0, 0, 0.9},
    {"sin_large",       MathFunction::sin,   unary<std::sin>,  Sampling::any_magnitude, 0, 131072, 0, 0, 0.9},
    {"cos",             MathFunction::cos,   unary<std::cos>,  Sampling::uniform,       -10, 10,   0, 0, 0.9},
    {"cos_large",       MathFunction::cos,   unary<std::cos>,  Sampling::uniform,       -131072, 131072, 0, 0, 0.9},
    {"tan",             MathFunction::tan,   unary<std::tan>,  Sampling::uniform,       -10, 10,   0, 0, 1.2},
    {"tan_large",       MathFunction::tan,   unary<std::tan>,  Sampling::any_magnitude, 0, 131072, 0, 0, 1.2},
    {"asin",            MathFunction::asin,  unary<std::asin>, Sampling::uniform,       -1, 1,     0, 0, 2.0},
    {"asin_near_0",     MathFunction::asin,  unary<std::asin>, Sampling::any_magnitude, 0, 1,      0, 0, 2.0},
    {"acos",            MathFunction::acos,  unary<std::acos>, Sampling::uniform,       -1, 1,     0, 0, 1.3},
    {"acos_near_1",     MathFunction::acos,  unary<std::acos>, Sampling::uniform,       0.9999f, 1, 0, 0, 1.3},
    {"atan2",           MathFunction::atan2, std::atan2, Sampling::uniform,       -1, 1,     -1, 1,        1.7},
    {"atan2_steep",     MathFunction::atan2, std::atan2, Sampling::any_magnitude, 0, 1e30f,  -1, 1,        1.7},
    {"cbrt",            MathFunction::cbrt,  unary<std::cbrt>, Sampling::any_magnitude, 0, 3e38f,  0, 0, 0.51},
    {"srgb_to_linear",  MathFunction::srgb_to_linear, srgb_to_linear, Sampling::uniform, 0, 1,     0, 0, 6.0},
    {"linear_to_srgb",  MathFunction::linear_to_srgb, linear_to_srgb, Sampling::any_magnitude, 1e-6f, 1, 0, 0, 2.5},
};
// clang-format on

struct MathAccuracy : testing::TestWithParam<Row> {};

TEST_P(MathAccuracy, WithinItsBound) {
  const Row& row = GetParam();
  constexpr std::size_t count = std::size_t{1} << 18;
  std::mt19937 random(42);
  std::uniform_real_distribution<float> first(row.low, row.high), second(row.second_low, row.second_high);
  std::uniform_int_distribution<std::uint32_t> patterns(std::bit_cast<std::uint32_t>(row.low),
                                                        std::bit_cast<std::uint32_t>(row.high));
  std::vector<float> a(count), b(count), out(count);
  for (std::size_t i = 0; i < count; ++i) {
    a[i] = row.sampling == Sampling::uniform ? first(random) : std::bit_cast<float>(patterns(random));
    b[i] = second(random);
  }
  for (const Kernels* kernels : runnable_kernels()) {
    kernels->evaluate(row.function, a.data(), b.data(), out.data(), count);
    double worst = 0;
    std::size_t where = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double exact = row.reference(a[i], b[i]);
      if (std::fabs(exact) > 3.4028234e38 || exact == 0) continue;  // the special values are another test
      const double ulp = std::ldexp(1.0, std::max(std::ilogb(exact) - 23, -149));
      const double error = std::fabs(out[i] - exact) / ulp;
      if (!(error <= worst)) worst = error, where = i;
      if (std::isnan(error)) break;
    }
    EXPECT_LE(worst, row.bound) << kernels->isa << ": f(" << a[where] << ", " << b[where] << ") = " << out[where];
    RecordProperty(kernels->isa, std::to_string(worst));
  }
}

// erf is a term, not a MathFunction: no set-up code calls it.
struct TermRow {
  const char* name;
  double (*reference)(double);
  Sampling sampling;
  float low, high;
  double bound;
};
const TermRow term_table[] = {
    {"erf", std::erf, Sampling::uniform, -4.5f, 4.5f, 1.1},
    {"erf", std::erf, Sampling::any_magnitude, 0, 10, 1.1},
};

TEST(TermAccuracy, WithinItsBound) {
  constexpr std::size_t count = std::size_t{1} << 18;
  for (const TermRow& row : term_table) {
    std::mt19937 random(42);
    std::uniform_real_distribution<float> uniform(row.low, row.high);
    std::uniform_int_distribution<std::uint32_t> patterns(std::bit_cast<std::uint32_t>(row.low),
                                                          std::bit_cast<std::uint32_t>(row.high));
    std::vector<float> x(count);
    for (float& value : x)
      value = row.sampling == Sampling::uniform ? uniform(random) : std::bit_cast<float>(patterns(random));
    for (const Kernels* kernels : runnable_kernels()) {
      const auto found = test::run_term(test::require_term(kernels->terms, row.name), {x})[0];
      for (std::size_t i = 0; i < count; ++i) {
        const double exact = row.reference(x[i]);
        if (exact == 0) continue;
        const double ulp = std::ldexp(1.0, std::max(std::ilogb(exact) - 23, -149));
        ASSERT_LE(std::fabs(found[i] - exact) / ulp, row.bound)
            << kernels->isa << ": " << row.name << '(' << x[i] << ')';
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, MathAccuracy, testing::ValuesIn(table),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace tessera

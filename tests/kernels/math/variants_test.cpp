#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>

#include "catalogue/method.hpp"
#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/microfacet.hpp"

namespace tessera::test {
namespace {

double exact(const std::string& term, double x, double y) {
  if (term.find("exp2") == 0) return std::exp2(x);
  if (term.find("log2") == 0) return std::log2(x);
  if (term.find("pow") == 0) return std::pow(x, y);
  if (term.find("rsqrt") != std::string::npos) return 1 / std::sqrt(x);
  if (term.find("reciprocal") != std::string::npos) return 1 / x;
  return std::acos(x);
}

// Every function against libm in double: its own error and float's together stay within what the catalogue says of
// both. Hardware estimates too, on the machines that there are.
TEST(FunctionVariants, WithinTheCataloguesBounds) {
  for (const catalogue::Method& method : catalogue::function_methods()) {
    if (method.own_test) continue;
    const auto inputs = catalogue::draw_inputs(method, 200000, 3);
    for (const Kernels* kernels : runnable_kernels()) {
      const auto found = run_term(require_term(kernels->terms, method.term), inputs)[0];
      for (std::size_t i = 0; i < found.size(); ++i) {
        const double expected = exact(method.term, inputs[0][i], inputs.size() > 1 ? inputs[1][i] : 0);
        const double scale = std::max(std::abs(expected), method.arithmetic_floor);
        ASSERT_LE(std::abs(found[i] - expected), (method.method_bound + method.arithmetic_bound) * scale)
            << kernels->isa << " " << method.term << " " << describe(inputs, i);
      }
    }
  }
}

// Each further degree or step buys digits.
TEST(FunctionVariants, DegreesAreOrdered) {
  std::map<std::string, double> worst;
  for (const catalogue::Method& method : catalogue::function_methods()) {
    if (method.own_test || method.estimate) continue;
    const auto inputs = catalogue::draw_inputs(method, 50000, 4);
    const auto found = run_term(require_term(precise_terms, method.term), widened(inputs))[0];
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double expected = exact(method.term, inputs[0][i], inputs.size() > 1 ? inputs[1][i] : 0);
      worst[method.term] = std::max(
          worst[method.term], std::abs(found[i] - expected) / std::max(std::abs(expected), method.arithmetic_floor));
    }
    EXPECT_LE(worst[method.term], method.method_bound) << method.term;
  }
  EXPECT_LT(worst["exp2_poly5"], worst["exp2_poly4"]);
  EXPECT_LT(worst["exp2_poly4"], worst["exp2_poly3"]);
  EXPECT_LT(worst["exp2_poly3"], worst["exp2_poly2"]);
  EXPECT_LT(worst["log2_poly7"], worst["log2_poly5"]);
  EXPECT_LT(worst["log2_poly5"], worst["log2_poly3"]);
  EXPECT_LT(worst["rsqrt_newton3"], worst["rsqrt_newton2"]);
  EXPECT_LT(worst["rsqrt_newton2"], worst["rsqrt_newton1"]);
  EXPECT_LT(worst["acos_poly5"], worst["acos_poly3"]);
  EXPECT_LT(worst["acos_poly3"], worst["acos_poly1"]);
}

// A light from directions: H = l + v and what the light loop takes from it.
struct Lights {
  std::vector<std::vector<float>> inputs{8};
  std::vector<double> expected;
};

Lights draw_lights(std::size_t count) {
  Lights lights;
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0.02, 1), turn(0, 6.283185307179586);
  for (std::size_t k = 0; k < count; ++k) {
    const double NoV = unit(random), NoL = unit(random), phi = turn(random), r = unit(random), alpha = r * r;
    const double sv = std::sqrt(1 - NoV * NoV), sl = std::sqrt(1 - NoL * NoL);
    const double x = sl * std::cos(phi) + sv, y = sl * std::sin(phi), z = NoL + NoV;
    const double H2 = x * x + y * y + z * z, VoH = std::sqrt(H2) / 2, F0 = unit(random);
    const float in[8] = {float(H2),    float(z),  float(x * x + y * y),     float(NoV), float(NoL),
                         float(alpha), float(F0), float(std::min(VoH, 1.0))};
    for (std::size_t i = 0; i < 8; ++i) lights.inputs[i].push_back(in[i]);
    const double D = reference::ggx_distribution((x * x + y * y) / H2, z * z / H2, alpha);
    const double V = reference::smith_masking_shadowing(std::acos(NoV), std::acos(NoL), alpha) / (4 * NoV * NoL);
    lights.expected.push_back(D * V * (F0 + (1 - F0) * std::pow(1 - std::min(VoH, 1.0), 5)) * NoL);
  }
  return lights;
}

TEST(SpecularLight, IsTheLobe) {
  const Lights lights = draw_lights(20000);
  const auto in_double = run_term(require_term(precise_terms, "specular_light"), widened(lights.inputs))[0];
  for (std::size_t i = 0; i < in_double.size(); ++i) ASSERT_NEAR(in_double[i] / lights.expected[i], 1, 3e-4);
  for (const Kernels* kernels : runnable_kernels()) {
    for (const auto& [term, bound] :
         {std::pair{"specular_light", 2e-6}, {"estimate_light_contracted", 2e-6}, {"estimate_light", 2e-4}}) {
      const auto found = run_term(require_term(kernels->terms, term), lights.inputs)[0];
      for (std::size_t i = 0; i < found.size(); ++i)
        ASSERT_NEAR(found[i] / in_double[i], 1, bound) << kernels->isa << " " << term << describe(lights.inputs, i);
    }
  }
}

}  // namespace
}  // namespace tessera::test

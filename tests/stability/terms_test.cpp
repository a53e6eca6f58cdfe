// Every term where its inputs are extreme: at the ends of their domains and within a few ulps of them, at denormals,
// and where values meet (alpha = 1, gamma = 1, equal cosines). There too it is finite and within its bound of the
// double form, so it cannot jump: a step of one ulp moves it by no more than the formula moves, plus rounding.
#include "kernels/terms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "catalogue/method.hpp"
#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::test {
namespace {

using catalogue::Method;
using catalogue::Quantity;

// Whether an input may be moved on its own: parts of one half vector may not.
bool independent(Quantity q) {
  return q != Quantity::NoH && q != Quantity::sin2 && q != Quantity::XoH && q != Quantity::YoH;
}

std::vector<float> critical_values(const Method& method, Quantity q) {
  const auto [low, high] = domain_of(method, q);
  std::vector<float> values;
  for (const float center : {float(low), float(high), 0.0f, 1.0f, 0.5f, 1e-40f, 1e-20f, 1e-7f, 1.0f / 7}) {
    if (center < float(low) || center > float(high)) continue;
    float x = center;
    for (int step = 0; step < 8; ++step) x = std::nextafter(x, -10.0f);
    for (int step = 0; step < 16; ++step, x = std::nextafter(x, 100.0f))
      if (x >= float(low) && x <= float(high)) values.push_back(x);
  }
  return values;
}

struct Extremes : testing::TestWithParam<Method> {};

TEST_P(Extremes, WithinTheBoundAtEveryEdge) {
  const Method& method = GetParam();
  std::vector<std::vector<float>> inputs(method.inputs.size());
  std::mt19937 random(5);
  constexpr std::size_t companions = 64;
  for (std::size_t k = 0; k < method.inputs.size(); ++k) {
    if (!independent(method.inputs[k])) continue;
    const auto others = draw_inputs(method, companions, unsigned(k));
    for (const float value : critical_values(method, method.inputs[k]))
      for (std::size_t i = 0; i < companions; ++i)
        for (std::size_t m = 0; m < inputs.size(); ++m) {
          float x = m == k ? value : others[m][i];
          // One companion in four stands on an edge of its own, or takes the same value: cosines that are equal.
          const auto [low, high] = domain_of(method, method.inputs[m]);
          if (m != k && independent(method.inputs[m]) && random() % 4 == 0)
            x = random() % 3 == 0   ? float(low)
                : random() % 2 == 0 ? float(high)
                                    : std::min(std::max(value, float(low)), float(high));
          inputs[m].push_back(x);
        }
  }
  if (inputs[0].empty()) return;  // nothing independent: distribution_other_test steps through those
  const auto exact = run_term(require_term(precise_terms, method.term), widened(inputs));
  for (const Kernels* kernels : runnable_kernels()) {
    const auto found = run_term(require_term(kernels->terms, method.term), inputs);
    for (std::size_t o = 0; o < found.size(); ++o)
      for (std::size_t i = 0; i < found[o].size(); ++i) {
        ASSERT_TRUE(std::isfinite(found[o][i])) << kernels->isa << " " << describe(inputs, i);
        ASSERT_TRUE(found[o][i] >= 0 || method.may_be_negative) << kernels->isa << " " << describe(inputs, i);
        if (method.arithmetic_bound == 0) continue;
        const double bound = method.arithmetic_bound * std::max(std::abs(exact[o][i]), method.arithmetic_floor);
        ASSERT_LE(std::abs(found[o][i] - exact[o][i]), bound)
            << kernels->isa << " " << found[o][i] << " for " << exact[o][i] << " at " << describe(inputs, i);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Extremes, testing::ValuesIn(methods_to_draw()),
                         [](const auto& info) { return info.param.term; });

}  // namespace
}  // namespace tessera::test

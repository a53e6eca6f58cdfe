// The accuracy table (src/catalogue) against every term, on every instruction set.
#include "kernels/terms.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>
#include <string>

#include "catalogue/method.hpp"
#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::test {
namespace {

using catalogue::Method;

constexpr std::size_t count = 60013;  // no multiple of a vector

struct Accuracy : testing::TestWithParam<Method> {};

TEST_P(Accuracy, WithinItsBound) {
  const Method& method = GetParam();
  const auto inputs = catalogue::draw_inputs(method, count, 1);
  const auto exact = run_term(require_term(precise_terms, method.term), widened(inputs));
  for (const Kernels* kernels : runnable_kernels()) {
    const auto found = run_term(require_term(kernels->terms, method.term), inputs);
    for (std::size_t k = 0; k < found.size(); ++k)
      for (std::size_t i = 0; i < count; ++i) {
        const double expected = exact[k][i];
        const double bound = method.arithmetic_bound * std::max(std::abs(expected), method.arithmetic_floor);
        ASSERT_TRUE(std::isfinite(found[k][i])) << kernels->isa << " " << describe(inputs, i);
        if (method.arithmetic_bound > 0) {
          ASSERT_LE(std::abs(found[k][i] - expected), bound) << kernels->isa << " output " << k << ": " << found[k][i]
                                                             << " for " << expected << " at " << describe(inputs, i);
        }
      }
  }
}

TEST_P(Accuracy, TheSameBitsOnEveryInstructionSet) {
  const Method& method = GetParam();
  const auto inputs = catalogue::draw_inputs(method, count, 2);
  std::vector<std::vector<float>> first;
  for (const Kernels* kernels : runnable_kernels()) {
    const auto found = run_term(require_term(kernels->terms, method.term), inputs);
    if (first.empty()) first = found;
    for (std::size_t k = 0; k < found.size(); ++k)
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(found[k][i]), std::bit_cast<std::uint32_t>(first[k][i]))
            << kernels->isa << " " << describe(inputs, i);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Accuracy, testing::ValuesIn(methods_to_draw()),
                         [](const auto& info) { return info.param.term; });

// A term that nobody describes is not tested; a description without its term describes nothing.
TEST(Catalogue, NamesEveryTermAndNothingElse) {
  std::set<std::string> described, built, also_in_double;
  for (const Method& method : catalogue::methods()) {
    EXPECT_TRUE(described.insert(method.term).second) << method.term << " twice";
    const Term<float>* term = find_term(runnable_kernels().front()->terms, method.term.c_str());
    ASSERT_NE(term, nullptr) << method.term;
    EXPECT_EQ(std::size_t(term->inputs), method.inputs.size()) << method.term;
    EXPECT_FALSE(method.paper.empty() || method.formula.empty() || method.title.empty() || method.file.empty());
  }
  for (const auto* const* span = runnable_kernels().front()->terms; *span != nullptr; ++span)
    for (int i = 0; i < (*span)->count; ++i) built.insert((*span)->first[i].name);
  for (const auto* const* span = precise_terms; *span != nullptr; ++span)
    for (int i = 0; i < (*span)->count; ++i) also_in_double.insert((*span)->first[i].name);
  for (const std::string& name : built) EXPECT_TRUE(described.count(name)) << name << " is not in the catalogue";
  EXPECT_EQ(built, also_in_double);
}

}  // namespace
}  // namespace tessera::test

// Runs terms of the catalogue in tests: over float or double, drawn inputs, and messages that name them.
#pragma once
#include <cstdio>
#include <initializer_list>
#include <ostream>
#include <string>
#include <vector>

#include "catalogue/method.hpp"
#include "catalogue/run_term.hpp"
#include "kernels/interface.hpp"

namespace tessera::catalogue {

/// How GoogleTest names a method in its messages.
inline void PrintTo(const Method& method, std::ostream* out) { *out << method.title; }

}  // namespace tessera::catalogue

namespace tessera::test {

using catalogue::require_term;
using catalogue::run_term;

/// The first output of a term, on one instruction set.
inline std::vector<float> evaluate_term(const Kernels& kernels, const std::string& name,
                                        std::initializer_list<const std::vector<float>*> inputs) {
  std::vector<std::vector<float>> in;
  for (const std::vector<float>* plane : inputs) in.push_back(*plane);
  return run_term(require_term(kernels.terms, name), in)[0];
}

/// Those whose inputs may be drawn from their quantities' domains, and whose bits are the same everywhere.
inline std::vector<catalogue::Method> methods_to_draw() {
  std::vector<catalogue::Method> list;
  for (const catalogue::Method& method : catalogue::methods())
    if (!method.own_test && !method.estimate) list.push_back(method);
  return list;
}

inline std::vector<std::vector<double>> widened(const std::vector<std::vector<float>>& inputs) {
  std::vector<std::vector<double>> wide;
  for (const auto& plane : inputs) wide.emplace_back(plane.begin(), plane.end());
  return wide;
}

inline std::string describe(const std::vector<std::vector<float>>& inputs, std::size_t i) {
  std::string text;
  for (const auto& plane : inputs) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.9g", text.empty() ? "" : ", ", double(plane[i]));
    text += number;
  }
  return text;
}

}  // namespace tessera::test

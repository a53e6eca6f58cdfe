// Runs a term, over float or double, on arrays.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/terms.hpp"

namespace tessera::test {

template <class Number>
const Term<Number>* require_term(const TermSpan<Number>* const* spans, const std::string& name) {
  const Term<Number>* term = find_term(spans, name.c_str());
  if (term == nullptr) throw std::invalid_argument("no term " + name);
  return term;
}

/// All outputs.
template <class Number>
std::vector<std::vector<Number>> run_term(const Term<Number>& term, const std::vector<std::vector<Number>>& inputs,
                                          const float* table = nullptr, int table_size = 0) {
  if (inputs.size() != std::size_t(term.inputs)) throw std::invalid_argument(std::string("inputs of ") + term.name);
  std::vector<std::vector<Number>> out(std::size_t(term.outputs), std::vector<Number>(inputs.at(0).size()));
  TermArgs<Number> args{};
  for (std::size_t k = 0; k < inputs.size(); ++k) args.in[k] = inputs[k].data();
  for (std::size_t k = 0; k < out.size(); ++k) args.out[k] = out[k].data();
  args.count = inputs[0].size();
  args.table = table;
  args.table_size = table_size;
  term.run(args);
  return out;
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

// Runs a term of the kernels on arrays: for tests, charts and tables of methods.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/terms.hpp"

namespace tessera::catalogue {

/// Throws std::invalid_argument for a name that no term has.
template <class Number>
const Term<Number>& require_term(const TermSpan<Number>* const* terms, const std::string& name) {
  const Term<Number>* term = find_term(terms, name.c_str());
  if (term == nullptr) throw std::invalid_argument("no term " + name);
  return *term;
}

/// All outputs, for inputs of equal length, as many as the term takes. table: TermArgs::table, where the term reads
/// one.
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

}  // namespace tessera::catalogue

// Calls a term over arrays, on one instruction set.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/interface.hpp"
#include "kernels/terms.hpp"

namespace tessera::test {

/// The first output.
inline std::vector<float> evaluate_term(const Kernels& kernels, const std::string& name,
                                        std::initializer_list<const std::vector<float>*> inputs) {
  const Term<float>* term = find_term(kernels.terms, name.c_str());
  if (term == nullptr || term->inputs != int(inputs.size())) throw std::invalid_argument(name);
  std::vector<std::vector<float>> out(std::size_t(term->outputs), std::vector<float>((*inputs.begin())->size()));
  TermArgs<float> args{};
  int k = 0;
  for (const std::vector<float>* in : inputs) args.in[k++] = in->data();
  for (k = 0; k < term->outputs; ++k) args.out[k] = out[std::size_t(k)].data();
  args.count = out[0].size();
  term->run(args);
  return out[0];
}

}  // namespace tessera::test

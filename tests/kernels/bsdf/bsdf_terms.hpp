// Calls a term of the BSDF over arrays, on one instruction set.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "kernels/interface.hpp"

namespace tessera::test {

inline std::vector<float> evaluate_term(const Kernels& kernels, BsdfTerm term,
                                        std::initializer_list<const std::vector<float>*> inputs) {
  std::vector<float> out((*inputs.begin())->size());
  BsdfTermArgs args{};
  args.term = term;
  int k = 0;
  for (const std::vector<float>* in : inputs) args.in[k++] = in->data();
  args.out = out.data();
  args.count = out.size();
  kernels.evaluate_bsdf(args);
  return out;
}

}  // namespace tessera::test

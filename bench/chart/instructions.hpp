// Instructions that the compiler made of each term and of each way to sample, counted in the objects of this build
// (instructions.py).
#pragma once
#include <string>
#include <vector>

#include "kernels/sampling.hpp"

namespace tessera::chart {

struct LoopCount {
  std::string isa, function;
  int instructions;  // of the loop over one vector, loads and stores and the loop's own included
  int divisions;     // among them: divisions and square roots
};

const std::vector<LoopCount>& loop_counts();

struct SamplerCount {
  std::string isa;
  SamplingFormat format;
  SamplingLayout layout;
  SamplingFilter filter;
  bool cube;
  int instructions;      // as above
  int gathers_of_words;  // one for all lanes
  int gathers_of_pairs;  // 64 bits a lane: one for half of the lanes
};

const std::vector<SamplerCount>& sampler_counts();

}  // namespace tessera::chart

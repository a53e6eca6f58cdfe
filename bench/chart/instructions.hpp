// Instructions that the compiler made of each term, counted in the objects of this build (instructions.py).
#pragma once
#include <string>
#include <vector>

namespace tessera::chart {

struct LoopCount {
  std::string isa, function;
  int instructions;  // of the loop over one vector, loads and stores and the loop's own included
  int divisions;     // among them: divisions and square roots
};

const std::vector<LoopCount>& loop_counts();

}  // namespace tessera::chart

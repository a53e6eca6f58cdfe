// What is measured: frames against threads, pixels, triangles and lights.
#pragma once
#include <string>
#include <vector>

#include "bench/scaling/measure.hpp"
#include "kernels/interface.hpp"

namespace tessera::scaling {

struct Series {
  std::string name;
  std::vector<Case> cases;
};

struct Part {
  std::string id, title, x_name;
  std::string measured;  // under what circumstances, in words
  std::vector<Series> series;
};

struct Effort {
  int threads = 2, rounds = 5;
  double seconds = 0.1;  // of each case in each round
};

const std::vector<std::string>& part_names();
Part measure_part(const std::string& name, const Effort& effort, const Kernels& kernels);

}  // namespace tessera::scaling

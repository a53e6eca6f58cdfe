// Whether two pictures of raw floats agree, as pictures that single precision computed in two ways must:
//   tessera_peer_compare ONE OTHER
// every channel within 1 % of (|one| + 0.01), and none that is not a number. Exit status: 0 they do, 1 they do not.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "bench/workload/inputs.hpp"

namespace tessera::peers {
namespace {

constexpr double tolerance = 0.01;

bool agree(const std::string& one_path, const std::string& other_path) {
  const auto one = workload::read_array<float>(one_path), other = workload::read_array<float>(other_path);
  if (one.size() != other.size() || one.empty())
    throw input_error("{} holds {} values, {} holds {}", one_path, one.size(), other_path, other.size());
  std::size_t beyond = 0;
  double worst = 0, sum = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double error = std::abs(double(one[i]) - double(other[i])) / (std::abs(double(one[i])) + 0.01);
    if (!(error <= tolerance)) ++beyond;  // a NaN too
    if (error > worst) worst = error;
    sum += error;
  }
  fmt::print("{:.3f} % at worst, {:.5f} % on average; {} of {} channels beyond {} %\n", 100 * worst,
             100 * sum / double(one.size()), beyond, one.size(), 100 * tolerance);
  return beyond == 0;
}

}  // namespace
}  // namespace tessera::peers

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: tessera_peer_compare ONE OTHER\n");
    return 2;
  }
  try {
    return tessera::peers::agree(argv[1], argv[2]) ? 0 : 1;
  } catch (const tessera::Error& error) {
    std::fprintf(stderr, "tessera_peer_compare: error: %s\n", error.what());
    return static_cast<int>(error.status());
  }
}

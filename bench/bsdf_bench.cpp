// Each term of the shading formula over an array that lies in the first-level cache, on each instruction set. time /
// items = per evaluation; loads and stores of the arrays included.
#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <vector>

#include "frame/dispatch.hpp"
#include "kernels/interface.hpp"

namespace tessera {
namespace {

constexpr std::size_t count = 512;

void evaluate(benchmark::State& state, const Kernels* kernels, BsdfTerm term) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0.05f, 1);
  std::vector<float> in[max_term_inputs], out(count);
  BsdfTermArgs args{};
  args.term = term;
  for (int k = 0; k < max_term_inputs; ++k) {
    for (std::size_t i = 0; i < count; ++i) in[k].push_back(unit(random));
    args.in[k] = in[k].data();
  }
  args.out = out.data();
  args.count = count;
  for ([[maybe_unused]] auto _ : state) {
    kernels->evaluate_bsdf(args);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t{count});
}

[[maybe_unused]] const bool registered = [] {
  struct Case {
    const char* name;
    BsdfTerm term;
  };
  for (const Kernels* kernels : built_kernels()) {
    if (!cpu_runs(*kernels)) continue;
    for (const Case& c : {Case{"D_GGX", BsdfTerm::D_GGX}, Case{"V_SmithGGXCorrelated", BsdfTerm::V_SmithGGXCorrelated},
                          Case{"F_Schlick", BsdfTerm::F_Schlick}, Case{"DV_GGX", BsdfTerm::DV_GGX}})
      benchmark::RegisterBenchmark((std::string("bsdf/") + kernels->isa + "/" + c.name).c_str(), evaluate, kernels,
                                   c.term);
  }
  return true;
}();

}  // namespace
}  // namespace tessera

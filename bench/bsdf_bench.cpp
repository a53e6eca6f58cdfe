// Each term of the shading formula over an array that lies in the first-level cache, on each instruction set. time /
// items = per evaluation; loads and stores of the arrays included.
#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <vector>

#include "frame/dispatch.hpp"
#include "kernels/interface.hpp"
#include "kernels/terms.hpp"

namespace tessera {
namespace {

constexpr std::size_t count = 512;

void evaluate(benchmark::State& state, const Term<float>* term) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0.05f, 1);
  std::vector<float> in[max_term_inputs], out[max_term_outputs];
  constexpr int table_size = 32;
  std::vector<float> table;
  for (int i = 0; i < 4 * table_size * table_size; ++i) table.push_back(unit(random));
  TermArgs<float> args{};
  for (int k = 0; k < term->inputs; ++k) {
    for (std::size_t i = 0; i < count; ++i) in[k].push_back(unit(random));
    args.in[k] = in[k].data();
  }
  for (int k = 0; k < term->outputs; ++k) {
    out[k].resize(count);
    args.out[k] = out[k].data();
  }
  args.count = count;
  args.table = table.data();
  args.table_size = table_size;
  for ([[maybe_unused]] auto _ : state) {
    term->run(args);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t{count});
}

[[maybe_unused]] const bool registered = [] {
  for (const Kernels* kernels : built_kernels()) {
    if (!cpu_runs(*kernels)) continue;
    for (const TermSpan<float>* const* span = kernels->terms; *span != nullptr; ++span)
      for (int t = 0; t < (*span)->count; ++t) {
        const Term<float>* term = &(*span)->first[t];
        benchmark::RegisterBenchmark((std::string("bsdf/") + kernels->isa + "/" + term->name).c_str(), evaluate, term);
      }
  }
  return true;
}();

}  // namespace
}  // namespace tessera

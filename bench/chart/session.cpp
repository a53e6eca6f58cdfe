#include "bench/chart/session.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <stdexcept>

#include "base/aligned.hpp"
#include "catalogue/run_term.hpp"

namespace tessera::chart {
namespace {

// Each repetition runs at least this long; the median of the repetitions counts.
struct Effort {
  double seconds;
  int repetitions;
};
constexpr Effort thorough{0.02, 15}, quick_effort{0.004, 7};

class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration && run.iterations > 0)
        seconds.push_back(run.cpu_accumulated_time / static_cast<double>(run.iterations));
  }
  std::vector<double> seconds;  // of one call of the body, one entry a repetition
};

// Half of a first-level data cache of 32 KiB, the smallest of today: the rest is for tables and constants.
constexpr std::size_t array_bytes = 16384;
constexpr std::size_t most_elements = 1024;
constexpr std::size_t padding = 48;  // floats between arrays, so that they do not start at the same place of a page

}  // namespace

Cost TimedSession::time(std::uint64_t evaluations, const std::function<void()>& body) {
  const Effort effort = quick ? quick_effort : thorough;
  benchmark::RegisterBenchmark("timed",
                               [&body](benchmark::State& state) {
                                 for ([[maybe_unused]] auto _ : state) {
                                   body();
                                   benchmark::ClobberMemory();
                                 }
                               })
      ->MinTime(effort.seconds)
      ->Repetitions(effort.repetitions);
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector, "timed");
  benchmark::ClearRegisteredBenchmarks();
  ++timings;
  std::vector<double> ns;
  for (const double seconds : collector.seconds) ns.push_back(seconds * 1e9 / static_cast<double>(evaluations));
  if (ns.empty()) throw std::logic_error("Google Benchmark measured nothing");
  std::sort(ns.begin(), ns.end());
  return {ns[ns.size() / 2], ns.front(), ns.back(), static_cast<int>(ns.size())};
}

void TimedSession::progress(const std::string& what) { progress_.begin(what); }

std::map<std::string, Cost> time_term(Session& session, const std::string& name,
                                      const std::vector<std::vector<float>>& inputs, const float* table,
                                      int table_size) {
  std::map<std::string, Cost> costs;
  for (const Kernels* kernels : session.kernels) {
    const Term<float>* term = &catalogue::require_term(kernels->terms, name);
    if (static_cast<std::size_t>(term->inputs) > inputs.size() || inputs.empty() || inputs.front().empty())
      throw std::logic_error("the term '" + name + "' takes more inputs than it got");
    const std::size_t arrays = static_cast<std::size_t>(term->inputs + term->outputs);
    const std::size_t given = inputs.front().size();
    const std::size_t fits = std::min(array_bytes / sizeof(float) / arrays, most_elements) / max_lanes * max_lanes;
    const std::size_t count = std::min(given, fits), stride = (count + max_lanes - 1) / max_lanes * max_lanes + padding;
    AlignedVector<float> memory(stride * arrays);
    TermArgs<float> args{};
    args.count = count;
    args.table = table;
    args.table_size = table_size;
    float* next = memory.data();
    for (int k = 0; k < term->inputs; ++k, next += stride) {
      // Evenly from all that was given: inputs may be sorted.
      for (std::size_t i = 0; i < count; ++i) next[i] = inputs[static_cast<std::size_t>(k)].at(i * given / count);
      args.in[k] = next;
    }
    for (int k = 0; k < term->outputs; ++k, next += stride) args.out[k] = next;
    costs[kernels->isa] = session.time(count, [term, &args] { term->run(args); });
  }
  return costs;
}

}  // namespace tessera::chart

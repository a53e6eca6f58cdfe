// Baking an environment and the DFG table, whole and in parts, per instruction set.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <random>
#include <string>

#include "base/parallel.hpp"
#include "frame/dispatch.hpp"
#include "precompute/dfg.hpp"
#include "precompute/environment.hpp"
#include "precompute/irradiance.hpp"
#include "precompute/prefilter.hpp"

namespace tessera {
namespace {

Image picture(int width) {
  Image image(width, width / 2, 3);
  std::mt19937 random(1);
  for (float& value : image.pixels) value = float(random() % 1000) / 1000;
  std::fill_n(image.at(width / 3, width / 8), 3, 10000.0f);
  return image;
}

void bake(benchmark::State& state, const Kernels& kernels, int threads) {
  const Image image = picture(int(state.range(0)));
  run_with_threads(threads, [&] {
    EnvironmentSettings settings;
    settings.levels = 9;
    for (auto _ : state) benchmark::DoNotOptimize(build_environment(image, settings, kernels));
  });
}

void dfg(benchmark::State& state, const Kernels& kernels) {
  run_with_threads(1, [&] {
    for (auto _ : state) benchmark::DoNotOptimize(build_dfg_table(kernels));
  });
}

void irradiance(benchmark::State& state, const Kernels& kernels) {
  const Image image = picture(1024);
  run_with_threads(1, [&] {
    for (auto _ : state) {
      benchmark::DoNotOptimize(project_irradiance({image.pixels.data(), image.width, image.height}, 0, kernels));
    }
  });
}

void prefilter(benchmark::State& state, const Kernels& kernels) {
  CubeLevel level(256);
  std::mt19937 random(1);
  for (float& value : level.texels) value = float(random() % 1000) / 1000;
  run_with_threads(1, [&] {
    for (auto _ : state) benchmark::DoNotOptimize(prefiltered(level, 7, int(state.range(0)), kernels));
  });
}

void register_all() {
  for (const Kernels* kernels : built_kernels()) {
    if (!cpu_runs(*kernels)) continue;
    const auto name = [&](const char* what) { return fmt::format("{}/{}", what, kernels->isa); };
    const auto run = [&](const std::string& label, auto function) {
      return benchmark::RegisterBenchmark(label.c_str(), function)
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime();
    };
    for (const int threads : {1, 2}) {
      run(fmt::format("{}/threads:{}", name("bake"), threads),
          [kernels, threads](benchmark::State& state) { bake(state, *kernels, threads); })
          ->Arg(1024)
          ->UseRealTime();
    }
    run(name("dfg_table"), [kernels](benchmark::State& state) { dfg(state, *kernels); });
    run(name("irradiance"), [kernels](benchmark::State& state) { irradiance(state, *kernels); });
    run(name("prefilter"), [kernels](benchmark::State& state) { prefilter(state, *kernels); })
        ->Arg(0)
        ->Arg(64)
        ->Arg(1024);
  }
}

const bool registered = (register_all(), true);

}  // namespace
}  // namespace tessera

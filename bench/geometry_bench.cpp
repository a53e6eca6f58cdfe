// The geometry stage: vertices, set-up, and the whole stage with binning, per instruction set and number of threads.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "frame/dispatch.hpp"
#include "raster/geometry.hpp"

namespace tessera {
namespace {

// A bumpy ball of n rows of 2n cells before a camera at the origin: half of its triangles face away.
struct Ball {
  AlignedVector<float> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> double_sided{0};
  std::vector<AlphaMode> alpha{AlphaMode::opaque};

  explicit Ball(int n) {
    constexpr double pi = 3.14159265358979;
    const int columns = 2 * n;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= columns; ++i) {
        const double theta = pi * j / n, phi = pi * i / n;
        const double r = 1 + 0.05 * std::sin(9 * phi) * std::sin(7 * theta);
        positions.push_back(static_cast<float>(r * std::sin(theta) * std::cos(phi)));
        positions.push_back(static_cast<float>(r * std::cos(theta)));
        positions.push_back(static_cast<float>(r * std::sin(theta) * std::sin(phi) - 2.5));
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < columns; ++i) {
        const auto a = static_cast<std::uint32_t>(j * (columns + 1) + i), b = a + 1;
        const std::uint32_t c = a + static_cast<std::uint32_t>(columns) + 1, d = c + 1;
        triangles.push_back({{a, b, c}, 0});
        triangles.push_back({{b, d, c}, 0});
      }
  }
  [[nodiscard]] GeometryView view() const {
    return {positions.data(), nullptr, triangles.data(), static_cast<std::uint32_t>(positions.size() / 3),
            static_cast<std::uint32_t>(triangles.size())};
  }
};

const ViewTransform camera{
    {1200, 0, -960, 0}, {0, -1200, -540, 0}, {0, 0, 0, 0.1f}, {0, 0, -1, 0}, {0, 0, 0, 1}, 1920, 1080};

void project(benchmark::State& state, const Kernels* kernels) {
  const Ball ball(200);
  const GeometryView view = ball.view();
  AlignedVector<ProjectedVertex> out(view.vertex_count);
  for (auto _ : state) {
    kernels->project_vertices(camera, view.positions, view.vertex_count, out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * view.vertex_count);
}

void set_up(benchmark::State& state, const Kernels* kernels, int rows) {
  constexpr std::uint32_t chunk = 4096;
  const Ball ball(rows);
  const GeometryView view = ball.view();
  AlignedVector<ProjectedVertex> vertices(view.vertex_count);
  kernels->project_vertices(camera, view.positions, view.vertex_count, vertices.data());
  std::vector<SetupTriangle> out(chunk * max_setup_per_triangle);
  GeometryCounters counters{};
  for (auto _ : state) {
    for (std::uint32_t first = 0; first < view.triangle_count; first += chunk) {
      const std::uint32_t count = std::min(chunk, view.triangle_count - first);
      kernels->setup_triangles(
          {view, camera, vertices.data(), ball.double_sided.data(), 1, first, count, out.data(), &counters});
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * view.triangle_count);
  state.counters["kept"] = static_cast<double>(counters.kept) / static_cast<double>(counters.in);
}

void stage(benchmark::State& state, const Kernels* kernels, int rows, int threads) {
  const Ball ball(rows);
  GeometryStage geometry;
  run_with_threads(threads, [&] {
    for (auto _ : state) geometry.run(ball.view(), camera, 1, ball.double_sided, ball.alpha, *kernels);
  });
  state.SetItemsProcessed(state.iterations() * ball.view().triangle_count);
  state.counters["binned"] = static_cast<double>(geometry.binned());
  state.counters["bytes"] = static_cast<double>(geometry.bytes());
}

const bool registered = [] {
  for (const Kernels* k : built_kernels()) {
    if (!cpu_runs(*k)) continue;
    benchmark::RegisterBenchmark(fmt::format("project/{}", k->isa).c_str(), project, k);
    benchmark::RegisterBenchmark(fmt::format("setup/small/{}", k->isa).c_str(), set_up, k, 200);
    benchmark::RegisterBenchmark(fmt::format("setup/large/{}", k->isa).c_str(), set_up, k, 10);
    for (const int threads : {1, 2}) {
      benchmark::RegisterBenchmark(fmt::format("stage/threads:{}/{}", threads, k->isa).c_str(), stage, k, 200, threads)
          ->UseRealTime();
    }
  }
  return true;
}();

}  // namespace
}  // namespace tessera

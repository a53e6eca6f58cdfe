// Coverage and depth inside tiles: tiny to large triangles, one and four samples, per instruction set.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <random>
#include <string>
#include <vector>

#include "base/aligned.hpp"
#include "frame/dispatch.hpp"
#include "kernels/interface.hpp"

namespace tessera {
namespace {

constexpr std::uint32_t triangle_count = 256;

struct Soup {
  std::vector<SetupTriangle> triangles;
  std::vector<std::uint32_t> list;
};

// Triangles with legs of about `pixels` pixels in the tile at the origin, in random depth order.
Soup make_soup(int pixels) {
  std::mt19937 random(1);
  Soup soup;
  const int extent = pixels * 256;
  for (std::uint32_t i = 0; i < triangle_count; ++i) {
    const auto at = [&](int from, int range) {
      return from + static_cast<int>(random() % static_cast<unsigned>(range));
    };
    const int x = at(-extent / 2, tile_size * 256), y = at(-extent / 2, tile_size * 256);
    const int apex = x + at(0, extent), lower = y + at(extent / 2, extent / 2);
    const float depth = 0.1f + 0.8f * static_cast<float>(random() % 1024) / 1024;
    soup.triangles.push_back({{x, x + extent, apex}, {y + extent, lower, y}, depth, 1e-5f, 2e-5f, 0, 1, i});
    soup.list.push_back(i);
  }
  return soup;
}

struct TileMemory {
  AlignedVector<float> depth;
  AlignedVector<std::uint32_t> ids;
  VisibilityTile tile;
  explicit TileMemory(int samples)
      : depth(std::size_t(samples) * tile_pixels), ids(depth.size()), tile{0,         0,       tile_size,
                                                                           tile_size, samples, depth.data(),
                                                                           ids.data()} {}
};

void rasterize(benchmark::State& state, const Kernels* kernels, int pixels, int samples) {
  const Soup soup = make_soup(pixels);
  const TileMemory memory(samples);
  RasterCounters counters{};
  const RasterizeArgs args{memory.tile, soup.triangles.data(), soup.list.data(), triangle_count};
  kernels->clear_visibility(memory.tile);
  kernels->rasterize_opaque(args, &counters);
  for (auto _ : state) {
    kernels->clear_visibility(memory.tile);
    kernels->rasterize_opaque(args, nullptr);
    benchmark::ClobberMemory();
  }
  const auto frames = static_cast<double>(state.iterations());
  const double drawn = frames * triangle_count, tested = frames * static_cast<double>(counters.samples_tested);
  state.counters["triangles/s"] = benchmark::Counter(drawn, benchmark::Counter::kIsRate);
  state.counters["samples/s"] = benchmark::Counter(tested, benchmark::Counter::kIsRate);
  state.counters["samples/triangle"] = tested / drawn;
}

void collect_visible(benchmark::State& state, const Kernels* kernels, int samples) {
  const Soup soup = make_soup(6);
  const TileMemory memory(samples);
  RasterCounters counters{};
  kernels->clear_visibility(memory.tile);
  kernels->rasterize_opaque({memory.tile, soup.triangles.data(), soup.list.data(), triangle_count}, &counters);
  std::vector<Fragment> out(memory.depth.size());
  std::uint32_t count = 0;
  for (auto _ : state) {
    count = kernels->collect_visible(memory.tile, out.data());
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["fragments"] = count;
  state.SetItemsProcessed(state.iterations() * tile_pixels);
}

void collect_triangle(benchmark::State& state, const Kernels* kernels, int pixels) {
  const Soup soup = make_soup(pixels);
  const TileMemory memory(1);
  kernels->clear_visibility(memory.tile);
  std::vector<Fragment> out(tile_pixels);
  std::uint64_t count = 0;
  for (auto _ : state) {
    for (const SetupTriangle& t : soup.triangles) count += kernels->collect_triangle(memory.tile, t, false, out.data());
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["fragments/s"] = benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsRate);
}

const bool registered = [] {
  for (const Kernels* k : built_kernels()) {
    if (!cpu_runs(*k)) continue;
    const auto add = [&](const std::string& name, auto function, auto... arguments) {
      benchmark::RegisterBenchmark(fmt::format("{}/{}", name, k->isa).c_str(), function, k, arguments...);
    };
    for (const int samples : {1, 4}) {
      const std::pair<const char*, int> sizes[] = {{"tiny", 3}, {"small", 8}, {"medium", 32}, {"large", 1024}};
      for (const auto& [name, pixels] : sizes)
        add(fmt::format("rasterize/{}/{}x", name, samples), rasterize, pixels, samples);
      add(fmt::format("collect_visible/{}x", samples), collect_visible, samples);
    }
    add("collect_triangle/small", collect_triangle, 8);
    add("collect_triangle/medium", collect_triangle, 32);
  }
  return true;
}();

}  // namespace
}  // namespace tessera

// The shading kernel on one tile whose G-buffer lies in cache: each instruction set, each feature set. Neighbouring
// pixels differ in every attribute, all lights are in range of all pixels. time / items = per pixel.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/aligned.hpp"
#include "frame/dispatch.hpp"
#include "kernels/interface.hpp"
#include "precompute/dfg.hpp"

namespace tessera {
namespace {

constexpr int cube_size = 256, cube_levels = 9, dfg_size = 128;

struct TileOfPixels {
  AlignedVector<float> planes = AlignedVector<float>(std::size_t{tile_pixels} * (gbuffer_planes + 3));
  std::vector<std::uint16_t> cube = std::vector<std::uint16_t>(4 * cube_texel_count(cube_size, cube_levels) + 8);
  DfgTable dfg = DfgTable(std::vector<float>(2 * dfg_size * dfg_size, 0.4f).data(), dfg_size);
  std::vector<LightView> lights;

  [[nodiscard]] float* plane(int k) { return planes.data() + std::size_t{tile_pixels} * k; }

  TileOfPixels() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1), symmetric(-1, 1);
    for (std::size_t i = 0; i < cube.size(); ++i) cube[i] = std::uint16_t(0x3000 + random() % 0xc00);  // 0.125 .. 1
    for (int i = 0; i < tile_pixels; ++i) {
      // A rough ball that fills the tile, seen from z = 4.
      const float x = (float(i % tile_size) - 15.5f) / 20, y = (float(i / tile_size) - 15.5f) / 20;
      const float z = std::sqrt(std::max(0.0f, 1 - x * x - y * y));
      float n[3] = {x + 0.1f * symmetric(random), y + 0.1f * symmetric(random), z + 0.1f * symmetric(random)};
      const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      const float values[] = {x,
                              y,
                              z,
                              n[0] / length,
                              n[1] / length,
                              n[2] / length,
                              unit(random),
                              unit(random),
                              unit(random),
                              unit(random),
                              0.08f + 0.92f * unit(random),
                              unit(random)};
      for (int k = 0; k < 12; ++k) plane(k)[i] = values[k];
    }
    for (int k = 0; k < 64; ++k) {
      LightView light{};
      light.type = LightType::point;
      light.falloff = Falloff::windowed_plus_one;
      light.position[0] = 4 * symmetric(random), light.position[1] = 4 * symmetric(random), light.position[2] = 5;
      light.color[0] = light.color[1] = light.color[2] = 1;
      light.inverse_range_squared = 1e-4f;
      lights.push_back(light);
    }
  }

  ShadeArgs args(std::uint32_t features, std::uint32_t light_count) {
    ShadeArgs a{};
    GBufferView& g = a.gbuffer;
    for (int c = 0; c < 3; ++c) {
      g.position[c] = plane(c), g.normal[c] = plane(3 + c), g.base_color[c] = plane(6 + c);
      g.emissive[c] = plane(12 + c), a.radiance[c] = plane(gbuffer_planes + c);
    }
    g.metallic = plane(9), g.roughness = plane(10), g.occlusion = plane(11);
    g.alpha = plane(15), g.unlit = plane(16), g.depth = plane(17);
    a.count = tile_pixels;
    a.features = features;
    a.eye[2] = 4, a.eye[3] = 1;
    a.lights = lights.data();
    a.light_count = light_count;
    a.environment.specular = {cube.data(), cube_size, cube_levels};
    a.environment.irradiance_sh[0][0] = 1;
    a.dfg = dfg.view();
    return a;
  }
};

void shade_pixels(benchmark::State& state, const Kernels* kernels, std::uint32_t features, std::uint32_t lights) {
  static TileOfPixels tile;
  const ShadeArgs args = tile.args(features, lights);
  for ([[maybe_unused]] auto _ : state) {
    kernels->shade(args);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * tile_pixels);
}

[[maybe_unused]] const bool registered = [] {
  struct Case {
    const char* name;
    std::uint32_t features, lights;
  };
  for (const Kernels* kernels : built_kernels()) {
    if (!cpu_runs(*kernels)) continue;
    for (const Case& c : {Case{"unlit", feature_unlit, 0}, Case{"lights:1", feature_lights, 1},
                          Case{"lights:4", feature_lights, 4}, Case{"lights:16", feature_lights, 16},
                          Case{"lights:64", feature_lights, 64}, Case{"environment", feature_environment, 0},
                          Case{"environment+lights:4", feature_environment | feature_lights, 4},
                          Case{"general+lights:4", feature_all, 4}})
      benchmark::RegisterBenchmark((std::string("shade/") + kernels->isa + "/" + c.name).c_str(), shade_pixels, kernels,
                                   c.features, c.lights);
  }
  return true;
}();

}  // namespace
}  // namespace tessera

// Resolve: fragments per second by material and by size of triangles, on every instruction set.
#include <benchmark/benchmark.h>

#include <string>

#include "bench/resolve_scene.hpp"
#include "frame/dispatch.hpp"

namespace tessera {
namespace {

enum Dressing { factors, base_color_only, full_pbr, full_pbr_derived_tangents };

void resolve(benchmark::State& state, const Kernels* kernels, Dressing dressing, int cell) {
  ResolveScene scene(cell, 1.4f / 1024);  // between mip levels 0 and 1
  NoiseTexture color(TexelFormat::rgba16_float), orm(TexelFormat::rgba8_unorm), normal(TexelFormat::rgba8_unorm),
      emissive(TexelFormat::rgba16_float);
  MaterialView& m = scene.material;
  if (dressing != factors) m.base_color_texture.texture = &color.view;
  if (dressing >= full_pbr) {
    m.metallic_roughness_texture.texture = m.occlusion_texture.texture = &orm.view;
    m.normal_texture.texture = &normal.view;
    m.emissive_texture.texture = &emissive.view;
    m.has_tangents = dressing == full_pbr;
  }
  for (auto _ : state) {
    scene.run(*kernels);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(scene.fragments.size()));
}

const int registered = [] {
  const std::pair<Dressing, const char*> dressings[] = {{factors, "factors"},
                                                        {base_color_only, "base_color"},
                                                        {full_pbr, "full_pbr"},
                                                        {full_pbr_derived_tangents, "full_pbr_derived_tangents"}};
  for (const Kernels* kernels : built_kernels()) {
    if (!cpu_runs(*kernels)) continue;
    for (const auto& [dressing, name] : dressings)
      for (const int cell : {32, 4, 1}) {
        const std::string title =
            std::string("resolve/") + kernels->isa + "/" + name + "/triangles_of:" + std::to_string(cell) + "px";
        benchmark::RegisterBenchmark(title.c_str(), resolve, kernels, dressing, cell);
      }
  }
  return 0;
}();

}  // namespace
}  // namespace tessera

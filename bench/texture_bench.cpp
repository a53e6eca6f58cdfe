// Texture sampling within resolve: one base-colour texture, by format, filter and footprint. "none" is the same run
// without a texture, to subtract.
#include <benchmark/benchmark.h>

#include <string>

#include "bench/resolve_scene.hpp"
#include "frame/dispatch.hpp"

namespace tessera {
namespace {

struct Case {
  const char* name;
  bool textured;
  TexelFormat format;
  FilterMode magnify, minify, mip;
  bool mipmapped;
  float texels_per_pixel;
};

constexpr FilterMode nearest = FilterMode::nearest, linear = FilterMode::linear;
constexpr TexelFormat bytes = TexelFormat::rgba8_unorm, halves = TexelFormat::rgba16_float;
constexpr Case cases[] = {
    {"none", false, bytes, linear, linear, linear, true, 1},
    {"rgba8_nearest", true, bytes, nearest, nearest, nearest, false, 1},
    {"rgba8_bilinear", true, bytes, linear, linear, linear, true, 0.5f},
    {"rgba8_trilinear", true, bytes, linear, linear, linear, true, 2.8f},
    {"rgba8_bilinear_scattered", true, bytes, linear, linear, linear, false, 37.3f},
    {"rgba16f_nearest", true, halves, nearest, nearest, nearest, false, 1},
    {"rgba16f_bilinear", true, halves, linear, linear, linear, true, 0.5f},
    {"rgba16f_trilinear", true, halves, linear, linear, linear, true, 2.8f},
    {"rgba16f_bilinear_scattered", true, halves, linear, linear, linear, false, 37.3f},
};

void sample(benchmark::State& state, const Kernels* kernels, const Case& c) {
  ResolveScene scene(tile_size, c.texels_per_pixel / 1024);
  NoiseTexture texture(c.format);
  texture.view.magnify = c.magnify;
  texture.view.minify = c.minify;
  texture.view.mip = c.mip;
  texture.view.mipmapped = c.mipmapped;
  if (c.textured) scene.material.base_color_texture.texture = &texture.view;
  for (auto _ : state) {
    scene.run(*kernels);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(scene.fragments.size()));
}

const int registered = [] {
  for (const Kernels* kernels : built_kernels()) {
    if (!cpu_runs(*kernels)) continue;
    for (const Case& c : cases)
      benchmark::RegisterBenchmark((std::string("texture/") + kernels->isa + "/" + c.name).c_str(), sample, kernels, c);
  }
  return 0;
}();

}  // namespace
}  // namespace tessera

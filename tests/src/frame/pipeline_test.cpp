// What a pipeline leaves out must not show: lights that do not reach a tile, planes that nobody wants.
#include "frame/pipeline.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "base/parallel.hpp"
#include "frame/dispatch.hpp"
#include "frame/material.hpp"
#include "frame/tables.hpp"
#include "golden/builder.hpp"
#include "golden/scenes.hpp"
#include "precompute/environment.hpp"

namespace tessera {
namespace {

/// A golden scene, prepared, with many lights of short range.
struct Prepared {
  golden::GoldenScene golden;
  TextureSet textures;
  std::vector<MaterialView> materials;
  std::vector<std::uint8_t> double_sided;
  std::vector<AlphaMode> alpha_modes;
  Environment environment;
  std::unique_ptr<Lighting> lighting;
  View view;

  Prepared(const golden::GoldenScene& scene, const Kernels& kernels)
      : golden(scene), environment(build_environment(golden::golden_environment(), {}, kernels)) {
    golden::Random random(3);
    for (int i = 0; i < 60; ++i) {
      Light light;
      for (float& c : light.position) c = float(random.between(-3, 3));
      light.range = float(random.between(0.1, 2));
      light.intensity = 3;
      golden.scene.lights.push_back(light);
    }
    materials = compile_materials(golden.scene, textures, kernels);
    for (const MaterialView& m : materials) {
      double_sided.push_back(m.double_sided);
      alpha_modes.push_back(m.alpha_mode);
    }
    lighting = std::make_unique<Lighting>(golden.scene.lights, &environment, kernels);
    view = make_view(golden.camera, golden.settings.width, golden.settings.height, kernels);
  }

  [[nodiscard]] Image render(const Kernels& kernels, const LightingView& lights, bool visited) const {
    Image film(golden.settings.width, golden.settings.height, 4);
    FramePipeline pipeline;
    FrameStatistics statistics;
    run_with_threads(2, [&] {
      pipeline.render({golden.scene.geometry(), materials, double_sided, alpha_modes, lights}, view, golden.settings,
                      lighting->background(golden.settings), kernels, {film.pixels.data(), film.width, film.height},
                      statistics,
                      visited ? FramePipeline::TileVisitor([](const TileFragments&, const TileRect&) {}) : nullptr);
    });
    return film;
  }
};

bool same_bits(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

TEST(Pipeline, NeitherLightsLeftOutNorPlanesLeftOutShow) {
  for (const Kernels* kernels : built_kernels()) {
    if (!cpu_runs(*kernels)) continue;
    for (const golden::GoldenScene& scene : golden::golden_scenes()) {
      const Prepared p(scene, *kernels);
      LightingView all = p.lighting->view(p.golden.settings);
      ASSERT_GT(all.bounds.count, 50u) << "culling is not put to the test";
      const Image culled = p.render(*kernels, all, false);
      all.bounds = {};
      EXPECT_TRUE(same_bits(culled, p.render(*kernels, all, false))) << kernels->isa << ' ' << scene.name;
      EXPECT_TRUE(same_bits(culled, p.render(*kernels, all, true))) << kernels->isa << ' ' << scene.name;
    }
  }
}

}  // namespace
}  // namespace tessera

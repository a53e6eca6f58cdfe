// A G-buffer that was written, read and shaded gives the bits of the render that wrote it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"
#include "frame/dispatch.hpp"
#include "frame/frame.hpp"
#include "golden/scenes.hpp"
#include "kernels/runnable_kernels.hpp"
#include "precompute/environment.hpp"
#include "src/frame/round_trip.hpp"

namespace tessera {
namespace {

class GBuffer : public testing::TestWithParam<int> {
 protected:
  golden::GoldenScene scene = golden::golden_scenes()[GetParam()];
  const Kernels& kernels = select_kernels();
  Environment environment = build_environment(golden::golden_environment(), {}, kernels);
  const Environment* used = scene.environment ? &environment : nullptr;
  std::string path = testing::TempDir() + "gbuffer_test_" + scene.name + ".exr";

  ~GBuffer() override { std::filesystem::remove(path); }

  void round_trip(int samples) {
    scene.settings.samples = samples;
    const View view = make_view(scene.camera, scene.settings.width, scene.settings.height, kernels);
    Renderer renderer(scene.scene, used, kernels);
    Frame rendered;
    renderer.render(view, scene.settings, {{}, true}, rendered);
    expect_same_bits_from_gbuffer(rendered, view, scene.scene.lights, used, scene.settings, kernels, path);
  }
};

TEST_P(GBuffer, OneSample) { round_trip(1); }
TEST_P(GBuffer, SeveralSamples) { round_trip(4); }

// A file may hold any numbers: they are put into range before kernels read tables by them.
TEST_P(GBuffer, HostileValuesGiveOneFinitePicture) {
  scene.settings.samples = 1;
  const View view = make_view(scene.camera, scene.settings.width, scene.settings.height, kernels);
  Renderer renderer(scene.scene, used, kernels);
  Frame rendered;
  renderer.render(view, scene.settings, {{}, true}, rendered);
  constexpr float hostile[] = {NAN, INFINITY, -INFINITY, 3e38f, -3e38f, -7, 57, 1e20f, -0.0f};
  GBufferImage image = rendered.gbuffer;
  std::size_t next = 0;
  for (std::size_t k = 0; k < 15; ++k)  // what shading reads
    for (std::size_t i = k; i < image.planes[k].size(); i += 5)
      image.planes[k][i] = hostile[next++ % std::size(hostile)];
  AlignedVector<float> first;
  for (const Kernels* each : runnable_kernels()) {
    Frame shaded;
    shade_gbuffer(image, view, scene.scene.lights, used, scene.settings, *each, shaded);
    const auto& pixels = shaded.rgba.pixels;
    ASSERT_TRUE(std::all_of(pixels.begin(), pixels.end(), [](float x) { return x >= 0 && x <= 1e31f; })) << each->isa;
    if (first.empty()) first.assign(pixels.begin(), pixels.end());
    EXPECT_EQ(std::memcmp(pixels.data(), first.data(), first.size() * sizeof(float)), 0) << each->isa;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, GBuffer, testing::Range(0, 6),
                         [](const auto& info) { return golden::golden_scenes()[info.param].name; });

TEST(GBufferFile, NamesTheMissingLayer) {
  const std::string path = testing::TempDir() + "gbuffer_test_missing.exr";
  const std::vector<float> plane(12, 1.0f);
  write_exr(path, 4, 3, {{"position.X", plane.data()}, {"position.Y", plane.data()}, {"position.Z", plane.data()}});
  try {
    read_gbuffer(path);
    FAIL() << "accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), ExitStatus::input);
    EXPECT_NE(std::string(e.what()).find("normal.X"), std::string::npos) << e.what();
  }
  std::filesystem::remove(path);
}

// Another program's file: only the required layers, no attributes. Pixels without a normal are empty.
TEST(GBufferFile, RequiredLayersSuffice) {
  const std::string path = testing::TempDir() + "gbuffer_test_foreign.exr";
  std::vector<float> ones(6, 1.0f), zeros(6, 0.0f), up(6, 1.0f);
  up[2] = 0;
  write_exr(path, 3, 2,
            {{"position.X", zeros.data()},
             {"position.Y", zeros.data()},
             {"position.Z", zeros.data()},
             {"normal.X", zeros.data()},
             {"normal.Y", up.data()},
             {"normal.Z", zeros.data()},
             {"albedo.R", ones.data()},
             {"albedo.G", ones.data()},
             {"albedo.B", ones.data()}});
  const GBufferFile file = read_gbuffer(path);
  EXPECT_FALSE(file.view.has_value());
  EXPECT_EQ(file.image.fragment_count(), 5u);
  EXPECT_EQ(file.image.counts[2], 0u);
  EXPECT_EQ(file.image.planes[10][0], 1.0f);  // roughness where absent
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace tessera

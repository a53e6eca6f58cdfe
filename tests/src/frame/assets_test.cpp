// Real models under real environments: every one renders to finite light, the same on every instruction set, and its
// G-buffer shades to the same bits. Skipped where the models are not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "frame/dispatch.hpp"
#include "io/gltf.hpp"
#include "io/image_file.hpp"
#include "precompute/environment.hpp"
#include "src/frame/round_trip.hpp"
#include "src/io/shared_assets.hpp"
#include "src/io/temporary_folder.hpp"

namespace tessera {
namespace {

std::vector<std::filesystem::path> models_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> models;
  if (!std::filesystem::exists(folder)) return models;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") models.push_back(entry.path());
  std::sort(models.begin(), models.end());
  return models;
}

TEST(Assets, RenderAndShadeToTheSameBits) {
  const std::vector<std::filesystem::path> models = models_below(shared_assets());
  if (models.empty()) GTEST_SKIP() << "no shared assets here";
  const TemporaryFolder folder;
  const Kernels& widest = select_kernels();
  const Image picture = read_image((shared_assets() / "environments/courtyard.exr").string());
  const EnvironmentSettings small{.background_size = 64, .specular_size = 64};
  const Environment environment = build_environment(picture, small, widest);
  RenderSettings settings;
  settings.width = 200;
  settings.height = 150;
  settings.background = Background::transparent;
  std::set<std::string> seen_nothing;
  for (const std::filesystem::path& model : models) {
    SCOPED_TRACE(model.filename().string());
    const Scene scene = load_gltf(model.string());
    const Camera camera = orbit_camera(bounds_of(scene), 0.4, 0.3, 0, 0.7, 4.0 / 3, widest);
    const View view = make_view(camera, settings.width, settings.height, widest);
    Frame first;
    for (const Kernels* kernels : built_kernels()) {
      if (!cpu_runs(*kernels)) continue;
      Renderer renderer(scene, &environment, *kernels);
      for (const int samples : {1, 4}) {
        settings.samples = samples;
        Frame frame;
        renderer.render(view, settings, {{}, kernels == &widest}, frame);
        if (kernels == built_kernels().front() && samples == 4) first.rgba = frame.rgba;
        if (samples == 4) {
          EXPECT_EQ(frame.rgba.pixels, first.rgba.pixels) << kernels->isa;
        }
        if (kernels != &widest) continue;
        for (const float c : frame.rgba.pixels) ASSERT_TRUE(std::isfinite(c) && c >= 0);
        if (frame.statistics.fragments == 0) seen_nothing.insert(model.filename().string());
        expect_same_bits_from_gbuffer(frame, view, scene.lights, &environment, settings, *kernels,
                                      folder.file("g.exr"));
      }
    }
  }
  // Single-sided planes that face the other way, and one whose cutoff lies above every alpha.
  const std::set<std::string> may_hide = {"22_vertex_color.gltf", "Material_AlphaMask_04.gltf"};
  for (const std::string& name : seen_nothing)
    EXPECT_TRUE(may_hide.count(name) == 1 || name.starts_with("Mesh_Indices")) << name << " shows nothing";
}

}  // namespace
}  // namespace tessera

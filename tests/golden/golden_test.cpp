// One set of hashes for every instruction set, thread count, tile order, compiler and build type.
// TESSERA_UPDATE_GOLDENS=1 writes images/golden/hashes.json anew, and pictures beside it for people to look at.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "base/hash.hpp"
#include "frame/dispatch.hpp"
#include "frame/frame.hpp"
#include "golden/scenes.hpp"
#include "io/image_file.hpp"
#include "precompute/environment.hpp"

namespace tessera::golden {
namespace {

const std::vector<std::string> intermediates = {"id", "depth", "normal", "albedo"};
const std::string folder = std::string(TESSERA_SOURCE_DIR) + "/images/golden";

std::string hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

std::map<std::string, std::string> hashes_of(const Frame& frame) {
  std::map<std::string, std::string> hashes{{"radiance", hex(frame.statistics.pixel_hash)}};
  for (const AovLayer& layer : frame.aovs) {
    PixelHash hash;
    for (const std::uint32_t v : layer.u32) hash.add(v);
    for (const auto& plane : layer.f32) hash.add(plane.data(), plane.size());
    hashes[layer.name] = hex(hash.value());
  }
  return hashes;
}

Environment environment_for(const Kernels& kernels) { return build_environment(golden_environment(), {}, kernels); }

std::vector<std::uint8_t> encoded(const Frame& frame, const Kernels& kernels) {
  std::vector<std::uint8_t> bytes(frame.rgba.pixels.size());
  kernels.encode({frame.rgba.pixels.data(), bytes.size() / 4, 1.0f, ToneCurve::khronos_neutral, bytes.data()});
  return bytes;
}

class Golden : public testing::TestWithParam<int> {};

TEST_P(Golden, SameBitsEverywhere) {
  GoldenScene g = golden_scenes()[GetParam()];
  const bool update = std::getenv("TESSERA_UPDATE_GOLDENS") != nullptr;
  const std::string file = folder + "/hashes.json";
  nlohmann::json golden = nlohmann::json::object();
  if (std::filesystem::exists(file)) golden = nlohmann::json::parse(std::ifstream(file));
  std::map<std::string, std::string> expected;
  if (!update) {
    ASSERT_TRUE(golden.contains(g.name)) << "no golden for " << g.name << " in " << file;
    expected = golden[g.name].get<std::map<std::string, std::string>>();
  }
  for (const Kernels* kernels : built_kernels()) {
    if (!cpu_runs(*kernels)) continue;
    const Environment environment = environment_for(*kernels);
    Renderer renderer(g.scene, g.environment ? &environment : nullptr, *kernels);
    const View view = make_view(g.camera, g.settings.width, g.settings.height, *kernels);
    for (const int threads : {1, 2, 7})
      for (const std::uint64_t seed : {0, 1}) {
        g.settings.threads = threads;
        g.settings.tile_order_seed = seed;
        Frame frame;
        renderer.render(view, g.settings, {intermediates, false}, frame);
        std::map<std::string, std::string> hashes = hashes_of(frame);
        PixelHash display;
        for (const std::uint8_t byte : encoded(frame, *kernels)) display.add(std::uint32_t{byte});
        hashes["display"] = hex(display.value());
        if (expected.empty()) expected = hashes;  // updating: the first sets the rule for the others
        EXPECT_EQ(hashes, expected) << kernels->isa << ", " << threads << " threads, tile order " << seed;
      }
  }
  if (update) {
    golden[g.name] = expected;
    std::filesystem::create_directories(folder);
    std::ofstream(file) << golden.dump(2) << '\n';
    const Kernels& kernels = select_kernels();
    const Environment environment = environment_for(kernels);
    Renderer renderer(g.scene, g.environment ? &environment : nullptr, kernels);
    Frame frame;
    renderer.render(make_view(g.camera, g.settings.width, g.settings.height, kernels), g.settings, {}, frame);
    write_png(folder + "/" + g.name + ".png", g.settings.width, g.settings.height, 4, encoded(frame, kernels).data());
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, testing::Range(0, 6),
                         [](const auto& info) { return golden_scenes()[info.param].name; });

// The pictures hold what the scenes promise, so that a hash cannot freeze an empty frame.
TEST(GoldenScenes, ShowSomething) {
  const Kernels& kernels = select_kernels();
  const Environment environment = environment_for(kernels);
  for (GoldenScene& g : golden_scenes()) {
    Renderer renderer(g.scene, g.environment ? &environment : nullptr, kernels);
    Frame frame;
    renderer.render(make_view(g.camera, g.settings.width, g.settings.height, kernels), g.settings, {}, frame);
    const double pixels = double(g.settings.width) * g.settings.height;
    EXPECT_GT(frame.statistics.pixels_shaded, 0.25 * pixels) << g.name;
    for (const float c : frame.rgba.pixels) {
      ASSERT_TRUE(std::isfinite(c)) << g.name;
      ASSERT_GE(c, 0) << g.name;
    }
  }
}

}  // namespace
}  // namespace tessera::golden

// tessera render: what comes out, where, and what is left behind.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "base/hash.hpp"
#include "io/image_file.hpp"
#include "program.hpp"

namespace tessera::cli_test {
namespace {

using Words = std::vector<std::string>;

// Shows its base colour (1, 0.5, 0.25) as it is, whatever the light.
std::string unlit_square() {
  return square_gltf(R"(,"extensionsUsed":["KHR_materials_unlit"])", R"(,"extensions":{"KHR_materials_unlit":{}})");
}

class Render : public testing::Test {
 protected:
  void SetUp() override {
    write_file(folder.path("unlit.gltf"), unlit_square());
    write_file(folder.path("square.gltf"), square_gltf());
  }
  // A small picture of a scene from its own camera, with more options.
  Result render(const std::string& scene, const std::string& output, const Words& more = {}) const {
    Words words = {"render",   folder.path(scene),
                   "-o",       output == "-" ? "-" : folder.path(output),
                   "--size",   "64x48",
                   "--camera", "front",
                   "--light",  "directional:0,0,-1:3.14159265"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  Folder folder;
};

std::array<float, 4> pixel(const ExrLayers& layers, int x, int y) {
  std::array<float, 4> out{};
  const char* const names[] = {"R", "G", "B", "A"};
  for (std::size_t k = 0; k < 4; ++k) out[k] = layers.f32.at(names[k])[static_cast<std::size_t>(y) * layers.width + x];
  return out;
}

TEST_F(Render, ExrIsLinearAndHasTheSquareInTheMiddle) {
  const Result result = render("unlit.gltf", "a.exr", {"--background", "0.125,0.25,4"});
  ASSERT_EQ(result.status, 0) << result.err;
  const ExrLayers layers = read_exr_layers(folder.path("a.exr"));
  ASSERT_EQ(layers.width, 64);
  ASSERT_EQ(layers.height, 48);
  EXPECT_EQ(pixel(layers, 32, 24), (std::array<float, 4>{1, 0.5f, 0.25f, 1}));
  EXPECT_EQ(pixel(layers, 1, 1), (std::array<float, 4>{0.125f, 0.25f, 4, 1}));
  // The square is 2 high, 3 away from a camera that sees 6 tan(0.45) there: 33.1 of 48 rows.
  int rows = 0;
  for (int y = 0; y < 48; ++y) rows += pixel(layers, 32, y)[1] == 0.5f;
  EXPECT_NEAR(rows, 48 / (3 * std::tan(0.45)), 2);
}

TEST_F(Render, PngIsSrgbEncoded) {
  const Result result = render("unlit.gltf", "a.png", {"--tonemap", "none", "--background", "#102030"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Image image = read_image(folder.path("a.png"));
  ASSERT_EQ(image.channels, 3);
  const float* middle = image.at(32, 24);
  // IEC 61966-2-1: 0.5 -> 188, 0.25 -> 137.
  EXPECT_NEAR(middle[0] * 255, 255, 0.01);
  EXPECT_NEAR(middle[1] * 255, 188, 0.01);
  EXPECT_NEAR(middle[2] * 255, 137, 0.01);
  const float* corner = image.at(1, 1);
  EXPECT_NEAR(corner[0] * 255, 0x10, 0.01);
  EXPECT_NEAR(corner[1] * 255, 0x20, 0.01);
  EXPECT_NEAR(corner[2] * 255, 0x30, 0.01);
}

TEST_F(Render, ExposureCountsInStopsAndLeavesExrAlone) {
  ASSERT_EQ(render("unlit.gltf", "a.png", {"--tonemap", "none", "--exposure", "-1"}).status, 0);
  EXPECT_NEAR(read_image(folder.path("a.png")).at(32, 24)[0] * 255, 188, 0.01);
  ASSERT_EQ(render("unlit.gltf", "a.exr", {"--tonemap", "none", "--exposure", "-1"}).status, 0);
  EXPECT_EQ(pixel(read_exr_layers(folder.path("a.exr")), 32, 24)[0], 1.0f);
}

TEST_F(Render, TransparentBackgroundHasNoAlpha) {
  ASSERT_EQ(render("unlit.gltf", "a.png", {"--background", "transparent"}).status, 0);
  const Image image = read_image(folder.path("a.png"));
  ASSERT_EQ(image.channels, 4);
  EXPECT_EQ(image.at(1, 1)[3], 0.0f);
  EXPECT_EQ(image.at(32, 24)[3], 1.0f);
}

TEST_F(Render, StandardOutputIsTheSamePng) {
  ASSERT_EQ(render("square.gltf", "a.png").status, 0);
  const Result result = render("square.gltf", "-", {"--quiet"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, read_file(folder.path("a.png")));
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out.substr(0, 4), "\x89PNG");
}

TEST_F(Render, ALightOfPiLuxGivesADiffuseSquareItsColour) {
  ASSERT_EQ(render("square.gltf", "a.exr").status, 0);
  const std::array<float, 4> middle = pixel(read_exr_layers(folder.path("a.exr")), 32, 24);
  // Lambert alone would give (1, 0.5, 0.25); a rough dielectric lobe of F0 = 0.04 adds and takes little head-on.
  EXPECT_NEAR(middle[0], 1.0, 0.06);
  EXPECT_NEAR(middle[1], 0.5, 0.04);
  EXPECT_NEAR(middle[2], 0.25, 0.04);
}

TEST_F(Render, CamerasThatSeeTheSameGiveTheSame) {
  ASSERT_EQ(render("unlit.gltf", "a.exr").status, 0);
  const double degrees = 0.9 * 180 / 3.14159265358979323846;
  ASSERT_EQ(run({"render", folder.path("unlit.gltf"), "-o", folder.path("b.exr"), "--size", "64x48", "--eye", "0,0,3",
                 "--target", "0,0,-1", "--up", "0,1,0", "--fov", std::to_string(degrees), "--background", "0,0,0"})
                .status,
            0);
  ASSERT_EQ(run({"render", folder.path("unlit.gltf"), "-o", folder.path("c.exr"), "--size", "64x48", "--orbit", "0,0,3",
                 "--fov", std::to_string(degrees), "--background", "0,0,0"})
                .status,
            0);
  const ExrLayers a = read_exr_layers(folder.path("a.exr")), b = read_exr_layers(folder.path("b.exr")),
                  c = read_exr_layers(folder.path("c.exr"));
  for (const auto& [x, y] : {std::pair{32, 24}, {16, 24}, {48, 24}, {32, 10}, {2, 2}}) {
    EXPECT_EQ(pixel(a, x, y)[0], pixel(b, x, y)[0]) << x << "," << y;
    EXPECT_EQ(pixel(a, x, y)[0], pixel(c, x, y)[0]) << x << "," << y;
  }
}

TEST_F(Render, LayersLieInTheExrOrBesideThePng) {
  ASSERT_EQ(render("square.gltf", "a.exr", {"--aov", "depth,normal,id,albedo"}).status, 0);
  const ExrLayers layers = read_exr_layers(folder.path("a.exr"));
  const std::size_t middle = 24 * 64 + 32, corner = 64 + 1;
  EXPECT_NEAR(layers.f32.at("depth.Z")[middle], 3, 1e-5);
  EXPECT_TRUE(std::isinf(layers.f32.at("depth.Z")[corner]));
  EXPECT_EQ(layers.f32.at("normal.Z")[middle], 1.0f);
  EXPECT_EQ(layers.f32.at("albedo.G")[middle], 0.5f);
  EXPECT_GE(layers.u32.at("id")[middle], 1u);
  EXPECT_EQ(layers.u32.at("id")[corner], 0u);
  ASSERT_EQ(layers.f32.count("R"), 1u);

  ASSERT_EQ(render("square.gltf", "b.png", {"--aov", "normal"}).status, 0);
  const ExrLayers beside = read_exr_layers(folder.path("b.aov.exr"));
  EXPECT_EQ(beside.f32.at("normal.Z"), layers.f32.at("normal.Z"));
  EXPECT_EQ(beside.f32.count("R"), 0u);
}

TEST_F(Render, StatisticsSayWhatHappened) {
  const Result result = render("square.gltf", "a.exr", {"--stats", folder.path("s.json"), "--threads", "2"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(read_file(folder.path("s.json")));
  EXPECT_EQ(json.at("triangles").at("in"), 2);
  EXPECT_EQ(json.at("triangles").at("kept"), 2);
  EXPECT_EQ(json.at("tiles").at("all"), 4);  // 64 x 48 in tiles of 32
  EXPECT_EQ(json.at("threads"), 2);
  EXPECT_EQ(json.at("width"), 64);
  EXPECT_GT(json.at("pixels_shaded"), 30 * 30);
  EXPECT_LT(json.at("pixels_shaded"), 38 * 38);
  EXPECT_GT(json.at("memory_bytes").at("peak"), 0);
  EXPECT_EQ(json.at("memory_bytes").at("tables"), 0);  // no environment, no tables
  double sum = 0;
  for (const char* stage : {"load", "environment", "prepare", "geometry", "tiles", "encode", "write"})
    sum += json.at("stages_ms").at(stage).get<double>();
  EXPECT_LE(sum, json.at("stages_ms").at("total").get<double>() * 1.001);
  // The hash is that of the pixels in the file: of the rows' own hashes, low word first.
  const ExrLayers layers = read_exr_layers(folder.path("a.exr"));
  PixelHash hash;
  for (int y = 0; y < 48; ++y) {
    PixelHash row;
    for (int x = 0; x < 64; ++x) row.add(pixel(layers, x, y).data(), 4);
    hash.add(static_cast<std::uint32_t>(row.value()));
    hash.add(static_cast<std::uint32_t>(row.value() >> 32));
  }
  EXPECT_EQ(json.at("pixel_hash"), fmt::format("{:016x}", hash.value()));
}

TEST_F(Render, NeitherThreadsNorInstructionSetShow) {
  ASSERT_EQ(render("square.gltf", "a.exr", {"--threads", "1", "--isa", "sse42"}).status, 0);
  ASSERT_EQ(render("square.gltf", "b.exr", {"--threads", "7"}).status, 0);
  for (const char* channel : {"R", "G", "B", "A"})
    EXPECT_EQ(read_exr_layers(folder.path("a.exr")).f32.at(channel),
              read_exr_layers(folder.path("b.exr")).f32.at(channel));
}

TEST_F(Render, WithoutAnyLightANeutralStudioIsPutUpAndSaid) {
  const Result result = run({"render", folder.path("square.gltf"), "-o", folder.path("a.exr"), "--size", "32x32"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("neutral"), std::string::npos) << result.err;
  const std::array<float, 4> middle = pixel(read_exr_layers(folder.path("a.exr")), 16, 16);
  EXPECT_GT(middle[0], 0.2f);
  EXPECT_LT(middle[0], 3.0f);
  EXPECT_GT(middle[0], middle[1]);
}

TEST_F(Render, UnknownCameraListsThoseOfTheFile) {
  const Result result = run({"render", folder.path("square.gltf"), "-o", folder.path("a.png"), "--camera", "back"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("'front'"), std::string::npos) << result.err;
}

TEST_F(Render, BadInputIsStatus3AndLeavesNoOutput) {
  write_file(folder.path("bad.gltf"), "{");
  write_file(folder.path("bad.exr"), "not an image");
  for (const Words& words : {Words{folder.path("missing.glb")}, Words{folder.path("bad.gltf")},
                             Words{folder.path("square.gltf"), "--env", folder.path("bad.exr")},
                             Words{folder.path("square.gltf"), "--env", folder.path("missing.exr")}}) {
    Words all = {"render", "-o", folder.path("out.png"), "--size", "16x16"};
    all.insert(all.end(), words.begin(), words.end());
    const Result result = run(all);
    EXPECT_EQ(result.status, 3) << result.err;
    EXPECT_EQ(result.err.rfind("tessera: error: ", 0), 0u) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_EQ(folder.names(), (Words{"bad.exr", "bad.gltf", "square.gltf", "unlit.gltf"}));
}

TEST_F(Render, UnwritableOutputIsStatus4BeforeTheWorkBegins) {
  for (const std::string& output : {folder.path("no/such/folder/a.png"), folder.get().string() + "/."}) {
    const Result result = run({"render", folder.path("missing.glb"), "-o", output, "--format", "png"});
    EXPECT_EQ(result.status, 4) << result.err;
    EXPECT_EQ(result.err.rfind("tessera: error: ", 0), 0u) << result.err;
  }
  const Result full =
      run({"render", folder.path("square.gltf"), "-o", "/dev/full", "--format", "png", "--size", "16x16", "-q"});
  EXPECT_EQ(full.status, 4) << full.err;
}

TEST_F(Render, InterruptedLeavesNothingBehind) {
  const auto has_temporary = [](const std::filesystem::path& path) {
    for (const auto& entry : std::filesystem::directory_iterator(path))
      if (entry.path().filename().string().find(".tessera-") != std::string::npos) return true;
    return false;
  };
  const Words before = folder.names();
  const Result result = interrupt({"render", folder.path("unlit.gltf"), "-o", folder.path("big.png"), "--size",
                                   "2500x2000", "--samples", "1", "--background", "0,0,0", "--camera", "front"},
                                  SIGINT, has_temporary, folder.get());
  EXPECT_EQ(result.status, 128 + SIGINT) << result.err;
  EXPECT_EQ(folder.names(), before);
}

}  // namespace
}  // namespace tessera::cli_test

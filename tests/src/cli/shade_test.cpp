// tessera shade: the same bits as the render that wrote the G-buffer.
#include <gtest/gtest.h>

#include "io/image_file.hpp"
#include "program.hpp"

namespace tessera::cli_test {
namespace {

using Words = std::vector<std::string>;

// A light in the file, so that it has to travel with the G-buffer.
constexpr const char* file_light = R"(,"extensionsUsed":["KHR_lights_punctual"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":7,"color":[1,0.9,0.8]}]}})";

std::string lit_square() {
  std::string text = square_gltf(file_light);
  const std::string node = R"({"mesh":0,"name":"square"})";
  text.replace(text.find(node), node.size(), R"({"mesh":0,"name":"square","children":[2]})");
  const std::string camera = R"("name":"front"})";
  text.insert(text.find(camera) + camera.size(),
              R"(,{"translation":[0.5,0.25,1],"extensions":{"KHR_lights_punctual":{"light":0}}})");
  return text;
}

void expect_same_picture(const std::string& a, const std::string& b) {
  const ExrLayers first = read_exr_layers(a), second = read_exr_layers(b);
  ASSERT_EQ(first.width, second.width);
  for (const char* channel : {"R", "G", "B", "A"}) EXPECT_EQ(first.f32.at(channel), second.f32.at(channel)) << channel;
}

class Shade : public testing::TestWithParam<const char*> {};

TEST_P(Shade, RepeatsTheRender) {
  const Folder folder;
  write_file(folder.path("a.gltf"), lit_square());
  const Words light = {"--light", "directional:-1,-1,-1:2"};
  Words render = {"render",       folder.path("a.gltf"),
                  "-o",           folder.path("a.exr"),
                  "--size",       "70x50",
                  "--samples",    GetParam(),
                  "--aov",        "gbuffer",
                  "--background", "0.5,0.25,0.125"};
  render.insert(render.end(), light.begin(), light.end());
  const Result first = run(render);
  ASSERT_EQ(first.status, 0) << first.err;
  Words shade = {"shade", folder.path("a.gbuffer.exr"), "-o", folder.path("b.exr"), "--background", "0.5,0.25,0.125"};
  shade.insert(shade.end(), light.begin(), light.end());
  const Result second = run(shade);
  ASSERT_EQ(second.status, 0) << second.err;
  expect_same_picture(folder.path("a.exr"), folder.path("b.exr"));

  // The comparison can fail: other light, other pixels.
  shade.push_back("--no-file-lights");
  shade[3] = folder.path("c.exr");
  ASSERT_EQ(run(shade).status, 0);
  EXPECT_NE(read_exr_layers(folder.path("a.exr")).f32.at("R"), read_exr_layers(folder.path("c.exr")).f32.at("R"));
}

INSTANTIATE_TEST_SUITE_P(Samples, Shade, testing::Values("1", "4"));

// The cheaper forms of light are the same forms there.
TEST(ShadeForms, RepeatTheRenderToo) {
  const Folder folder;
  write_file(folder.path("a.gltf"), lit_square());
  write_file(folder.path("sky.hdr"),
             "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x20\x81\x20\x40\x80\x80");
  const std::vector<Words> forms = {{"--env-texels", "rgb9e5", "--env-albedo", "fit"},
                                    {"--env-irradiance", "cube", "--env-albedo", "small-fit", "--env-size", "32"},
                                    {"--light-cutoff", "4"}};
  std::vector<AlignedVector<float>> seen;
  for (const Words& form : forms) {
    Words render = {"render", folder.path("a.gltf"), "-o", folder.path("a.exr"), "--size", "40x30", "--aov", "gbuffer",
                    "--env",  folder.path("sky.hdr")};
    Words shade = {"shade", folder.path("a.gbuffer.exr"), "-o", folder.path("b.exr"), "--env", folder.path("sky.hdr")};
    render.insert(render.end(), form.begin(), form.end());
    shade.insert(shade.end(), form.begin(), form.end());
    ASSERT_EQ(run(render).status, 0) << form[0];
    ASSERT_EQ(run(shade).status, 0) << form[0];
    expect_same_picture(folder.path("a.exr"), folder.path("b.exr"));
    seen.push_back(read_exr_layers(folder.path("a.exr")).f32.at("R"));
  }
  EXPECT_NE(seen[0], seen[1]);
  EXPECT_NE(seen[0], seen[2]);
}

TEST(ShadeForeign, TakesALayersFileOfAnotherProgram) {
  const Folder folder;
  // One white diffuse pixel that faces a light of pi lux, beside an empty one.
  const float zero[2] = {0, 0}, one[2] = {1, 1}, up[2] = {1, 0}, rough[2] = {1, 1};
  write_exr(folder.path("g.exr"), 2, 1,
            {{"position.X", zero},
             {"position.Y", zero},
             {"position.Z", zero},
             {"normal.X", zero},
             {"normal.Y", up},
             {"normal.Z", zero},
             {"albedo.R", one},
             {"albedo.G", one},
             {"albedo.B", one},
             {"roughness", rough}});
  const Words words = {
      "shade",        folder.path("g.exr"), "-o", folder.path("a.exr"), "--light", "directional:0,-1,0:3.14159265",
      "--background", "transparent"};
  const Result without_eye = run(words);
  EXPECT_EQ(without_eye.status, 2);
  EXPECT_NE(without_eye.err.find("--eye"), std::string::npos) << without_eye.err;
  Words with_eye = words;
  with_eye.insert(with_eye.end(), {"--eye", "0,5,0.1"});
  const Result result = run(with_eye);
  ASSERT_EQ(result.status, 0) << result.err;
  const ExrLayers layers = read_exr_layers(folder.path("a.exr"));
  EXPECT_NEAR(layers.f32.at("R")[0], 1.0, 0.06);
  EXPECT_EQ(layers.f32.at("A")[0], 1.0f);
  EXPECT_EQ(layers.f32.at("A")[1], 0.0f);
}

TEST(ShadeForeign, AMissingLayerIsNamed) {
  const Folder folder;
  const float zero[1] = {0};
  write_exr(folder.path("g.exr"), 1, 1, {{"position.X", zero}});
  const Result result = run({"shade", folder.path("g.exr"), "-o", folder.path("a.exr"), "--eye", "0,0,1"});
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.err.find("position.Y"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace tessera::cli_test

// tessera bake and tessera reference, as a person runs them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "io/image_file.hpp"
#include "program.hpp"

namespace tessera::cli_test {
namespace {

using Words = std::vector<std::string>;

// 64 x 32: a gradient with a bright spot.
void write_sky(const std::string& path, float spot = 300, float odd = 0.5f) {
  std::vector<float> rgb;
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 64; ++i)
      for (int c = 0; c < 3; ++c) rgb.push_back(i == 40 && j == 9 ? spot : 0.3f + 0.02f * float(j) * float(c + 1));
  rgb[7] = odd;
  write_exr(path, 64, 32, {{"R", &rgb[0], nullptr, 3}, {"G", &rgb[1], nullptr, 3}, {"B", &rgb[2], nullptr, 3}});
}

std::vector<float> pixels(const std::string& path) {
  const ExrLayers layers = read_exr_layers(path);
  std::vector<float> all;
  for (const char* channel : {"R", "G", "B"}) {
    const auto& plane = layers.f32.at(channel);
    all.insert(all.end(), plane.begin(), plane.end());
  }
  return all;
}

class Bake : public testing::Test {
 protected:
  void expect_ok(const Words& words) {
    const Result result = run(words);
    ASSERT_EQ(result.status, 0) << result.err;
  }
  Result fails(const Words& words, int status) {
    const Result result = run(words);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    return result;
  }
  std::string path(const std::string& name) { return folder_.path(name); }
  Folder folder_;
};

TEST_F(Bake, ABakedEnvironmentRendersTheSamePicture) {
  write_sky(path("a.exr"));
  write_file(path("s.gltf"), square_gltf());
  expect_ok({"bake", path("a.exr"), "-o", path("a.tsra"), "--rotation", "30", "-q"});
  for (const char* env : {"a.exr", "a.tsra"}) {
    Words words = {"render", path("s.gltf"), "--env", path(env),
                   "--size", "60x40",        "-o",    path(std::string(env) + ".out.exr")};
    if (env == std::string("a.exr")) words.insert(words.end(), {"--env-rotation", "30"});
    expect_ok(words);
  }
  EXPECT_EQ(pixels(path("a.exr.out.exr")), pixels(path("a.tsra.out.exr")));
  fails({"render", path("s.gltf"), "--env", path("a.tsra"), "--env-intensity", "2", "-o", path("x.png")}, 2);
}

TEST_F(Bake, FacesComeBack) {
  write_sky(path("a.exr"));
  for (const char* format : {"exr", "rgbe"}) {
    expect_ok({"bake", path("a.exr"), "--cube", path("faces"), "--format", format, "--levels", "3", "-q"});
    const std::string end = format == std::string("exr") ? ".exr" : ".hdr";
    for (const char* name : {"m0_px", "m1_nz", "m2_py", "irradiance_ny"})
      EXPECT_NO_THROW(read_image(path("faces/" + std::string(name) + end))) << name;
    const Image face = read_image(path("faces/m0_pz" + end));
    EXPECT_EQ(face.width, 64);
    // Faces are an input too: baked again, the sharpest level is the same (halves; RGBE has 8 bits).
    expect_ok({"bake", path("faces"), "--cube", path("again"), "--levels", "3", "-q"});
    const Image again = read_image(path("again/m0_pz.exr"));
    ASSERT_EQ(again.pixels.size(), face.pixels.size());
    for (std::size_t i = 0; i < face.pixels.size(); ++i)
      ASSERT_NEAR(again.pixels[i], face.pixels[i], 1e-3f * face.pixels[i]) << i;
    std::filesystem::remove_all(path("faces"));
  }
}

TEST_F(Bake, PicturesOfIntegersAreDecodedFromSrgb) {
  const std::vector<unsigned char> grey(16 * 8 * 3, 128);
  write_png(path("a.png"), 16, 8, 3, grey.data());
  expect_ok({"bake", path("a.png"), "--cube", path("faces"), "-q"});
  const double x = 128 / 255.0, linear = std::pow((x + 0.055) / 1.055, 2.4);
  EXPECT_NEAR(double(read_image(path("faces/m0_px.exr")).pixels[0]), linear, 1e-4);
}

TEST_F(Bake, HarmonicsArePrinted) {
  const std::vector<float> white(8 * 4 * 3, 2.0f);
  write_exr(path("w.exr"), 8, 4,
            {{"R", &white[0], nullptr, 3}, {"G", &white[1], nullptr, 3}, {"B", &white[2], nullptr, 3}});
  const Result result = run({"bake", path("w.exr"), "--sh", "-q"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("7.0898"), std::string::npos) << result.out;  // 2 sqrt(4 pi)
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 10);
}

// The column of RMS errors, one for each level.
std::vector<double> checked_errors(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::vector<double> errors;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.rfind("the brightest", 0) != 0) {
    std::istringstream words(line);
    double level = 0, size = 0, roughness = 0, texels = 0, rms = -1, largest = -1, seam = -1;
    words >> level >> size >> roughness >> texels >> rms >> largest >> seam;
    EXPECT_EQ(size, 64 / std::pow(2, level)) << text;
    EXPECT_GE(largest, rms) << text;
    EXPECT_TRUE(seam > 0 && seam < 1.1) << text;
    errors.push_back(rms);
  }
  return errors;
}

TEST_F(Bake, ComparesItsLevelsWithBruteForce) {
  write_sky(path("a.exr"), 5000);
  const Words words = {"bake", path("a.exr"), "--size", "64", "--levels", "6", "--check", "400", "-q"};
  const Result exact = run(words);
  ASSERT_EQ(exact.status, 0) << exact.err;
  const std::vector<double> errors = checked_errors(exact.out);
  ASSERT_EQ(errors.size(), 5u) << exact.out;
  for (const double error : errors) EXPECT_TRUE(error > 0 && error < 1e-3) << exact.out;
  Words coarse = words;
  coarse.insert(coarse.end(), {"--samples", "2"});
  const Result sampled = run(coarse);
  ASSERT_EQ(sampled.status, 0) << sampled.err;
  for (const double error : checked_errors(sampled.out)) EXPECT_GT(error, 1e-3) << sampled.out;
  fails({"bake", path("a.exr"), "--check", "-3"}, 2);
  fails({"bake", path("a.exr"), "--check", "3", "-o", "-"}, 2);
}

TEST_F(Bake, SaysWhatItPutRightAndTookOut) {
  write_sky(path("a.exr"), 20000, std::nanf(""));
  write_file(path("s.gltf"), square_gltf());
  const Result result = run({"bake", path("a.exr"), "-o", path("a.tsra"), "--extract-light"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("1 texels are infinite or not a number"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("light taken out: directional:"), std::string::npos) << result.err;
  expect_ok({"render", path("s.gltf"), "--env", path("a.tsra"), "--size", "20x20", "-o", path("lit.exr")});
}

TEST_F(Bake, HostilePicturesGetOneLine) {
  write_file(path("empty.exr"), "");
  write_file(path("text.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000 +X 1000000\n");
  write_file(path("short.tsra"), "TSRA\1");
  write_file(path("s.gltf"), square_gltf());
  for (const char* name : {"empty.exr", "text.hdr", "short.tsra", "missing.exr"}) {
    const Result result = fails({"bake", path(name), "-o", path("x.tsra"), "-q"}, 3);
    EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
  }
  fails({"bake", folder_.get().string(), "-o", path("x.tsra")}, 3);  // a folder without faces
  fails({"bake", path("empty.exr")}, 2);                             // nothing to write
  fails({"bake", path("empty.exr"), "-o", path("x.tsra"), "--size", "100"}, 2);
  fails({"render", path("s.gltf"), "--env-lobe", "round", "-o", path("x.png")}, 2);
  // One texel, and one column.
  const float one[3] = {1, 2, 3};
  write_exr(path("one.exr"), 1, 1, {{"R", one}, {"G", one + 1}, {"B", one + 2}});
  expect_ok({"bake", path("one.exr"), "-o", path("one.tsra"), "-q"});
  std::vector<float> column(7, 1.0f);
  write_exr(path("column.exr"), 1, 7, {{"R", column.data()}, {"G", column.data()}, {"B", column.data()}});
  expect_ok({"bake", path("column.exr"), "-o", path("column.tsra"), "-q"});
}

TEST_F(Bake, ReferenceAgreesWithARoughRenderAndRepeatsItself) {
  write_sky(path("a.exr"), 2);
  write_file(path("s.gltf"), square_gltf());
  const Words reference = {"reference", path("s.gltf"), "--env", path("a.exr"), "--size",
                           "24x16",     "--rays",       "400",   "-q"};
  Words first = reference, second = reference;
  first.insert(first.end(), {"-o", path("one.exr"), "--threads", "1"});
  second.insert(second.end(), {"-o", path("three.exr"), "--threads", "3"});
  expect_ok(first);
  expect_ok(second);
  const std::vector<float> truth = pixels(path("one.exr"));
  EXPECT_EQ(truth, pixels(path("three.exr")));
  expect_ok(
      {"render", path("s.gltf"), "--env", path("a.exr"), "--size", "24x16", "--samples", "1", "-o", path("r.exr")});
  const std::vector<float> render = pixels(path("r.exr"));
  const ExrLayers layers = read_exr_layers(path("one.exr"));
  const std::size_t middle = 8 * 24 + 12;
  const float error = layers.f32.at("error.R").at(middle);
  EXPECT_GT(error, 0);
  EXPECT_NEAR(render[middle], truth[middle], 4 * error + 0.03f * truth[middle]);
  fails({"reference", path("s.gltf"), "-o", path("x.png")}, 2);
}

}  // namespace
}  // namespace tessera::cli_test

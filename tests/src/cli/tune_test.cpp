// tessera tune: what it measures, against pictures that the program renders; and what `render` makes of its file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "io/image_file.hpp"
#include "program.hpp"

namespace tessera::cli_test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

// A smooth metal, so that it matters how reflections are looked up.
std::string mirror() {
  std::string text = square_gltf();
  const std::string rough = R"("metallicFactor":0,"roughnessFactor":0.9)";
  text.replace(text.find(rough), rough.size(), R"("metallicFactor":1,"roughnessFactor":0.4)");
  return text;
}

class Tune : public testing::Test {
 protected:
  void SetUp() override { write_file(folder.path("a.gltf"), mirror()); }
  [[nodiscard]] Result program(const std::string& command, const Words& more) const {
    Words words = {command, folder.path("a.gltf"), "--size", "96x64", "--orbit", "70,20", "--threads", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  [[nodiscard]] Json tuned(const Words& more) const {
    Words words = {"--results", folder.path("r.json"), "--frames", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = program("tune", words);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.status == 0 ? Json::parse(read_file(folder.path("r.json"))) : Json();
  }
  [[nodiscard]] Image rendered(const Words& more) const {
    Words words = {"-o", folder.path("p.png")};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = program("render", words);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_image(folder.path("p.png"));
  }
  [[nodiscard]] Image rendered(const Json& point, const Words& more = {}) const {
    Words words = {point.at("specular-occlusion").get<bool>() ? "--specular-occlusion" : "--specular-occlusion=false"};
    for (const char* key :
         {"env-lobe", "env-fresnel", "env-albedo", "env-texels", "env-irradiance", "texture-filter", "color-texels"}) {
      words.push_back(std::string("--") + key);
      words.push_back(point.at(key).get<std::string>());
    }
    for (const char* key : {"samples", "light-cutoff"}) {
      words.push_back(std::string("--") + key);
      words.push_back(point.at(key).dump());
    }
    if (point.at("env-size") != 0) {
      words.push_back("--env-size");
      words.push_back(point.at("env-size").dump());
    }
    words.insert(words.end(), more.begin(), more.end());
    return rendered(words);
  }
  [[nodiscard]] static Json chosen_of(const Json& results) {
    for (const Json& point : results.at("points"))
      if (point.at("chosen")) return point;
    return {};
  }
  Folder folder;
};

TEST_F(Tune, ErrorsAreThoseOfThePicturesThatRenderMakes) {
  const Json results = tuned({"--max-error", "0.5", "--exposure", "1"});
  const Json& points = results.at("points");
  ASSERT_TRUE(points.at(0).at("exact"));
  EXPECT_EQ(points.at(0).at("samples"), 16);
  EXPECT_EQ(points.at(0).at("mean_error"), 0.0);
  const Image exact = rendered(points.at(0), {"--exposure", "1"});
  ASSERT_EQ(program("render", {"-o", folder.path("c.exr"), "--samples", "16", "--aov", "coverage"}).status, 0);
  const AlignedVector<float> coverage = read_exr_layers(folder.path("c.exr")).f32.at("coverage");
  const auto pixels =
      static_cast<std::size_t>(std::count_if(coverage.begin(), coverage.end(), [](float c) { return c > 0; }));
  EXPECT_EQ(results.at("pixels"), pixels);
  std::size_t compared = 0;
  for (const Json& point : points) {
    if (++compared % 4 != 0) continue;  // some of all kinds
    const Image image = rendered(point, {"--exposure", "1"});
    double sum = 0;
    std::vector<double> largest;
    for (std::size_t i = 0; i < coverage.size(); ++i) {
      if (!(coverage[i] > 0)) continue;
      double most = 0;
      for (std::size_t c = i * 3; c < i * 3 + 3; ++c) {
        const double d = std::round(255 * std::abs(double(image.pixels[c]) - double(exact.pixels[c])));
        sum += d;
        most = std::max(most, d);
      }
      largest.push_back(most);
    }
    std::sort(largest.begin(), largest.end());
    EXPECT_NEAR(point.at("mean_error").get<double>(), sum / (3.0 * double(pixels)), 1e-6) << point;
    EXPECT_EQ(point.at("p99_error").get<double>(), largest[(largest.size() * 99 + 99) / 100 - 1]) << point;
  }
  EXPECT_GT(compared, 12u);
}

TEST_F(Tune, TheFileOfSettingsGivesTheChosenPicture) {
  const Json results = tuned({"--max-error", "1", "-o", folder.path("s.json")});
  const Json chosen = chosen_of(results), file = Json::parse(read_file(folder.path("s.json")));
  EXPECT_LE(chosen.at("mean_error").get<double>(), 1);
  for (const char* key : {"samples", "env-lobe", "env-fresnel", "specular-occlusion", "env-albedo", "env-size",
                          "env-texels", "env-irradiance", "light-cutoff", "texture-filter", "color-texels"})
    EXPECT_EQ(file.at(key), chosen.at(key));
  EXPECT_NE(file.at("about").get<std::string>().find("a.gltf"), std::string::npos);
  EXPECT_EQ(rendered(Words{"--settings", folder.path("s.json")}).pixels, rendered(chosen).pixels);
}

TEST_F(Tune, LimitsHoldAndNothingCheaperWasWithinThem) {
  for (const Words& limits : {Words{"--max-error", "0"}, Words{"--max-error", "0.3"}, Words{"--max-error", "255"},
                              Words{"--max-error", "255", "--max-p99", "2"}}) {
    const Json results = tuned(limits), chosen = chosen_of(results);
    const double mean = std::stod(limits[1]), p99 = limits.size() > 2 ? std::stod(limits[3]) : 255;
    EXPECT_LE(chosen.at("mean_error").get<double>(), mean);
    EXPECT_LE(chosen.at("p99_error").get<double>(), p99);
    for (const Json& point : results.at("points")) {
      if (point.at("mean_error").get<double>() > mean || point.at("p99_error").get<double>() > p99) continue;
      EXPECT_GE(point.at("ms").get<double>() * 1.0201, chosen.at("ms").get<double>());
    }
  }
}

TEST_F(Tune, WhatIsGivenIsNotVaried) {
  const Json results = tuned({"--samples", "2", "--env-lobe", "taps2"});
  for (const Json& point : results.at("points")) {
    EXPECT_EQ(point.at("samples"), 2);
    EXPECT_EQ(point.at("env-lobe"), "taps2");
  }
  for (const Json& point : tuned({"--env-size", "64", "--env-texels", "rgb9e5", "--env-albedo", "fit"}).at("points")) {
    EXPECT_EQ(point.at("env-size"), 64);
    EXPECT_EQ(point.at("env-texels"), "rgb9e5");
    EXPECT_EQ(point.at("env-albedo"), "fit");
  }
  // Without an environment only the samples matter: five choices.
  EXPECT_EQ(tuned({"--light", "directional:0,0,-1:3"}).at("points").size(), 5u);
}

TEST_F(Tune, WhatTheSceneHasIsVaried) {
  const auto values = [](const Json& results, const char* key) {
    std::set<std::string> all;
    for (const Json& point : results.at("points")) all.insert(point.at(key).dump());
    return all;
  };
  const Json by_environment = tuned({});
  EXPECT_EQ(values(by_environment, "samples").size(), 5u);
  EXPECT_EQ(values(by_environment, "env-lobe").size(), 5u);
  EXPECT_EQ(values(by_environment, "env-fresnel").size(), 2u);
  EXPECT_EQ(values(by_environment, "env-albedo").size(), 3u);
  EXPECT_GE(values(by_environment, "env-size").size(), 2u);
  EXPECT_EQ(values(by_environment, "env-texels").size(), 2u);
  EXPECT_EQ(values(by_environment, "env-irradiance"), (std::set<std::string>{"\"cube\"", "\"sh\""}));
  EXPECT_EQ(values(by_environment, "light-cutoff").size(), 1u);
  EXPECT_EQ(values(by_environment, "texture-filter").size(), 1u);
  const Json by_light = tuned({"--light", "point:0,0,2:3", "--exposure", "1"});
  EXPECT_EQ(values(by_light, "light-cutoff").size(), 4u);
  EXPECT_EQ(values(by_light, "light-cutoff").count("0.05"), 1u);  // 0.1 lux, twice as bright
  EXPECT_EQ(values(by_light, "env-lobe").size(), 1u);
}

TEST_F(Tune, TheChartShowsTheChoiceAndTheLimit) {
  const Json results = tuned({"--max-error", "0.7", "--chart", folder.path("t.svg"), "--samples", "2"});
  const std::string svg = read_file(folder.path("t.svg"));
  for (const char* words : {"<svg", "a.gltf", "E = 0.7", "chosen-ring", "ms a frame", "display steps", "</svg>"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  std::size_t dots = 0;
  for (std::size_t at = svg.find("class=\"dot\""); at != std::string::npos; at = svg.find("class=\"dot\"", at + 1))
    ++dots;
  EXPECT_EQ(dots, results.at("points").size() + 3);  // and three of the legend
}

// Every form that `tune` may choose: one picture whatever the instruction set and the threads.
TEST_F(Tune, CheapFormsAreAsDeterministicAsTheOthers) {
  const std::vector<Words> forms = {{"--env-albedo", "fit", "--env-texels", "rgb9e5", "--env-lobe", "taps2"},
                                    {"--env-albedo", "small-fit", "--env-irradiance", "cube", "--env-lobe", "fis8"},
                                    {"--env-size", "32", "--env-irradiance", "sh", "--env-texels", "rgb9e5"},
                                    {"--light", "point:0.5,0,2:3", "--light-cutoff", "0.5"}};
  std::vector<std::string> isas;
  for (const char* isa : {"sse42", "avx2", "avx512", "neon64"})
    if (program("render", {"-o", folder.path("x.png"), "--isa", isa}).status == 0) isas.emplace_back(isa);
  ASSERT_FALSE(isas.empty());
  const Image plain = rendered(Words{});
  for (const Words& form : forms) {
    const Image first = rendered(form);
    EXPECT_NE(first.pixels, plain.pixels) << form[1];
    for (const std::string& isa : isas) {
      Words words = form;
      words.insert(words.end(), {"--isa", isa});
      EXPECT_EQ(rendered(words).pixels, first.pixels) << form[1] << " " << isa;
    }
  }
}

TEST_F(Tune, ABakedEnvironmentHasItsSize) {
  write_file(folder.path("e.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x20\x81\x20\x40\x80\x80");
  ASSERT_EQ(run({"bake", folder.path("e.hdr"), "--size", "64", "-o", folder.path("e.tsra"), "-q"}).status, 0);
  const Words baked = {"-o", folder.path("p.png"), "--env", folder.path("e.tsra")};
  const auto with = [&](const char* size) {
    Words words = baked;
    words.insert(words.end(), {"--env-size", size});
    return program("render", words);
  };
  EXPECT_EQ(with("64").status, 0);
  const Result other = with("32");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("of size 32 are asked for, but it has 64"), std::string::npos) << other.err;
  const Json results = tuned({"--env", folder.path("e.tsra")});
  for (const Json& point : results.at("points")) EXPECT_EQ(point.at("env-size"), 0);
}

TEST_F(Tune, OptionsWinOverTheFile) {
  write_file(folder.path("s.json"), R"({"tessera-settings": 1, "samples": 1, "env-lobe": "n=v", "env-fresnel": "kS",
                                        "specular-occlusion": true})");
  const Words file = {"--settings", folder.path("s.json")};
  const Image plain = rendered(Words{"--samples", "4"}), one = rendered(file);
  EXPECT_EQ(
      one.pixels,
      rendered(Words{"--samples", "1", "--env-lobe", "n=v", "--env-fresnel", "kS", "--specular-occlusion"}).pixels);
  EXPECT_NE(one.pixels, plain.pixels);
  EXPECT_EQ(rendered(Words{"--settings", folder.path("s.json"), "--samples", "4", "--env-lobe", "taps4",
                           "--env-fresnel", "f0", "--specular-occlusion=false"})
                .pixels,
            plain.pixels);
  EXPECT_EQ(rendered(Words{}).pixels, plain.pixels);
}

TEST_F(Tune, TableAndChartGoWhereTheyShould) {
  const Result shown = program("tune", {"--frames", "1"});
  ASSERT_EQ(shown.status, 0) << shown.err;
  for (const char* words : {"(exact)", "(the default)", "<- chosen", "16 samples, taps4, f0", "ms a frame"})
    EXPECT_NE(shown.out.find(words), std::string::npos) << words << " in\n" << shown.out;
  const Result piped = program("tune", {"--frames", "1", "-o", "-"});
  ASSERT_EQ(piped.status, 0) << piped.err;
  EXPECT_EQ(Json::parse(piped.out).at("tessera-settings"), 1);
  EXPECT_NE(piped.err.find("<- chosen"), std::string::npos);
  const Result quiet = program("tune", {"--frames", "1", "-q", "-o", folder.path("s.json")});
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Tune, WhatIsWrongIsSaid) {
  const std::pair<Words, int> bad[] = {
      {{"--max-error", "-1"}, 2},
      {{"--max-error", "nan"}, 2},
      {{"--max-p99", "256"}, 2},
      {{"--frames", "0"}, 2},
      {{"--samples", "3"}, 2},
      {{"--env-lobe", "five"}, 2},
      {{"--env-size", "100"}, 2},
      {{"--env-albedo", "exact"}, 2},
      {{"--env-irradiance", "none"}, 2},
      {{"--light-cutoff", "-1"}, 2},
      {{"--texture-filter", "cubic"}, 2},
      {{"--color-texels", "4bit"}, 2},
      {{"--chart", "-", "--results", "-"}, 2},
      {{"--background", "transparent"}, 2},
      {{"-o", "-", "--results", "-"}, 2},
      {{"-o", "/nowhere/s.json"}, 4},
      {{"--eye", "0,0,3", "--target", "0,0,9"}, 3},  // looks away
  };
  for (const auto& [words, status] : bad) {
    Words all = words;
    if (words[0] == "--eye") all.insert(all.end(), {"-o", folder.path("s.json")});
    Words program_words = {"tune", folder.path("a.gltf"), "--size", "32x32"};
    program_words.insert(program_words.end(), all.begin(), all.end());
    const Result result = run(program_words);
    EXPECT_EQ(result.status, status) << words[0] << ' ' << words[1] << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  write_file(folder.path("bad.json"), R"({"tessera-settings": 1, "quality\u001b": "best"})");
  const Result result = program("render", {"-o", folder.path("p.png"), "--settings", folder.path("bad.json")});
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.err.find("unknown setting"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(folder.names(), (Words{"a.gltf", "bad.json"}));
}

}  // namespace
}  // namespace tessera::cli_test

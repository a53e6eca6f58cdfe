// Files of settings: what is written comes back, and nothing wrong is let through.
#include "frame/settings_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.hpp"
#include "src/io/temporary_folder.hpp"

namespace tessera {
namespace {

class SettingsFile : public testing::Test {
 protected:
  std::string write(const std::string& text) const {
    std::ofstream(folder.file("s.json"), std::ios::binary) << text;
    return folder.file("s.json");
  }
  TemporaryFolder folder;
};

TEST_F(SettingsFile, EveryCombinationComesBack) {
  for (const int samples : {1, 2, 4, 8, 16})
    for (std::uint32_t lobe = 0; lobe < 5; ++lobe)
      for (std::uint32_t bits = 0; bits < 4; ++bits) {
        RenderSettings out, in;
        out.samples = samples;
        out.environment_shading = {EnvironmentLobe(lobe), EnvironmentFresnel(bits & 1), bits > 1};
        write_settings(folder.file("s.json"), out, "why, \"quoted\"\n");
        read_settings(folder.file("s.json"), in);
        EXPECT_EQ(in.samples, samples);
        EXPECT_EQ(in.environment_shading.lobe, out.environment_shading.lobe);
        EXPECT_EQ(in.environment_shading.fresnel, out.environment_shading.fresnel);
        EXPECT_EQ(in.environment_shading.specular_occlusion, out.environment_shading.specular_occlusion);
      }
  EXPECT_EQ(folder.count(), 1u);
}

TEST_F(SettingsFile, EveryOtherSettingComesBack) {
  for (int k = 0; k < 24; ++k) {
    RenderSettings out, in;
    out.environment_shading.albedo = EnvironmentAlbedo(k % 3);
    out.environment_size = k == 0 ? 0 : 1 << k % 13;
    out.environment_texels = CubeFormat(k % 2);
    out.environment_irradiance = IrradianceForm(k % 3);
    out.light_cutoff = k == 0 ? 0 : 0.1f / float(k);
    out.texture_filter = TextureFilter(k % 4);
    out.color_texels = ColorTexels(k / 2 % 2);
    write_settings(folder.file("s.json"), out, "");
    read_settings(folder.file("s.json"), in);
    EXPECT_EQ(in.environment_shading.albedo, out.environment_shading.albedo);
    EXPECT_EQ(in.environment_size, out.environment_size);
    EXPECT_EQ(in.environment_texels, out.environment_texels);
    EXPECT_EQ(in.environment_irradiance, out.environment_irradiance);
    EXPECT_EQ(in.light_cutoff, out.light_cutoff);
    EXPECT_EQ(in.texture_filter, out.texture_filter);
    EXPECT_EQ(in.color_texels, out.color_texels);
  }
}

// The words of the file, spelled out: files outlive the program that wrote them.
TEST_F(SettingsFile, WordsMeanWhatTheySay) {
  RenderSettings s;
  read_settings(write(R"({"tessera-settings": 1, "samples": 16, "env-lobe": "shifted", "env-fresnel": "kS",
                         "specular-occlusion": true, "env-albedo": "small-fit", "env-size": 64,
                         "env-texels": "rgb9e5", "env-irradiance": "cube", "light-cutoff": 0.25,
                         "texture-filter": "nearest-mip", "color-texels": "8bit"})"),
                s);
  EXPECT_EQ(s.environment_shading.albedo, EnvironmentAlbedo::small_fit);
  EXPECT_EQ(s.environment_size, 64);
  EXPECT_EQ(s.environment_texels, CubeFormat::rgb9_e5);
  EXPECT_EQ(s.environment_irradiance, IrradianceForm::cube);
  EXPECT_EQ(s.light_cutoff, 0.25f);
  EXPECT_EQ(s.texture_filter, TextureFilter::nearest_mip);
  EXPECT_EQ(s.color_texels, ColorTexels::bytes);
  EXPECT_EQ(s.samples, 16);
  EXPECT_EQ(s.environment_shading.lobe, EnvironmentLobe::shifted);
  EXPECT_EQ(s.environment_shading.fresnel, EnvironmentFresnel::roughness);
  EXPECT_TRUE(s.environment_shading.specular_occlusion);
  const std::pair<const char*, EnvironmentLobe> lobes[] = {{"n=v", EnvironmentLobe::mirror},
                                                           {"taps2", EnvironmentLobe::taps2},
                                                           {"taps4", EnvironmentLobe::taps4},
                                                           {"fis8", EnvironmentLobe::points8}};
  for (const auto& [name, lobe] : lobes) {
    read_settings(write(std::string(R"({"tessera-settings": 1, "env-lobe": ")") + name + "\"}"), s);
    EXPECT_EQ(s.environment_shading.lobe, lobe) << name;
    EXPECT_EQ(s.samples, 16);  // what the file does not name stays
  }
}

TEST_F(SettingsFile, WhatIsWrongGetsOneLineThatNamesIt) {
  const std::string deep(30000, '[');
  const std::pair<std::string, const char*> bad[] = {
      {"", "invalid JSON"},
      {"{", "invalid JSON"},
      {deep, "invalid JSON"},
      {deep + std::string(30000, ']'), "expected a JSON object"},
      {"[1]", "expected a JSON object"},
      {"7", "expected a JSON object"},
      {"{}", "\"tessera-settings\" is missing"},
      {R"({"samples": 4})", "\"tessera-settings\" is missing"},
      {R"({"tessera-settings": 2})", "found 2, expected 1"},
      {R"({"tessera-settings": "1"})", "expected 1"},
      {R"({"tessera-settings": 1, "samples": 3})", "\"samples\": found 3, expected one of 1, 2, 4, 8, 16"},
      {R"({"tessera-settings": 1, "samples": 4.0})", "expected one of 1, 2, 4, 8, 16"},
      {R"({"tessera-settings": 1, "samples": -1})", "expected one of"},
      {R"({"tessera-settings": 1, "samples": 18446744073709551616})", "expected one of"},
      {R"({"tessera-settings": 1, "samples": 4294967300})", "expected one of"},
      {R"({"tessera-settings": 1, "samples": "4"})", "expected one of"},
      {R"({"tessera-settings": 1, "samples": null})", "expected one of"},
      {R"({"tessera-settings": 1, "env-lobe": "taps3"})", "found \"taps3\", expected one of n=v, shifted"},
      {R"({"tessera-settings": 1, "env-lobe": 3})", "expected one of n=v"},
      {R"({"tessera-settings": 1, "env-fresnel": ["f0"]})", "expected one of kS, f0"},
      {R"({"tessera-settings": 1, "specular-occlusion": 1})", "expected true or false"},
      {R"({"tessera-settings": 1, "env-albedo": "exact"})", "expected one of table, fit, small-fit"},
      {R"({"tessera-settings": 1, "env-size": 100})", "found 100, expected a power of two"},
      {R"({"tessera-settings": 1, "env-size": 8192})", "expected a power of two up to 4096"},
      {R"({"tessera-settings": 1, "env-size": -64})", "expected a power of two"},
      {R"({"tessera-settings": 1, "env-size": 18446744073709551615})", "expected a power of two"},
      {R"({"tessera-settings": 1, "env-texels": 0})", "expected one of half, rgb9e5"},
      {R"({"tessera-settings": 1, "env-irradiance": "SH"})", "expected one of auto, sh, cube"},
      {R"({"tessera-settings": 1, "light-cutoff": -0.1})", "expected 0 to 1e6"},
      {R"({"tessera-settings": 1, "light-cutoff": 1e300})", "expected 0 to 1e6"},
      {R"({"tessera-settings": 1, "light-cutoff": "0"})", "expected 0 to 1e6"},
      {R"({"tessera-settings": 1, "texture-filter": true})", "expected one of file, nearest-mip, no-mips, nearest"},
      {R"({"tessera-settings": 1, "color-texels": 8})", "expected one of half, 8bit"},
      {R"({"tessera-settings": 1, "about": {}})", "expected words"},
      {R"({"tessera-settings": 1, "sample": 4})", "unknown setting \"sample\"; expected some of samples"},
      {R"({"tessera-settings": 1, "a\nb\u001b[31m": 4})", "unknown setting"},
      {"{\"tessera-settings\": 1, \"\xff\xfe\": 4}", "invalid JSON"},
      {R"({"tessera-settings": 1, "samples": 1, "samples": 16})", "\"samples\" is there twice"},
      {R"({"tessera-settings": 1} x)", "invalid JSON"},
      {std::string(70000, ' '), "expected at most 65536"},
  };
  for (const auto& [text, reason] : bad) {
    RenderSettings s;
    const std::string path = write(text);
    try {
      read_settings(path, s);
      ADD_FAILURE() << "accepted: " << text.substr(0, 100);
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(error.status(), ExitStatus::input) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message;
      EXPECT_EQ(message.find(path), 0u) << message;
      EXPECT_EQ(message.find_first_of("\n\x1b"), std::string::npos) << message;
      EXPECT_LT(message.size(), path.size() + 320) << message;
    }
  }
  RenderSettings s;
  EXPECT_THROW(read_settings(folder.file("none.json"), s), Error);
}

TEST_F(SettingsFile, AFileThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(write_settings(folder.file("none/s.json"), {}, ""), Error);
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace tessera

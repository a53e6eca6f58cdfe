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

// The words of the file, spelled out: files outlive the program that wrote them.
TEST_F(SettingsFile, WordsMeanWhatTheySay) {
  RenderSettings s;
  read_settings(write(R"({"tessera-settings": 1, "samples": 16, "env-lobe": "shifted", "env-fresnel": "kS",
                         "specular-occlusion": true})"),
                s);
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

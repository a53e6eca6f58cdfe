#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace tessera::cli_test {
namespace {

constexpr const char* lights_and_extensions = R"(,
"extensionsUsed":["KHR_lights_punctual","EXT_nobody_knows_this"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":7,"name":"lamp"}]}})";

TEST(Info, CountsWhatTheFileHolds) {
  const Folder folder;
  write_file(folder.path("a.gltf"), square_gltf(lights_and_extensions));
  const Result result = run({"info", "--json", folder.path("a.gltf")});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("triangles"), 2);
  EXPECT_EQ(json.at("vertices"), 6);  // without normals in the file the faces are flat and share none
  EXPECT_EQ(json.at("meshes"), 1);
  EXPECT_EQ(json.at("generator"), "a test");
  ASSERT_EQ(json.at("materials").size(), 1u);
  EXPECT_EQ(json.at("materials")[0].at("name"), "paint");
  EXPECT_EQ(json.at("materials")[0].at("alpha_mode"), "opaque");
  ASSERT_EQ(json.at("cameras").size(), 1u);
  EXPECT_EQ(json.at("cameras")[0].at("name"), "front");
  EXPECT_EQ(json.at("bounds").at("min"), nlohmann::json({-1.0, -1.0, 0.0}));
  EXPECT_EQ(json.at("bounds").at("max"), nlohmann::json({1.0, 1.0, 0.0}));
  EXPECT_EQ(json.at("extensions_used").size(), 2u);
  EXPECT_EQ(json.at("extensions_unsupported"), nlohmann::json({"EXT_nobody_knows_this"}));
}

TEST(Info, TellsAPersonTheSame) {
  const Folder folder;
  write_file(folder.path("a.gltf"), square_gltf(lights_and_extensions));
  const Result result = run({"info", folder.path("a.gltf")});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* word : {"triangles     2", "paint", "front", "not supported: EXT_nobody_knows_this"})
    EXPECT_NE(result.out.find(word), std::string::npos) << word << " in\n" << result.out;
}

TEST(Info, NamesCannotSteerTheTerminal) {
  const Folder folder;
  std::string text = square_gltf();
  text.replace(text.find("paint"), 5, "\\u001b[31mred");
  write_file(folder.path("a.gltf"), text);
  const Result result = run({"info", folder.path("a.gltf")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("?[31mred"), std::string::npos);
  EXPECT_EQ(result.out.find('\x1b'), std::string::npos);
}

TEST(Info, BadInputIsStatus3AndOneLine) {
  const Folder folder;
  write_file(folder.path("bad.gltf"), "{\"asset\":");
  for (const std::string& path : {folder.path("bad.gltf"), folder.path("missing.glb"), folder.get().string()}) {
    const Result result = run({"info", path});
    EXPECT_EQ(result.status, 3) << path;
    EXPECT_EQ(result.err.rfind("tessera: error: ", 0), 0u) << result.err;
    EXPECT_NE(result.err.find(path), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace tessera::cli_test

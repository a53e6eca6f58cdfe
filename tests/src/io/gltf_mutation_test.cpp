// Thousands of damaged copies of sound files: each loads, or is refused with an Error.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/gltf.hpp"
#include "io/image_file.hpp"
#include "src/io/gltf_builder.hpp"
#include "src/io/temporary_folder.hpp"

namespace tessera {
namespace {

class Random {  // Knuth's linear congruential generator: the same on every machine
 public:
  std::uint64_t below(std::uint64_t limit) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return (state_ >> 33) % limit;
  }

 private:
  std::uint64_t state_ = 2023;
};

// Some of everything.
std::string sample() {
  GltfBuilder b = GltfBuilder::triangle();
  b.primitive()["attributes"].update(
      {{"NORMAL", b.accessor<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, 0}, "VEC4")},
       {"TEXCOORD_0", b.accessor<std::uint16_t>({0, 0, 1, 1, 2, 2}, "VEC2", true)},
       {"JOINTS_0", b.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4")},
       {"WEIGHTS_0", b.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4")}});
  b.root["accessors"][1].update({{"type", "VEC3"}, {"count", 3}});
  b.root["bufferViews"][1]["byteStride"] = 4;
  b.primitive()["indices"] = b.accessor<std::uint16_t>({0, 1, 2, 2, 1, 0}, "SCALAR");
  b.primitive()["targets"] = {{{"POSITION", 0}}};
  b.root["meshes"][0]["weights"] = {0.5};
  const std::uint8_t at = 1;
  const float value[3] = {2, 2, 2};
  b.root["accessors"][0]["sparse"] = {{"count", 1},
                                      {"indices", {{"bufferView", b.view(&at, 1)}, {"componentType", 5121}}},
                                      {"values", {{"bufferView", b.view(value, 12)}}}};
  b.push("nodes", {{"rotation", {0, 0, 0, 1}}});
  b.push("nodes", {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}}, {"camera", 0}});
  b.root["nodes"][0].update({{"children", {1, 2}}, {"skin", 0}, {"scale", {1, -1, 2}}});
  b.push("skins", {{"joints", {1, 2}}});
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  b.push("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}, {"alphaMode", "BLEND"}});
  b.primitive()["material"] = 0;
  b.push("textures", {{"source", 0}, {"sampler", 0}});
  b.push("samplers", {{"wrapS", 33071}});
  const TemporaryFolder folder;
  const unsigned char pixels[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  write_png(folder.file("a.png"), 2, 2, 3, pixels);
  std::ifstream in(folder.file("a.png"), std::ios::binary);
  const std::string png((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  b.push("images", {{"bufferView", b.view(png.data(), png.size())}, {"mimeType", "image/png"}});
  b.root["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "spot"}, {"spot", json::object()}}});
  b.root["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  return b.glb();
}

// Loads; true when accepted.
bool accepted(const std::string& path, const std::string& content) {
  write_file(path, content);
  try {
    const Scene scene = load_gltf(path);
    for (const Triangle& t : scene.triangles)
      for (const std::uint32_t v : t.vertex) EXPECT_LT(v, scene.attributes.size());
    return true;
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), ExitStatus::input);
    EXPECT_TRUE(std::string(e.what()).starts_with(path)) << e.what();
    return false;
  }
}

TEST(GltfMutation, BytesOfABinaryFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.glb");
  const std::string original = sample();
  ASSERT_TRUE(accepted(path, original));
  Random random;
  int good = 0;
  constexpr int rounds = 1500;
  for (int i = 0; i < rounds; ++i) {
    std::string damaged = original;
    for (std::uint64_t k = 0; k <= random.below(3); ++k)
      damaged[random.below(damaged.size())] = char(random.below(256));
    good += accepted(path, damaged) ? 1 : 0;
  }
  EXPECT_GT(good, 100);
  EXPECT_LT(good, rounds - 100);
}

// Digits and structure of the JSON: reaches deeper than flipped bytes, which mostly break the syntax.
TEST(GltfMutation, NumbersOfTheJson) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.glb");
  const std::string original = sample();
  const std::size_t json_end = original.rfind('}') + 1;
  static constexpr const char* values[] = {"-1",   "0",   "1",     "2",    "99", "4294967295", "9007199254740993",
                                           "1e38", "0.5", "\"x\"", "null", "[]", "{}"};
  Random random;
  int good = 0;
  for (int i = 0; i < 1500; ++i) {
    std::string text = original.substr(20, json_end - 20);
    for (std::uint64_t k = 0; k <= random.below(2); ++k) {
      std::size_t at = random.below(text.size());
      at = text.find_first_of("0123456789", at);
      if (at == std::string::npos) continue;
      const std::size_t end = text.find_first_not_of("0123456789.", at);
      text.replace(at, end - at, values[random.below(std::size(values))]);
    }
    const std::string tail = original.substr(20 + std::size_t((json_end - 20 + 3) / 4 * 4));
    while (text.size() % 4 != 0) text += ' ';
    std::string damaged = "glTF" + GltfBuilder::word(2) + GltfBuilder::word(20 + text.size() + tail.size());
    damaged += GltfBuilder::word(text.size()) + "JSON" + text + tail;
    good += accepted(path, damaged) ? 1 : 0;
  }
  EXPECT_GT(good, 50);
}

}  // namespace
}  // namespace tessera

// Files that are wrong: each is refused in one line that names the file and the part.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "io/gltf.hpp"
#include "src/io/gltf_builder.hpp"
#include "src/io/temporary_folder.hpp"

namespace tessera {
namespace {

std::string refusal(const std::string& path) {
  try {
    load_gltf(path);
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), ExitStatus::input);
    std::string message = e.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with(path)) << message;
    return message;
  }
  return "accepted";
}

void expect_refused(const std::string& content, const std::string& reason) {
  const TemporaryFolder folder;
  const std::string message = refusal(write_file(folder.file("bad.gltf"), content));
  EXPECT_NE(message.find(reason), std::string::npos) << "expected '" << reason << "' in: " << message;
}

// One change to a sound file; where the complaint must point.
struct Case {
  const char* reason;
  std::function<void(GltfBuilder&)> damage;
};

const std::vector<Case>& document_cases() {
  using B = GltfBuilder;
  static const std::vector<Case> cases{
      {"asset", [](B& b) { b.root.erase("asset"); }},
      {"asset.version: is '1.0'", [](B& b) { b.root["asset"]["version"] = "1.0"; }},
      {"asset.version: is '3.0'", [](B& b) { b.root["asset"]["version"] = "3.0"; }},
      {"asset.version", [](B& b) { b.root["asset"]["version"] = 2.0; }},
      {"asset.minVersion", [](B& b) { b.root["asset"]["minVersion"] = "2.1"; }},
      {"KHR_not_invented_yet", [](B& b) { b.root["extensionsRequired"] = {"KHR_not_invented_yet"}; }},
      {"KHR_materials_clearcoat", [](B& b) { b.root["extensionsRequired"] = {"KHR_materials_clearcoat"}; }},
      {"extensionsUsed", [](B& b) { b.root["extensionsUsed"] = 7; }},
      {"extensionsRequired",
       [](B& b) {
         b.root["extensionsRequired"] = {1, 2};
       }},
      {"scene: index 4", [](B& b) { b.root["scene"] = 4; }},
      {"scene: index -1", [](B& b) { b.root["scene"] = -1; }},
      {"scene: is \"0\"", [](B& b) { b.root["scene"] = "0"; }},
      {"scenes: is object", [](B& b) { b.root["scenes"] = json::object(); }},
      {"scenes[0].nodes[0]: index 8", [](B& b) { b.root["scenes"][0]["nodes"] = {8}; }},
      {"scenes[0].nodes[1]: repeats 0",
       [](B& b) {
         b.root["scenes"][0]["nodes"] = {0, 0};
       }},
      {"nodes: is \"x\"", [](B& b) { b.root["nodes"] = "x"; }},
      {"nodes[0]: is 5", [](B& b) { b.root["nodes"][0] = 5; }},
      {"nodes[0].mesh: index 3", [](B& b) { b.root["nodes"][0]["mesh"] = 3; }},
      {"nodes[0].mesh: is 0.5", [](B& b) { b.root["nodes"][0]["mesh"] = 0.5; }},
      {"nodes[0].matrix: has 15", [](B& b) { b.root["nodes"][0]["matrix"] = std::vector<int>(15, 1); }},
      {"nodes[0].matrix: is projective", [](B& b) { b.root["nodes"][0]["matrix"] = std::vector<int>(16, 1); }},
      {"nodes[0].rotation",
       [](B& b) {
         b.root["nodes"][0]["rotation"] = {0, 0, 0, 0};
       }},
      {"nodes[0].translation[1]: is null",
       [](B& b) {
         b.root["nodes"][0]["translation"] = {0, nullptr, 0};
       }},
      {"nodes[0].extensions", [](B& b) { b.root["nodes"][0]["extensions"] = 1; }},
      {"range of floats",
       [](B& b) {
         b.root["nodes"][0]["translation"] = {1e300, 0, 0};
       }},
      {"descendants", [](B& b) { b.root["nodes"][0]["children"] = {0}; }},
      {"is no root",
       [](B& b) {
         b.push("nodes", {{"children", {0}}});
         b.root["scenes"][0]["nodes"] = {1, 0};
       }},
      {"is among its own descendants",
       [](B& b) {
         b.root["nodes"][0]["children"] = {1};
         b.push("nodes", {{"children", {0}}});
       }},
      {"is a child of nodes[0] and of nodes[1]",
       [](B& b) {
         b.root["nodes"][0]["children"] = {1, 2};
         b.push("nodes", {{"children", {2}}});
         b.push("nodes", json::object());
       }},
      {"every node is the child",
       [](B& b) {
         b.root.erase("scenes");
         b.root.erase("scene");
         b.root["nodes"][0]["children"] = {0};
       }},
      {"meshes[0]: has no 'primitives'", [](B& b) { b.root["meshes"][0].erase("primitives"); }},
      {"primitives[0]: has no 'attributes'", [](B& b) { b.primitive().erase("attributes"); }},
      {"attributes.POSITION: index 9", [](B& b) { b.primitive()["attributes"]["POSITION"] = 9; }},
      {"attributes.POSITION: index -1", [](B& b) { b.primitive()["attributes"]["POSITION"] = -1; }},
      {"attributes.POSITION: is \"a\"", [](B& b) { b.primitive()["attributes"]["POSITION"] = "a"; }},
      {"mode: is 7", [](B& b) { b.primitive()["mode"] = 7; }},
      {"material: index 0", [](B& b) { b.primitive()["material"] = 0; }},
      {"targets[0].POSITION: index 5",
       [](B& b) {
         b.primitive()["targets"] = {{{"POSITION", 5}}};
       }},
      {"indices: index 3 (number 2)",
       [](B& b) {
         b.primitive()["indices"] = b.accessor<std::uint8_t>({0, 1, 3}, "SCALAR");
       }},
      {"componentType: is 5126, expected 5121",
       [](B& b) {
         b.primitive()["indices"] = b.accessor<float>({0, 1, 2}, "SCALAR");
       }},
      {"componentType: is 5122, expected 5121",
       [](B& b) {
         b.primitive()["indices"] = b.accessor<std::int16_t>({0, 1, 2}, "SCALAR");
       }},
      {"expected SCALAR",
       [](B& b) {
         b.primitive()["indices"] = b.accessor<std::uint8_t>({0, 1, 2}, "VEC3");
       }},
      {"NORMAL: accessors[1] has 2 elements",
       [](B& b) {
         b.primitive()["attributes"]["NORMAL"] = b.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC3");
       }},
      {"accessors[1]: has 2 components",
       [](B& b) {
         b.primitive()["attributes"]["NORMAL"] = b.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
       }},
      {"COLOR_0",
       [](B& b) {
         b.primitive()["attributes"]["COLOR_0"] =
             b.accessor<std::uint8_t>({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC4");
       }},
  };
  return cases;
}

const std::vector<Case>& data_cases() {
  using B = GltfBuilder;
  static const std::vector<Case> cases{
      {"POSITION of vertex 1 is nan",
       [](B& b) {
         const float nan = NAN;
         std::memcpy(&b.buffer[12], &nan, 4);
       }},
      {"POSITION of vertex 0 is -inf",
       [](B& b) {
         const float inf = -INFINITY;
         std::memcpy(b.buffer.data(), &inf, 4);
       }},
      {"accessors[0].componentType: is 5124", [](B& b) { b.root["accessors"][0]["componentType"] = 5124; }},
      {"accessors[0].componentType: is 1", [](B& b) { b.root["accessors"][0]["componentType"] = 1; }},
      {"accessors[0].componentType: is 5125", [](B& b) { b.root["accessors"][0]["componentType"] = 5125; }},
      {"accessors[0].type: is 'VEC9'", [](B& b) { b.root["accessors"][0]["type"] = "VEC9"; }},
      {"accessors[0]: has 16 components",
       [](B& b) {
         b.root["accessors"][0]["type"] = "MAT4";
         b.root["accessors"][0]["componentType"] = 5121;
         b.root["accessors"][0]["count"] = 2;
       }},
      {"accessors[0]: has no 'count'", [](B& b) { b.root["accessors"][0].erase("count"); }},
      {"accessors[0].count: is 0", [](B& b) { b.root["accessors"][0]["count"] = 0; }},
      {"accessors[0].count: is -3", [](B& b) { b.root["accessors"][0]["count"] = -3; }},
      {"accessors[0]: 4 elements", [](B& b) { b.root["accessors"][0]["count"] = 4; }},
      {"accessors[0]: 4000000000 elements", [](B& b) { b.root["accessors"][0]["count"] = 4000000000u; }},
      {"accessors[0].count: is 1e+30", [](B& b) { b.root["accessors"][0]["count"] = 1e30; }},
      {"4000000000 elements without data",
       [](B& b) {
         b.root["accessors"][0]["count"] = 4000000000u;
         b.root["accessors"][0].erase("bufferView");
       }},
      {"accessors[0].byteOffset: is -4", [](B& b) { b.root["accessors"][0]["byteOffset"] = -4; }},
      {"accessors[0]: 3 elements of 12 bytes, stride 12, offset 4",
       [](B& b) { b.root["accessors"][0]["byteOffset"] = 4; }},
      {"offset 9007199254740992", [](B& b) { b.root["accessors"][0]["byteOffset"] = 9007199254740992.0; }},
      {"accessors[0].bufferView: index 1", [](B& b) { b.root["accessors"][0]["bufferView"] = 1; }},
      {"accessors[0].normalized", [](B& b) { b.root["accessors"][0]["normalized"] = "yes"; }},
      {"bufferViews[0].byteStride: is 253", [](B& b) { b.root["bufferViews"][0]["byteStride"] = 253; }},
      {"bufferViews[0].byteStride: is 6", [](B& b) { b.root["bufferViews"][0]["byteStride"] = 6; }},
      {"do not fit the stride of 8", [](B& b) { b.root["bufferViews"][0]["byteStride"] = 8; }},
      {"stride 16", [](B& b) { b.root["bufferViews"][0]["byteStride"] = 16; }},
      {"bufferViews[0].byteLength: is 0", [](B& b) { b.root["bufferViews"][0]["byteLength"] = 0; }},
      {"bufferViews[0]: bytes 0 to 37 are beyond the end", [](B& b) { b.root["bufferViews"][0]["byteLength"] = 37; }},
      {"bufferViews[0]: bytes 36 to 72", [](B& b) { b.root["bufferViews"][0]["byteOffset"] = 36; }},
      {"bufferViews[0].buffer: index 2", [](B& b) { b.root["bufferViews"][0]["buffer"] = 2; }},
      {"buffers[0]: has no URI",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}}};
       }},
      {"buffers[0]: byteLength is 36, only 3",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}, {"uri", "data:;base64,AAAA"}}};
       }},
      {"buffers[0]: data URI has an invalid base64 character at 2",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}, {"uri", "data:;base64,AA!A"}}};
       }},
      {"buffers[0]: data URI's base64 is truncated",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}, {"uri", "data:;base64,AAAAA"}}};
       }},
      {"buffers[0]: data URI without a comma",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}, {"uri", "data:;base64"}}};
       }},
      {"missing.bin: no such file",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}, {"uri", "missing.bin"}}};
       }},
      {"expected a relative path",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}, {"uri", "/etc/passwd"}}};
       }},
      {"expected a relative path",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}, {"uri", "%2Fetc/passwd"}}};
       }},
      {"expected a relative path",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}, {"uri", "https://example.com/a.bin"}}};
       }},
      {"expected a relative path",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}, {"uri", "a%00b"}}};
       }},
      {"is no regular file",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 36}, {"uri", "../../../../../../../dev/zero"}}};
       }},
      {"byteLength: is 1e+30",
       [](B& b) {
         b.root["buffers"] = {{{"byteLength", 1e30}, {"uri", "a"}}};
       }},
      {"sparse.count: is 4",
       [](B& b) {
         b.root["accessors"][0]["sparse"] = {
             {"count", 4}, {"indices", {{"bufferView", 0}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
       }},
      {"sparse.indices: holds 7",
       [](B& b) {
         const std::uint8_t seven = 7;
         b.root["accessors"][0]["sparse"] = {{"count", 1},
                                             {"indices", {{"bufferView", b.view(&seven, 1)}, {"componentType", 5121}}},
                                             {"values", {{"bufferView", 0}}}};
       }},
      {"sparse: has no 'values'",
       [](B& b) {
         b.root["accessors"][0]["sparse"] = {{"count", 1}, {"indices", {{"bufferView", 0}, {"componentType", 5121}}}};
       }},
      {"sparse.indices.componentType",
       [](B& b) {
         b.root["accessors"][0]["sparse"] = {
             {"count", 1}, {"indices", {{"bufferView", 0}, {"componentType", 5122}}}, {"values", {{"bufferView", 0}}}};
       }},
  };
  return cases;
}

const std::vector<Case>& content_cases() {
  using B = GltfBuilder;
  static const auto material = [](B& b) -> json& {
    if (!b.root.contains("materials")) b.primitive()["material"] = b.push("materials", json::object());
    return b.root["materials"][0];
  };
  static const auto light = [](B& b, const json& description) {
    b.root["extensions"]["KHR_lights_punctual"]["lights"] = json::array({description});
    b.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  };
  static const auto camera = [](B& b, const json& description) {
    b.push("cameras", description);
    b.root["nodes"][0]["camera"] = 0;
  };
  static const std::vector<Case> cases{
      {"alphaMode: is 'MILKY'", [](B& b) { material(b)["alphaMode"] = "MILKY"; }},
      {"doubleSided: is \"no\"", [](B& b) { material(b)["doubleSided"] = "no"; }},
      {"baseColorFactor: has 3",
       [](B& b) {
         material(b)["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1};
       }},
      {"normalTexture.index: index 0 is out of range", [](B& b) { material(b)["normalTexture"]["index"] = 0; }},
      {"textures[0]: has no image",
       [](B& b) {
         material(b)["normalTexture"]["index"] =
             b.push("textures", {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
       }},
      {"images[0]: has neither",
       [](B& b) {
         material(b)["normalTexture"]["index"] = b.push("textures", {{"source", b.push("images", json::object())}});
       }},
      {"images[0]",
       [](B& b) {
         material(b)["normalTexture"]["index"] =
             b.push("textures", {{"source", b.push("images", {{"bufferView", 0}})}});
       }},
      {"nowhere.png: no such file",
       [](B& b) {
         material(b)["normalTexture"]["index"] =
             b.push("textures", {{"source", b.push("images", {{"uri", "nowhere.png"}})}});
       }},
      {"samplers[0].wrapS",
       [](B& b) {
         const int image = b.push("images", {{"uri", "x.png"}});
         b.push("samplers", {{"wrapS", 10498}});
         material(b)["normalTexture"]["index"] = b.push("textures", {{"source", image}, {"sampler", 0}});
       }},
      {"light: index 3", [](B& b) { b.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 3; }},
      {"type: is 'laser'",
       [](B& b) {
         light(b, {{"type", "laser"}});
       }},
      {"intensity: is -1",
       [](B& b) {
         light(b, {{"type", "point"}, {"intensity", -1}});
       }},
      {"spot",
       [](B& b) {
         light(b, {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.25}}}});
       }},
      {"spot",
       [](B& b) {
         light(b, {{"type", "spot"}, {"spot", {{"outerConeAngle", 1.6}}}});
       }},
      {"cameras[0]: has no 'type'", [](B& b) { camera(b, json::object()); }},
      {"yfov",
       [](B& b) {
         camera(b, {{"type", "perspective"}, {"perspective", {{"yfov", -1}, {"znear", 1}}}});
       }},
      {"yfov",
       [](B& b) {
         camera(b, {{"type", "perspective"}, {"perspective", {{"yfov", 3.2}, {"znear", 1}}}});
       }},
      {"znear",
       [](B& b) {
         camera(b, {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0}}}});
       }},
      {"zfar",
       [](B& b) {
         camera(b, {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 2}, {"zfar", 1}}}});
       }},
      {"skins[0].joints[0]: index 5",
       [](B& b) {
         b.push("skins", {{"joints", {5}}});
         b.root["nodes"][0]["skin"] = 0;
       }},
      {"names joint 4",
       [](B& b) {
         b.push("skins", {{"joints", {0}}});
         b.root["nodes"][0]["skin"] = 0;
         b.primitive()["attributes"]["JOINTS_0"] =
             b.accessor<std::uint8_t>({4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
         b.primitive()["attributes"]["WEIGHTS_0"] = b.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
       }},
      {"KHR_draco_mesh_compression: cannot be decoded",
       [](B& b) {
         b.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                                      {"attributes", {{"POSITION", 0}}}};
       }},
      {"EXT_meshopt_compression: the compressed data are damaged",
       [](B& b) {
         b.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
             {"buffer", 0}, {"byteLength", 36}, {"byteStride", 12}, {"count", 3}, {"mode", "ATTRIBUTES"}};
       }},
      {"EXT_meshopt_compression: 36 bytes cannot hold",
       [](B& b) {
         b.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
             {"buffer", 0}, {"byteLength", 36}, {"byteStride", 256}, {"count", 4000000000u}, {"mode", "ATTRIBUTES"}};
       }},
  };
  return cases;
}

void run(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.reason);
    GltfBuilder b = GltfBuilder::triangle();
    c.damage(b);
    expect_refused(b.gltf(), c.reason);
  }
}

TEST(GltfBadInput, Documents) { run(document_cases()); }
TEST(GltfBadInput, Data) { run(data_cases()); }
TEST(GltfBadInput, Contents) { run(content_cases()); }

TEST(GltfBadInput, Containers) {
  const std::string glb = GltfBuilder::triangle().glb();
  const auto patched = [&](std::size_t at, const std::string& bytes) {
    std::string copy = glb;
    return copy.replace(at, bytes.size(), bytes);
  };
  using B = GltfBuilder;
  expect_refused("", "is empty");
  expect_refused("glTF", "truncated");
  expect_refused("hello", "not a glTF file");
  expect_refused("[1,2]", "not a glTF file");
  expect_refused("   ", "not a glTF file");
  expect_refused("{", "invalid JSON");
  expect_refused("{\"a\": 1e999}", "invalid JSON");
  expect_refused("{\"a\": \"\xff\"}", "invalid JSON");
  expect_refused("{}", "asset");
  expect_refused("{\"a\":" + std::string(200000, '['), "invalid JSON");
  expect_refused(patched(0, "glTX"), "not a glTF file");
  expect_refused(patched(4, B::word(1)), "container version 1");
  expect_refused(patched(8, B::word(glb.size() + 1)), "truncated");
  expect_refused(patched(8, B::word(13)), "too few");
  expect_refused(patched(12, B::word(0xfffffff0u)), "GLB chunk 0");
  expect_refused(patched(16, "BIN "), "expected JSON");
  for (std::size_t length = 0; length < glb.size(); length += 7) expect_refused(glb.substr(0, length), "");
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder.path()).find("is a directory"), std::string::npos);
  EXPECT_NE(refusal(folder.file("absent.glb")).find("no such file"), std::string::npos);
}

TEST(GltfBadInput, DeepTreesAndMassiveCopies) {
  // A chain of a hundred thousand nodes is fine: nothing recurses.
  GltfBuilder chain = GltfBuilder::triangle();
  json nodes = json::array();
  constexpr int depth = 100000;
  for (int i = 0; i < depth; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", 0}});
  chain.root["nodes"] = nodes;
  const TemporaryFolder folder;
  EXPECT_EQ(load_gltf(write_file(folder.file("deep.gltf"), chain.gltf())).triangles.size(), 1u);
  // A small file that asks for more copies than there is memory.
  GltfBuilder instances = GltfBuilder::triangle();
  instances.push("accessors", {{"componentType", 5126}, {"count", 4000000000u}, {"type", "VEC3"}});
  instances.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 1}};
  expect_refused(instances.gltf(), "accessors[1]");
  // Copies that fit into memory, but not into what a frame can address.
  GltfBuilder copies = GltfBuilder::triangle();
  copies.push("accessors", {{"componentType", 5126}, {"count", 1050000}, {"type", "VEC3"}});
  copies.push("accessors", {{"componentType", 5126}, {"count", 128}, {"type", "VEC3"}});
  copies.root["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 1}}}};
  copies.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 2}};
  expect_refused(copies.gltf(), "134400000 vertices and 44800000 triangles or more, expected at most 134217727");
}

}  // namespace
}  // namespace tessera

// Accessors, primitives, nodes, skins and morph targets: what reaches the scene's arrays.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "io/gltf.hpp"
#include "src/io/gltf_builder.hpp"
#include "src/io/temporary_folder.hpp"

namespace tessera {
namespace {

using Floats = std::vector<float>;

Scene load(const GltfBuilder& builder, GltfReport* report = nullptr) {
  const TemporaryFolder folder;
  return load_gltf(write_file(folder.file("a.glb"), builder.glb()), report);
}

// Positions of the triangles' corners in order: what is drawn, whatever the vertices' order.
std::vector<Floats> corners(const Scene& scene) {
  std::vector<Floats> out;
  for (const Triangle& t : scene.triangles)
    for (const std::uint32_t v : t.vertex) {
      out.push_back({scene.positions[v * 3], scene.positions[v * 3 + 1], scene.positions[v * 3 + 2]});
    }
  return out;
}

const VertexAttributes& corner(const Scene& scene, int k) {
  return scene.attributes[scene.triangles[std::size_t(k / 3)].vertex[k % 3]];
}

Floats normal_of(const Scene& scene, int k) {
  const auto& n = corner(scene, k).normal;
  return {n[0], n[1], n[2]};
}

GltfBuilder square(const json& extra) {  // four corners, mode and indices by extra
  GltfBuilder b;
  const int positions = b.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  json primitive = {{"attributes", {{"POSITION", positions}}}};
  primitive.update(extra);
  b.node({{"mesh", b.mesh(primitive)}});
  return b;
}

TEST(GltfGeometry, ContainersAndUrisGiveTheSameScene) {
  const TemporaryFolder folder;
  const GltfBuilder b = GltfBuilder::triangle();
  std::vector<std::string> files{write_file(folder.file("a.glb"), b.glb()), write_file(folder.file("a.gltf"), b.gltf()),
                                 write_file(folder.file("bom.txt"), "\xef\xbb\xbf" + b.gltf())};
  const std::string binary(b.buffer.begin(), b.buffer.end());
  GltfBuilder external = b;
  // A longer file than the buffer is fine; names are percent-encoded.
  write_file(folder.file("my data.bin"), binary + "tail");
  external.root["buffers"] = {{{"byteLength", binary.size()}, {"uri", "my%20data.bin"}}};
  files.push_back(write_file(folder.file("b.gltf"), external.gltf()));
  for (const std::string& file : files) {
    const Scene scene = load_gltf(file);
    EXPECT_EQ(corners(scene), (std::vector<Floats>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << file;
    EXPECT_EQ(normal_of(scene, 0), (Floats{0, 0, 1})) << file;
    EXPECT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].metallic, 1);
    EXPECT_FALSE(scene.bindings[0].has_tangents);
    EXPECT_FALSE(scene.bindings[0].has_colors);
    EXPECT_EQ(corner(scene, 0).color[3], 1);
  }
}

TEST(GltfGeometry, ListsStripsAndFansWithEveryIndexType) {
  using Corners = std::vector<Floats>;
  const Corners strip{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(corners(load(square({{"mode", 5}}))), strip);
  const Corners fan{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 0}};
  EXPECT_EQ(corners(load(square({{"mode", 6}}))), fan);
  const Corners list{{1, 1, 0}, {0, 1, 0}, {1, 0, 0}};
  GltfBuilder u8 = square({{"mode", 4}});
  u8.primitive()["indices"] = u8.accessor<std::uint8_t>({3, 2, 1}, "SCALAR");
  EXPECT_EQ(corners(load(u8)), list);
  GltfBuilder u16 = square(json::object());
  u16.primitive()["indices"] = u16.accessor<std::uint16_t>({3, 2, 1}, "SCALAR");
  EXPECT_EQ(corners(load(u16)), list);
  GltfBuilder u32 = square(json::object());
  u32.primitive()["indices"] = u32.accessor<std::uint32_t>({3, 2, 1}, "SCALAR");
  EXPECT_EQ(corners(load(u32)), list);
}

TEST(GltfGeometry, OtherModesAreCountedAndNamed) {
  GltfBuilder b = square({{"mode", 0}});
  b.root["meshes"][0]["primitives"].push_back(b.primitive());
  b.root["meshes"][0]["primitives"].push_back(b.primitive());
  b.root["meshes"][0]["primitives"][1]["mode"] = 3;
  b.root["meshes"][0]["primitives"][2]["mode"] = 5;
  GltfReport report;
  EXPECT_EQ(load(b, &report).triangles.size(), 2u);
  EXPECT_EQ(report.skipped_primitives, 2u);
  EXPECT_EQ(report.primitives, 3u);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0], "2 primitives left out, which make no triangles: 1 POINTS, 1 LINE_STRIP");
}

TEST(GltfGeometry, InterleavedAttributes) {
  GltfBuilder b;
  struct Vertex {
    float position[3], normal[3];
    std::uint16_t uv[2];
    std::uint8_t color[4];
  };
  const Vertex vertices[3] = {{{0, 0, 0}, {0, 0, 2}, {0, 0}, {255, 0, 51, 255}},
                              {{1, 0, 0}, {0, 0, 2}, {65535, 0}, {0, 255, 0, 102}},
                              {{0, 1, 0}, {0, 3, 4}, {0, 13107}, {0, 0, 0, 0}}};
  const int view = b.view(vertices, sizeof(vertices), sizeof(Vertex));
  const auto add = [&](int offset, int type, const char* shape, bool normalized) {
    return b.push("accessors", {{"bufferView", view},
                                {"byteOffset", offset},
                                {"componentType", type},
                                {"count", 3},
                                {"type", shape},
                                {"normalized", normalized}});
  };
  const json attributes = {{"POSITION", add(0, 5126, "VEC3", false)},
                           {"NORMAL", add(12, 5126, "VEC3", false)},
                           {"TEXCOORD_1", add(24, 5123, "VEC2", true)},
                           {"COLOR_0", add(28, 5121, "VEC4", true)}};
  b.node({{"mesh", b.mesh({{"attributes", attributes}})}});
  const Scene scene = load(b);
  EXPECT_EQ(corners(scene)[2], (Floats{0, 1, 0}));
  EXPECT_EQ(normal_of(scene, 0), (Floats{0, 0, 1}));
  EXPECT_EQ(normal_of(scene, 2), (Floats{0, 0.6f, 0.8f}));
  EXPECT_EQ(corner(scene, 1).uv[1][0], 1);
  EXPECT_EQ(corner(scene, 2).uv[1][1], 0.2f);
  EXPECT_EQ(corner(scene, 0).uv[0][0], 0);
  EXPECT_EQ(corner(scene, 0).color[2], 0.2f);
  EXPECT_EQ(corner(scene, 1).color[3], 0.4f);
  EXPECT_TRUE(scene.bindings[0].has_colors);
}

TEST(GltfGeometry, NormalisedAndPlainIntegers) {
  GltfBuilder b;
  const json attributes = {{"POSITION", b.accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 0, -32768, 0}, "VEC3", true)},
                           {"NORMAL", b.accessor<std::int8_t>({0, 0, 127, 0, 0, 127, 127, 0, 0}, "VEC3", true)},
                           {"TEXCOORD_0", b.accessor<std::uint8_t>({0, 0, 3, 0, 0, 7}, "VEC2")}};
  // Three bytes or three shorts are padded to four.
  b.root["accessors"] = json::array();
  const std::int16_t positions[12] = {0, 0, 0, 9, 32767, 0, 0, 9, 0, -32768, 0, 9};
  const std::int8_t normals[12] = {0, 0, 127, 9, 0, 0, 127, 9, 127, 0, 0, 9};
  const std::uint8_t uvs[12] = {0, 0, 9, 9, 3, 0, 9, 9, 0, 7, 9, 9};
  b.push("accessors", {{"bufferView", b.view(positions, 24, 8)},
                       {"componentType", 5122},
                       {"count", 3},
                       {"type", "VEC3"},
                       {"normalized", true}});
  b.push("accessors", {{"bufferView", b.view(normals, 12, 4)},
                       {"componentType", 5120},
                       {"count", 3},
                       {"type", "VEC3"},
                       {"normalized", true}});
  b.push("accessors", {{"bufferView", b.view(uvs, 12, 4)}, {"componentType", 5121}, {"count", 3}, {"type", "VEC2"}});
  b.root["extensionsRequired"] = b.root["extensionsUsed"] = {"KHR_mesh_quantization"};
  b.node({{"mesh", b.mesh({{"attributes", attributes}})}});
  const Scene scene = load(b);
  EXPECT_EQ(corners(scene), (std::vector<Floats>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
  EXPECT_EQ(normal_of(scene, 2), (Floats{1, 0, 0}));
  EXPECT_EQ(corner(scene, 1).uv[0][0], 3);
  EXPECT_EQ(corner(scene, 2).uv[0][1], 7);
}

TEST(GltfGeometry, SparseAccessorsWithAndWithoutABase) {
  GltfBuilder b = GltfBuilder::triangle();
  const std::uint8_t indices[2] = {1, 2};
  const float values[6] = {5, 0, 0, 0, 6, 0};
  b.root["accessors"][0]["sparse"] = {{"count", 2},
                                      {"indices", {{"bufferView", b.view(indices, 2)}, {"componentType", 5121}}},
                                      {"values", {{"bufferView", b.view(values, 24)}}}};
  EXPECT_EQ(corners(load(b)), (std::vector<Floats>{{0, 0, 0}, {5, 0, 0}, {0, 6, 0}}));
  b.root["accessors"][0].erase("bufferView");
  EXPECT_EQ(corners(load(b)), (std::vector<Floats>{{0, 0, 0}, {5, 0, 0}, {0, 6, 0}}));
  // Sparse indices of triangles, too, which tinygltf would refuse.
  GltfBuilder c = square(json::object());
  const std::uint16_t at[3] = {0, 1, 2};
  const std::uint8_t corner_indices[3] = {1, 3, 2};
  c.primitive()["indices"] =
      c.push("accessors", {{"componentType", 5121},
                           {"count", 3},
                           {"type", "SCALAR"},
                           {"sparse",
                            {{"count", 3},
                             {"indices", {{"bufferView", c.view(at, 6)}, {"componentType", 5123}}},
                             {"values", {{"bufferView", c.view(corner_indices, 3)}}}}}});
  EXPECT_EQ(corners(load(c)), (std::vector<Floats>{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
}

TEST(GltfGeometry, NodesMultiplyTranslationRotationScaleAndMatrix) {
  GltfBuilder b = GltfBuilder::triangle();
  const double s = std::sqrt(0.5);
  b.root["nodes"][0].update({{"translation", {10, 0, 0}}, {"rotation", {0, 0, s, s}}, {"scale", {2, 3, 4}}});
  Scene scene = load(b);
  EXPECT_NEAR(corners(scene)[1][0], 10, 1e-6);  // x turns into y
  EXPECT_NEAR(corners(scene)[1][1], 2, 1e-6);
  EXPECT_NEAR(corners(scene)[2][0], 7, 1e-6);
  const int parent = b.push("nodes", {{"children", {0}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}});
  b.root["scenes"][0]["nodes"] = {parent};
  scene = load(b);
  EXPECT_NEAR(corners(scene)[1][1], 2, 1e-6);
  EXPECT_EQ(corners(scene)[1][2], 5);
  // A quaternion of another length means the same rotation.
  b.root["nodes"][0]["rotation"] = {0, 0, 7, 7};
  EXPECT_NEAR(corners(load(b))[1][1], 2, 1e-6);
}

TEST(GltfGeometry, UnevenScaleTurnsNormalsByTheInverseTranspose) {
  GltfBuilder b = GltfBuilder::triangle();
  b.primitive()["attributes"]["NORMAL"] = b.accessor<float>({1, 1, 0, 1, 1, 0, 1, 1, 0}, "VEC3");
  b.root["nodes"][0]["scale"] = {2, 1, 1};
  const Floats n = normal_of(load(b), 0);
  EXPECT_NEAR(n[0], 0.5 / std::sqrt(1.25), 1e-6);
  EXPECT_NEAR(n[1], 1 / std::sqrt(1.25), 1e-6);
}

TEST(GltfGeometry, NegativeScaleTurnsTheWindingAndTheBitangent) {
  GltfBuilder b = GltfBuilder::triangle();
  b.primitive()["attributes"]["NORMAL"] = b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  b.primitive()["attributes"]["TANGENT"] = b.accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}, "VEC4");
  b.root["nodes"][0]["scale"] = {-1, 1, 1};
  const Scene scene = load(b);
  EXPECT_EQ(corners(scene),
            (std::vector<Floats>{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}));  // still counter-clockwise from +Z
  EXPECT_EQ(normal_of(scene, 0), (Floats{0, 0, 1}));
  EXPECT_TRUE(scene.bindings[0].has_tangents);
  EXPECT_EQ(corner(scene, 0).tangent[0], -1);
  EXPECT_EQ(corner(scene, 0).tangent[3], -1);
  EXPECT_EQ(corner(scene, 1).tangent[3], 1);  // the vertex that had -1
  // Without normals the face decides, and tangents are ignored.
  b.primitive()["attributes"].erase("NORMAL");
  const Scene flat = load(b);
  EXPECT_EQ(normal_of(flat, 0), (Floats{0, 0, 1}));
  EXPECT_FALSE(flat.bindings[0].has_tangents);
}

TEST(GltfGeometry, MissingNormalsAreFlatAndSplitVertices) {
  GltfBuilder b;
  const int positions = b.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
  const int indices = b.accessor<std::uint8_t>({0, 1, 2, 0, 3, 1}, "SCALAR");
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
  const Scene scene = load(b);
  ASSERT_EQ(scene.attributes.size(), 6u);
  EXPECT_EQ(normal_of(scene, 0), (Floats{0, 0, 1}));
  EXPECT_EQ(normal_of(scene, 3), (Floats{0, 1, 0}));
}

TEST(GltfGeometry, OnlyUsedVerticesAreKeptAndBrokenNormalsMended) {
  GltfBuilder b;
  const int positions = b.accessor<float>({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int normals = b.accessor<float>({0, 0, 1, 0, 0, 0, NAN, 0, 0, 0, 1, 0}, "VEC3");
  const int indices = b.accessor<std::uint8_t>({1, 2, 3}, "SCALAR");
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}})}});
  GltfReport report;
  const Scene scene = load(b, &report);
  EXPECT_EQ(scene.attributes.size(), 3u);
  EXPECT_EQ(normal_of(scene, 0), (Floats{0, 0, 1}));
  EXPECT_EQ(normal_of(scene, 1), (Floats{0, 0, 1}));
  EXPECT_EQ(normal_of(scene, 2), (Floats{0, 1, 0}));
  EXPECT_EQ(report.warnings.size(), 1u);
}

TEST(GltfGeometry, MorphTargetsAtTheirDefaultWeights) {
  GltfBuilder b = GltfBuilder::triangle();
  const int a = b.accessor<float>({0, 0, 0, 4, 0, 0, 0, 0, 0}, "VEC3");
  const int c = b.accessor<float>({0, 0, 0, 0, 0, 0, 0, 0, 8}, "VEC3");
  b.primitive()["targets"] = {{{"POSITION", a}}, {{"POSITION", c}}};
  EXPECT_EQ(corners(load(b))[1], (Floats{1, 0, 0}));  // no weights: zero
  b.root["meshes"][0]["weights"] = {0.5, 0};
  EXPECT_EQ(corners(load(b))[1], (Floats{3, 0, 0}));
  b.root["nodes"][0]["weights"] = {0, 0.25};  // the node's weights replace the mesh's
  EXPECT_EQ(corners(load(b)), (std::vector<Floats>{{0, 0, 0}, {1, 0, 0}, {0, 1, 2}}));
}

TEST(GltfGeometry, SkinsAtRestIgnoreTheirOwnNode) {
  GltfBuilder b = GltfBuilder::triangle();
  b.primitive()["attributes"]["JOINTS_0"] = b.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
  b.primitive()["attributes"]["WEIGHTS_0"] = b.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4");
  const int joint0 = b.node({{"translation", {0, 0, 1}}});
  const int joint1 = b.push("nodes", {{"translation", {2, 0, 0}}});
  b.push("nodes", {{"children", {joint1}}, {"translation", {0, 4, 0}}});                   // no scene lists this tree
  const int inverse = b.accessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,  //
                                         1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
                                        "MAT4");
  b.push("skins", {{"joints", {joint0, joint1}}, {"inverseBindMatrices", inverse}});
  b.root["nodes"][0].update({{"skin", 0}, {"translation", {100, 100, 100}}});
  // Joint 0 moves by (0,0,1), joint 1 by (2,4,0) - (1,0,0).
  EXPECT_EQ(corners(load(b)), (std::vector<Floats>{{0, 0, 1}, {2, 4, 0}, {0.5f, 3, 0.5f}}));
  b.root["skins"][0].erase("inverseBindMatrices");
  EXPECT_EQ(corners(load(b))[1], (Floats{3, 4, 0}));
}

TEST(GltfGeometry, InstancesAreCopies) {
  GltfBuilder b = GltfBuilder::triangle();
  const int translation = b.accessor<float>({0, 0, 0, 0, 0, 5}, "VEC3");
  const int scale = b.accessor<float>({1, 1, 1, -2, 2, 2}, "VEC3");
  b.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", translation},
                                                                               {"SCALE", scale}};
  const Scene scene = load(b);
  ASSERT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.parts.size(), 1u);
  EXPECT_EQ(corners(scene)[5], (Floats{-2, 0, 5}));
  EXPECT_EQ(normal_of(scene, 3), (Floats{0, 0, 1}));
}

TEST(GltfGeometry, ScenesAreChosen) {
  GltfBuilder b = GltfBuilder::triangle();
  const int positions = b.accessor<float>({0, 0, 7, 1, 0, 7, 0, 1, 7}, "VEC3");
  b.push("nodes", {{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
  b.root["scenes"].push_back({{"nodes", {1}}, {"name", "second"}});
  EXPECT_EQ(corners(load(b))[0][2], 0);
  b.root["scene"] = 1;
  GltfReport report;
  EXPECT_EQ(corners(load(b, &report))[0][2], 7);
  EXPECT_EQ(report.default_scene, "second");
  b.root.erase("scene");
  EXPECT_EQ(load(b).triangles.size(), 1u);
  b.root.erase("scenes");  // no scenes: every root node
  EXPECT_EQ(load(b).triangles.size(), 2u);
}

TEST(GltfGeometry, WhatNobodyReachesMayBeBroken) {
  GltfBuilder b = GltfBuilder::triangle();
  b.push("accessors", {{"componentType", "nonsense"}, {"bufferView", 99}});
  b.push("meshes", {{"primitives", 5}});
  b.push("nodes", {{"mesh", 77}, {"children", {1}}});
  b.push("materials", "no object");
  b.push("images", {{"uri", "not-there.png"}});
  b.push("textures", {{"source", 0}});
  b.push("skins", 3);
  b.root["animations"] = "none";
  b.root["extras"] = json::array({1, {{"a", nullptr}}});
  EXPECT_EQ(load(b).triangles.size(), 1u);
}

}  // namespace
}  // namespace tessera

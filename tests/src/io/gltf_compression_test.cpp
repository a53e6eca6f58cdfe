// EXT_meshopt_compression and KHR_draco_mesh_compression, on data that their own libraries encode here.
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "io/gltf.hpp"
#include "src/io/gltf_builder.hpp"
#include "src/io/temporary_folder.hpp"

namespace tessera {
namespace {

Scene load(const GltfBuilder& builder) {
  const TemporaryFolder folder;
  return load_gltf(write_file(folder.file("a.glb"), builder.glb()));
}

// A strip of squares along x.
struct Grid {
  std::vector<float> positions;
  std::vector<unsigned> indices;
  explicit Grid(unsigned squares) {
    for (unsigned i = 0; i <= squares; ++i)
      for (unsigned j = 0; j < 2; ++j) positions.insert(positions.end(), {float(i) * 0.5f, float(j), float(i % 3)});
    for (unsigned i = 0; i < squares; ++i) {
      const unsigned a = 2 * i;
      for (const unsigned k : {0u, 2u, 1u, 1u, 2u, 3u}) indices.push_back(a + k);
    }
  }
  [[nodiscard]] std::size_t vertices() const { return positions.size() / 3; }
};

void expect_same_triangles(const Scene& scene, const Grid& grid) {
  ASSERT_EQ(scene.triangles.size() * 3, grid.indices.size());
  for (std::size_t i = 0; i < grid.indices.size(); ++i) {
    const float* got = &scene.positions[std::size_t(scene.triangles[i / 3].vertex[i % 3]) * 3];
    for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(got[c], grid.positions[grid.indices[i] * 3 + c]) << i;
  }
}

// Makes a view of the builder compressed: its own buffer has no bytes.
int compressed_view(GltfBuilder& b, const std::vector<unsigned char>& code, std::size_t count, std::size_t stride,
                    const char* mode, const char* filter = nullptr) {
  const int view = b.view(code.data(), code.size());
  json extension = b.root["bufferViews"][std::size_t(view)];
  extension.update({{"byteStride", stride}, {"count", count}, {"mode", mode}});
  if (filter != nullptr) extension["filter"] = filter;
  json& target = b.root["bufferViews"][std::size_t(view)];
  target = {{"buffer", 1}, {"byteLength", count * stride}};
  target["extensions"]["EXT_meshopt_compression"] = extension;
  return view;
}

std::vector<unsigned char> encode_vertices(const void* data, std::size_t count, std::size_t stride) {
  std::vector<unsigned char> code(meshopt_encodeVertexBufferBound(count, stride));
  code.resize(meshopt_encodeVertexBuffer(code.data(), code.size(), data, count, stride));
  return code;
}

GltfBuilder finish(GltfBuilder b, const json& primitive) {
  b.node({{"mesh", b.mesh(primitive)}});
  b.root["extensionsUsed"] = b.root["extensionsRequired"] = {"EXT_meshopt_compression"};
  b.root["buffers"] = {{{"byteLength", b.buffer.size()}}, {{"byteLength", 1 << 20}}};
  return b;
}

TEST(GltfMeshopt, VerticesAndBothIndexCodecs) {
  Grid grid(40);
  for (const bool sequence : {false, true}) {
    GltfBuilder b;
    const int positions = compressed_view(b, encode_vertices(grid.positions.data(), grid.vertices(), 12),
                                          grid.vertices(), 12, "ATTRIBUTES");
    std::vector<unsigned char> code(std::max(meshopt_encodeIndexBufferBound(grid.indices.size(), grid.vertices()),
                                             meshopt_encodeIndexSequenceBound(grid.indices.size(), grid.vertices())));
    code.resize(sequence
                    ? meshopt_encodeIndexSequence(code.data(), code.size(), grid.indices.data(), grid.indices.size())
                    : meshopt_encodeIndexBuffer(code.data(), code.size(), grid.indices.data(), grid.indices.size()));
    const int indices = compressed_view(b, code, grid.indices.size(), 2, sequence ? "INDICES" : "TRIANGLES");
    b.push("accessors",
           {{"bufferView", positions}, {"componentType", 5126}, {"count", grid.vertices()}, {"type", "VEC3"}});
    b.push("accessors",
           {{"bufferView", indices}, {"componentType", 5123}, {"count", grid.indices.size()}, {"type", "SCALAR"}});
    const Scene scene = load(finish(b, {{"attributes", {{"POSITION", 0}}}, {"indices", 1}}));
    ASSERT_EQ(scene.triangles.size() * 3, grid.indices.size());
    if (sequence) {
      expect_same_triangles(scene, grid);
    } else {
      EXPECT_EQ(bounds_of(scene).max[0], 20);  // the triangle codec may rotate corners
    }
  }
}

TEST(GltfMeshopt, FiltersGiveWhatTheLibraryGives) {
  constexpr std::size_t count = 64;
  std::vector<float> directions(count * 4);
  for (std::size_t i = 0; i < count; ++i) {
    const double a = double(i) * 0.7;
    const double z = 1 - 2 * (double(i) + 0.5) / double(count);
    const double r = std::sqrt(1 - z * z);
    const double v[4] = {r * std::cos(a), r * std::sin(a), z, 1};
    for (std::size_t c = 0; c < 4; ++c) directions[i * 4 + c] = float(v[c]);
  }
  for (const std::size_t stride : {std::size_t{4}, std::size_t{8}}) {
    std::vector<unsigned char> filtered(count * stride);
    meshopt_encodeFilterOct(filtered.data(), count, stride, stride == 4 ? 8 : 12, directions.data());
    std::vector<float> positions(count * 3);
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = float(i % 7) + float(i) * 0.01f;
    std::vector<std::uint32_t> exponential(count * 3);
    meshopt_encodeFilterExp(exponential.data(), count, 12, 15, positions.data());
    GltfBuilder b;
    const int p =
        compressed_view(b, encode_vertices(exponential.data(), count, 12), count, 12, "ATTRIBUTES", "EXPONENTIAL");
    const int n =
        compressed_view(b, encode_vertices(filtered.data(), count, stride), count, stride, "ATTRIBUTES", "OCTAHEDRAL");
    b.push("accessors", {{"bufferView", p}, {"componentType", 5126}, {"count", count}, {"type", "VEC3"}});
    b.push("accessors", {{"bufferView", n},
                         {"componentType", stride == 4 ? 5120 : 5122},
                         {"count", count},
                         {"type", "VEC3"},
                         {"normalized", true}});
    const Scene scene = load(finish(b, {{"mode", 5}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}));
    meshopt_decodeFilterExp(exponential.data(), count, 12);
    const auto* expected = reinterpret_cast<const float*>(exponential.data());
    ASSERT_EQ(scene.attributes.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      // A strip first uses vertices 0 1 2, then 3 4 ...: in order.
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(scene.positions[i * 3 + c], expected[i * 3 + c]);
        EXPECT_NEAR(double(scene.attributes[i].normal[c]), double(directions[i * 4 + c]), stride == 4 ? 0.02 : 0.002);
      }
    }
  }
}

TEST(GltfMeshopt, QuaternionsOfInstances) {
  const std::size_t count = 4;
  const float s = std::sqrt(0.5f);
  const std::vector<float> rotations{0, 0, 0, 1, 0, 0, s, s, 1, 0, 0, 0, 0, -s, 0, s};
  std::vector<std::int16_t> filtered(count * 4);
  meshopt_encodeFilterQuat(filtered.data(), count, 8, 16, rotations.data());
  GltfBuilder b;
  const int positions = b.triangle_positions();
  const int view = compressed_view(b, encode_vertices(filtered.data(), count, 8), count, 8, "ATTRIBUTES", "QUATERNION");
  const int rotation =
      b.push("accessors",
             {{"bufferView", view}, {"componentType", 5122}, {"count", count}, {"type", "VEC4"}, {"normalized", true}});
  b = finish(b, {{"attributes", {{"POSITION", positions}}}});
  b.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"ROTATION", rotation}};
  const Scene scene = load(b);
  ASSERT_EQ(scene.triangles.size(), 4u);
  const auto second_corner = [&](int k) {
    return &scene.positions[std::size_t(scene.triangles[std::size_t(k)].vertex[1]) * 3];
  };
  EXPECT_NEAR(second_corner(0)[0], 1, 1e-3);
  EXPECT_NEAR(second_corner(1)[1], 1, 1e-3);  // a quarter about z
  EXPECT_NEAR(second_corner(2)[0], 1, 1e-3);  // a half about x
  EXPECT_NEAR(second_corner(3)[2], 1, 1e-3);  // a quarter about -y
}

std::vector<char> draco_code(const Grid& grid, bool sequential) {
  draco::Mesh mesh;
  mesh.set_num_points(std::uint32_t(grid.vertices()));
  draco::GeometryAttribute geometry;
  geometry.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int position = mesh.AddAttribute(geometry, true, std::uint32_t(grid.vertices()));
  geometry.Init(draco::GeometryAttribute::COLOR, nullptr, 4, draco::DT_UINT8, true, 4, 0);
  const int color = mesh.AddAttribute(geometry, true, std::uint32_t(grid.vertices()));
  for (std::uint32_t i = 0; i < grid.vertices(); ++i) {
    mesh.attribute(position)->SetAttributeValue(draco::AttributeValueIndex(i), &grid.positions[i * 3]);
    const std::uint8_t rgba[4] = {255, std::uint8_t(i), 0, 51};
    mesh.attribute(color)->SetAttributeValue(draco::AttributeValueIndex(i), rgba);
  }
  for (std::size_t i = 0; i < grid.indices.size(); i += 3) {
    mesh.AddFace({draco::PointIndex(grid.indices[i]), draco::PointIndex(grid.indices[i + 1]),
                  draco::PointIndex(grid.indices[i + 2])});
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(sequential ? draco::MESH_SEQUENTIAL_ENCODING : draco::MESH_EDGEBREAKER_ENCODING);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return {buffer.data(), buffer.data() + buffer.size()};
}

GltfBuilder draco_file(const Grid& grid, const std::vector<char>& code) {
  GltfBuilder b;
  const int view = b.view(code.data(), code.size());
  b.push("accessors", {{"componentType", 5126}, {"count", grid.vertices()}, {"type", "VEC3"}});
  b.push("accessors", {{"componentType", 5121}, {"count", grid.vertices()}, {"type", "VEC4"}, {"normalized", true}});
  b.push("accessors", {{"componentType", 5125}, {"count", grid.indices.size()}, {"type", "SCALAR"}});
  json primitive = {{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}}, {"indices", 2}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                           {"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}}};
  b.node({{"mesh", b.mesh(primitive)}});
  b.root["extensionsUsed"] = b.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return b;
}

TEST(GltfDraco, SequentialAndEdgebreaker) {
  const Grid grid(20);
  const Scene sequential = load(draco_file(grid, draco_code(grid, true)));
  expect_same_triangles(sequential, grid);
  EXPECT_TRUE(sequential.bindings[0].has_colors);
  EXPECT_EQ(sequential.attributes[0].color[3], 0.2f);
  EXPECT_EQ(sequential.attributes[0].color[0], 1);
  const Scene edgebreaker = load(draco_file(grid, draco_code(grid, false)));
  EXPECT_EQ(edgebreaker.triangles.size() * 3, grid.indices.size());
  EXPECT_EQ(bounds_of(edgebreaker).max[0], 10);
}

// Damaged codes: a scene or an Error, nothing else.
TEST(GltfDraco, DamagedCodesNeverCrash) {
  const Grid grid(12);
  std::uint64_t state = 7;
  const auto next = [&state](std::uint64_t limit) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (state >> 33) % limit;
  };
  int refused = 0;
  for (const bool sequential : {true, false}) {
    const std::vector<char> code = draco_code(grid, sequential);
    for (int i = 0; i < 300; ++i) {
      std::vector<char> damaged = code;
      damaged[next(damaged.size())] = char(next(256));
      if (i % 3 == 0) damaged.resize(1 + next(damaged.size()));
      try {
        load(draco_file(grid, damaged));
      } catch (const Error& e) {
        EXPECT_EQ(e.status(), ExitStatus::input);
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(GltfMeshopt, DamagedCodesNeverCrash) {
  const Grid grid(12);
  const auto code = encode_vertices(grid.positions.data(), grid.vertices(), 12);
  for (std::size_t i = 0; i < code.size() * 2; ++i) {
    std::vector<unsigned char> damaged = code;
    if (i < code.size()) {
      damaged[i] = static_cast<unsigned char>(~damaged[i]);
    } else {
      damaged.resize(1 + i - code.size());
    }
    GltfBuilder b;
    const int view = compressed_view(b, damaged, grid.vertices(), 12, "ATTRIBUTES");
    b.push("accessors", {{"bufferView", view}, {"componentType", 5126}, {"count", grid.vertices()}, {"type", "VEC3"}});
    try {
      load(finish(b, {{"mode", 5}, {"attributes", {{"POSITION", 0}}}}));
    } catch (const Error& e) {
      EXPECT_EQ(e.status(), ExitStatus::input);
    }
  }
}

}  // namespace
}  // namespace tessera

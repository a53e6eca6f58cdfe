// Other people's models, where they are installed: every one loads, or is refused in one line.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/error.hpp"
#include "io/gltf.hpp"
#include "src/io/shared_assets.hpp"

namespace tessera {
namespace {

namespace fs = std::filesystem;
const fs::path assimp = "/usr/share/assimp/models/glTF2";

std::vector<fs::path> models_under(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path extension = entry.path().extension();
    if (extension == ".gltf" || extension == ".glb") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string refusal(const fs::path& path) {
  try {
    load_gltf(path.string());
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), ExitStatus::input);
    std::string message = e.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with(path.string())) << message;
    return message;
  }
  return {};
}

// What the kernels rely on.
void expect_sound(const Scene& scene, const std::string& name) {
  ASSERT_EQ(scene.positions.size(), scene.attributes.size() * 3) << name;
  for (const Triangle& t : scene.triangles) {
    for (const std::uint32_t v : t.vertex) ASSERT_LT(v, scene.attributes.size()) << name;
    ASSERT_LT(t.binding, scene.bindings.size()) << name;
  }
  for (const MaterialBinding& b : scene.bindings) ASSERT_LT(std::size_t(b.material), scene.materials.size()) << name;
  for (const VertexAttributes& a : scene.attributes) {
    const double length =
        double(a.normal[0]) * a.normal[0] + double(a.normal[1]) * a.normal[1] + double(a.normal[2]) * a.normal[2];
    ASSERT_NEAR(length, 1, 1e-5) << name;
  }
  std::uint32_t next = 0;
  for (const Part& part : scene.parts) {
    EXPECT_EQ(part.first_triangle, next) << name;
    next += part.triangle_count;
  }
  EXPECT_EQ(next, scene.triangles.size()) << name;
  for (const Texture& t : scene.textures) {
    ASSERT_LT(std::size_t(t.image), scene.images.size()) << name;
    const SourceImage& image = scene.images[std::size_t(t.image)];
    const std::size_t channel = image.type == PixelType::u8 ? 1 : image.type == PixelType::f32 ? 4 : 2;
    ASSERT_GT(image.width, 0) << name;
    EXPECT_EQ(image.pixels.size(), std::size_t(image.width) * image.height * image.channels * channel) << name;
  }
}

TEST(GltfModels, EverySharedModelLoads) {
  if (!fs::exists(shared_assets())) GTEST_SKIP() << "no shared assets here";
  for (const fs::path& path : models_under(shared_assets())) {
    expect_sound(load_gltf(path.string()), path.string());
  }
}

TEST(GltfModels, InstalledModelsLoadOrAreRefusedWithTheReason) {
  if (!fs::exists(assimp)) GTEST_SKIP() << "assimp-testmodels is not installed";
  for (const fs::path& path : models_under(assimp)) {
    if (refusal(path).empty()) expect_sound(load_gltf(path.string()), path.string());
  }
  const std::pair<const char*, const char*> broken[] = {
      {"IndexOutOfRange/IndexOutOfRange.gltf", "meshes[0].primitives[0].indices"},
      {"RecursiveNodes/RecursiveNodes.gltf", "nodes[0]"},
      {"MissingBin/BoxTextured.gltf", "BoxTextured0.bin"},
      {"SchemaFailures/sceneWrongType.gltf", "scene"},
      {"wrongTypes/badArray.gltf", "meshes[0].primitives"},
      {"wrongTypes/badExtension.gltf", "KHR_texture_transform"},
      {"wrongTypes/badNumber.gltf", "normalTexture"},
      {"wrongTypes/badObject.gltf", "pbrMetallicRoughness"},
      {"wrongTypes/badString.gltf", "name"},
      {"wrongTypes/badUint.gltf", "index"},
      {"BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "POSITION"},
      {"BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf", "KHR_technique_webgl"},
  };
  for (const auto& [name, part] : broken) EXPECT_NE(refusal(assimp / name).find(part), std::string::npos) << name;
}

TEST(GltfModels, DracoGivesTheSameEngine) {
  if (!fs::exists(assimp)) GTEST_SKIP() << "assimp-testmodels is not installed";
  const Scene plain = load_gltf((assimp / "2CylinderEngine-glTF-Binary/2CylinderEngine.glb").string());
  const Scene draco = load_gltf((assimp / "draco/2CylinderEngine.gltf").string());
  EXPECT_EQ(plain.triangles.size(), 121496u);
  EXPECT_EQ(draco.triangles.size(), 110336u);  // the encoder dropped triangles without an area; the accessors agree
  EXPECT_NEAR(bounds_of(draco).radius / bounds_of(plain).radius, 1, 1e-3);
  ASSERT_EQ(plain.cameras.size(), 1u);
}

}  // namespace
}  // namespace tessera

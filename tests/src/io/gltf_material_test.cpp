// Materials, textures, images, lights and cameras of glTF files.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "io/file_bytes.hpp"
#include "io/gltf.hpp"
#include "io/image_file.hpp"
#include "src/io/gltf_builder.hpp"
#include "src/io/temporary_folder.hpp"

namespace tessera {
namespace {

Scene load(const GltfBuilder& builder, GltfReport* report = nullptr) {
  const TemporaryFolder folder;
  return load_gltf(write_file(folder.file("a.gltf"), builder.gltf()), report);
}

std::vector<std::uint8_t> file_of(const std::string& path) {
  const auto bytes = read_file(path);
  const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return {first, first + bytes.size()};
}

std::vector<std::uint8_t> png(int width, int height) {
  const TemporaryFolder folder;
  std::vector<unsigned char> pixels(std::size_t(width * height) * 3, 77);
  write_png(folder.file("a.png"), width, height, 3, pixels.data());
  return file_of(folder.file("a.png"));
}

TEST(GltfMaterial, FactorsAndModes) {
  GltfBuilder b = GltfBuilder::triangle();
  b.primitive()["material"] = b.push(
      "materials", {{"name", "m"},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}}},
                    {"emissiveFactor", {0.5, 0.25, 1}},
                    {"alphaMode", "MASK"},
                    {"alphaCutoff", 0.3},
                    {"doubleSided", true},
                    {"extensions",
                     {{"KHR_materials_emissive_strength", {{"emissiveStrength", 12.5}}},
                      {"KHR_materials_unlit", json::object()},
                      {"KHR_materials_clearcoat", {{"clearcoatFactor", "not even a number"}}}}}});
  b.root["extensionsUsed"] = {"KHR_materials_emissive_strength", "KHR_materials_unlit", "KHR_materials_clearcoat"};
  GltfReport report;
  const Scene scene = load(b, &report);
  ASSERT_EQ(scene.materials.size(), 1u);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.name, "m");
  EXPECT_EQ(m.base_color[1], 0.2f);
  EXPECT_EQ(m.base_color[3], 0.4f);
  EXPECT_EQ(m.metallic, 0.25f);
  EXPECT_EQ(m.roughness, 0.75f);
  EXPECT_EQ(m.emissive[1], 0.25f);
  EXPECT_EQ(m.emissive_strength, 12.5f);
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.3f);
  EXPECT_TRUE(m.double_sided);
  EXPECT_TRUE(m.unlit);
  EXPECT_EQ(report.extensions_unsupported, std::vector<std::string>{"KHR_materials_clearcoat"});
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("KHR_materials_clearcoat"), std::string::npos);
}

TEST(GltfMaterial, DefaultsAreGltfs) {
  GltfBuilder b = GltfBuilder::triangle();
  b.primitive()["material"] = b.push("materials", json::object());
  const Scene scene = load(b);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.base_color[0], 1);
  EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(m.alpha_cutoff, 0.5f);
  EXPECT_EQ(m.normal_scale, 1);
  EXPECT_EQ(m.emissive_strength, 1);
  EXPECT_EQ(m.base_color_texture.texture, -1);
}

TEST(GltfMaterial, BindingsTellApartWhatVerticesCarry) {
  GltfBuilder b = GltfBuilder::triangle();
  b.push("materials", json::object());
  b.primitive()["material"] = 0;
  json second = b.primitive();
  second["attributes"]["COLOR_0"] = b.accessor<float>({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
  b.root["meshes"][0]["primitives"].push_back(second);
  b.root["meshes"][0]["primitives"].push_back(second);
  const Scene scene = load(b);
  EXPECT_EQ(scene.materials.size(), 1u);
  ASSERT_EQ(scene.bindings.size(), 2u);
  EXPECT_FALSE(scene.bindings[0].has_colors);
  EXPECT_TRUE(scene.bindings[1].has_colors);
  EXPECT_EQ(scene.triangles[2].binding, 1u);
  EXPECT_EQ(scene.attributes[3].color[3], 1);
}

TEST(GltfMaterial, EveryTextureSlotWithTransformAndSampler) {
  GltfBuilder b = GltfBuilder::textured(png(4, 2));
  b.push("samplers", {{"magFilter", 9728}, {"minFilter", 9985}, {"wrapS", 33071}, {"wrapT", 33648}});
  b.push("textures", {{"source", 0}, {"sampler", 0}});
  const json transform = {
      {"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"rotation", 1.5}, {"scale", {2, 3}}, {"texCoord", 1}}}};
  b.root["materials"][0] = {
      {"pbrMetallicRoughness",
       {{"baseColorTexture", {{"index", 1}, {"extensions", transform}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
      {"normalTexture", {{"index", 1}, {"scale", 0.5}, {"texCoord", 1}, {"extensions", transform}}},
      {"occlusionTexture", {{"index", 0}, {"strength", 0.25}, {"texCoord", 1}, {"extensions", transform}}},
      {"emissiveTexture", {{"index", 0}, {"extensions", transform}}}};
  const Scene scene = load(b);
  const Material& m = scene.materials[0];
  ASSERT_EQ(scene.textures.size(), 2u);
  for (const TextureSlot* slot :
       {&m.base_color_texture, &m.normal_texture, &m.occlusion_texture, &m.emissive_texture}) {
    ASSERT_GE(slot->texture, 0);
    EXPECT_EQ(slot->uv_set, 1);
    EXPECT_EQ(slot->rotation, 1.5f);
    EXPECT_EQ(slot->offset[1], 0.25f);
    EXPECT_EQ(slot->scale[1], 3);
  }
  EXPECT_EQ(m.metallic_roughness_texture.uv_set, 0);
  EXPECT_EQ(m.metallic_roughness_texture.scale[0], 1);
  EXPECT_EQ(m.normal_scale, 0.5f);
  EXPECT_EQ(m.occlusion_strength, 0.25f);
  const Sampler& s = scene.textures[std::size_t(m.base_color_texture.texture)].sampler;
  EXPECT_EQ(s.wrap_u, WrapMode::clamp_to_edge);
  EXPECT_EQ(s.wrap_v, WrapMode::mirrored_repeat);
  EXPECT_EQ(s.magnify, FilterMode::nearest);
  EXPECT_EQ(s.minify, FilterMode::linear);
  EXPECT_EQ(s.mip, FilterMode::nearest);
  EXPECT_TRUE(s.mipmapped);
  ASSERT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.images[0].width, 4);
  EXPECT_EQ(scene.images[0].height, 2);
  EXPECT_EQ(int(scene.images[0].pixels[0]), 77);
}

TEST(GltfMaterial, ImagesComeFromUrisToo) {
  const TemporaryFolder folder;
  const auto bytes = png(3, 3);
  GltfBuilder b = GltfBuilder::textured(bytes);
  b.root["images"][0] = {{"uri", "data:image/png;base64," + base64(bytes)}};
  EXPECT_EQ(load_gltf(write_file(folder.file("a.gltf"), b.gltf())).images[0].width, 3);
  write_file(folder.file("a b.png"), std::string(bytes.begin(), bytes.end()));
  b.root["images"][0] = {{"uri", "a%20b.png"}, {"name", "wood"}};
  const Scene scene = load_gltf(write_file(folder.file("a.gltf"), b.gltf()));
  EXPECT_EQ(scene.images[0].width, 3);
  EXPECT_EQ(scene.images[0].name, "wood");
}

TEST(GltfMaterial, OnlyReachableImagesAreDecoded) {
  GltfBuilder b = GltfBuilder::textured(png(2, 2));
  const std::vector<std::uint8_t> junk(10, 1);
  b.push("images", {{"bufferView", b.view(junk.data(), junk.size())}, {"mimeType", "image/png"}});
  b.push("textures", {{"source", 1}});
  b.push("materials", {{"emissiveTexture", {{"index", 1}}}});
  const Scene scene = load(b);
  ASSERT_EQ(scene.images.size(), 2u);
  EXPECT_EQ(scene.images[0].width, 2);
  EXPECT_EQ(scene.images[1].width, 0);
}

TEST(GltfMaterial, UnsupportedUvSetsAndOddFactorsAreWarnedOf) {
  GltfBuilder b = GltfBuilder::textured(png(2, 2));
  b.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 2;
  b.root["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 1.5;
  GltfReport report;
  const Scene scene = load(b, &report);
  EXPECT_EQ(report.warnings.size(), 2u);
  EXPECT_EQ(scene.materials[0].metallic, 1);
  EXPECT_EQ(scene.materials[0].base_color_texture.texture, -1);
}

TEST(GltfMaterial, WebpAndBasisFallBackToTheirSource) {
  GltfBuilder b = GltfBuilder::textured(png(2, 2));
  b.root["textures"][0]["extensions"]["KHR_texture_basisu"] = {{"source", 5}};
  EXPECT_EQ(load(b).images[0].width, 2);
  if (auto output = OIIO::ImageOutput::create("webp")) {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> pixels(5 * 5 * 3, 10);
    ASSERT_TRUE(output->open(folder.file("a.webp"), OIIO::ImageSpec(5, 5, 3, OIIO::TypeDesc::UINT8)) &&
                output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && output->close());
    const auto webp = file_of(folder.file("a.webp"));
    b.push("images", {{"bufferView", b.view(webp.data(), webp.size())}, {"mimeType", "image/webp"}});
    b.root["textures"][0]["extensions"]["EXT_texture_webp"] = {{"source", 1}};
    EXPECT_EQ(load(b).images[1].width, 5);
  }
}

TEST(GltfMaterial, VariantsAreListedAndTheDefaultIsUsed) {
  GltfBuilder b = GltfBuilder::triangle();
  b.push("materials", {{"name", "default"}});
  b.push("materials", {{"name", "other"}});
  b.primitive()["material"] = 0;
  b.primitive()["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}}};
  b.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}, {{"name", "blue"}}};
  b.root["extensionsUsed"] = b.root["extensionsRequired"] = {"KHR_materials_variants"};
  GltfReport report;
  EXPECT_EQ(load(b, &report).materials[0].name, "default");
  EXPECT_EQ(report.variants, (std::vector<std::string>{"red", "blue"}));
  EXPECT_TRUE(report.warnings.empty());
}

TEST(GltfLight, EveryTypeInWorldSpace) {
  GltfBuilder b = GltfBuilder::triangle();
  b.root["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"intensity", 3}, {"name", "sun"}},
      {{"type", "point"}, {"color", {0.5, 1, 0.25}}, {"range", 20}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}};
  const auto reference = [](int light) { return json{{"KHR_lights_punctual", {{"light", light}}}}; };
  const double s = std::sqrt(0.5);
  b.node({{"extensions", reference(0)}, {"rotation", {-s, 0, 0, s}}, {"scale", {5, 5, 5}}});
  b.node({{"extensions", reference(1)}, {"translation", {1, 2, 3}}, {"name", "lamp"}});
  b.node({{"extensions", reference(2)}});
  b.push("nodes", {{"extensions", reference(2)}});  // of no scene
  b.root["extensionsUsed"] = {"KHR_lights_punctual"};
  const Scene scene = load(b);
  ASSERT_EQ(scene.lights.size(), 3u);
  const Light& sun = scene.lights[0];
  EXPECT_EQ(sun.type, LightType::directional);
  EXPECT_EQ(sun.name, "sun");
  EXPECT_EQ(sun.intensity, 3);
  EXPECT_NEAR(sun.direction[1], -1, 1e-6);  // -Z turned by -90 degrees about X
  const Light& lamp = scene.lights[1];
  EXPECT_EQ(lamp.type, LightType::point);
  EXPECT_EQ(lamp.name, "lamp");
  EXPECT_EQ(lamp.position[2], 3);
  EXPECT_EQ(lamp.color[2], 0.25f);
  EXPECT_EQ(lamp.intensity, 1);
  EXPECT_EQ(lamp.range, 20);
  EXPECT_EQ(scene.lights[2].inner_cone_angle, 0.25f);
  EXPECT_EQ(scene.lights[2].outer_cone_angle, 0.5f);
  EXPECT_EQ(scene.lights[2].direction[2], -1);
  EXPECT_EQ(scene.lights[2].range, 0);
}

TEST(GltfCamera, PerspectiveAndOrthographicInWorldSpace) {
  GltfBuilder b = GltfBuilder::triangle();
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}, {"aspectRatio", 2}}}});
  b.push("cameras", {{"type", "orthographic"},
                     {"name", "plan"},
                     {"orthographic", {{"xmag", 6}, {"ymag", 3}, {"znear", 0}, {"zfar", 10}}}});
  const double s = std::sqrt(0.5);
  b.node({{"camera", 0}, {"translation", {0, 1, 5}}, {"scale", {3, 3, 3}}, {"name", "front"}});
  b.node({{"camera", 1}, {"rotation", {0, s, 0, s}}});
  const Scene scene = load(b);
  ASSERT_EQ(scene.cameras.size(), 2u);
  const Camera& front = scene.cameras[0];
  EXPECT_EQ(front.name, "front");
  EXPECT_EQ(front.vertical_fov, 0.5);
  EXPECT_EQ(front.near_plane, 0.25);
  EXPECT_EQ(front.far_plane, 0);
  EXPECT_EQ(front.aspect, 2);
  EXPECT_EQ(front.eye[1], 1);
  EXPECT_EQ(front.target[2], 4);
  EXPECT_EQ(front.up[1], 1);
  const Camera& plan = scene.cameras[1];
  EXPECT_TRUE(plan.orthographic);
  EXPECT_EQ(plan.name, "plan");
  EXPECT_EQ(plan.vertical_extent, 3);
  EXPECT_EQ(plan.aspect, 2);
  EXPECT_EQ(plan.far_plane, 10);
  EXPECT_NEAR(plan.target[0], -1, 1e-12);  // -Z turned by 90 degrees about Y
}

}  // namespace
}  // namespace tessera

#include "frame/material.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "frame/dispatch.hpp"

namespace tessera {
namespace {

SourceImage grey(std::uint8_t value) { return {"grey", 1, 1, 1, PixelType::u8, {std::byte{value}}}; }

// Every slot filled with a texture of its own.
Scene scene_with_textures() {
  Scene scene;
  for (int i = 0; i < 5; ++i) {
    scene.images.push_back(grey(std::uint8_t(40 * i)));
    scene.textures.push_back({i, {}});
  }
  Material m;
  m.base_color_texture.texture = 0;
  m.metallic_roughness_texture.texture = 1;
  m.normal_texture.texture = 2;
  m.occlusion_texture.texture = 3;
  m.emissive_texture.texture = 4;
  for (float& e : m.emissive) e = 0.5f;
  m.emissive_strength = 8;
  scene.materials = {m};
  scene.bindings = {{0, true, false}};
  return scene;
}

MaterialView compile(const Scene& scene, TextureSet& textures) {
  return compile_materials(scene, textures, select_kernels())[0];
}

TEST(CompileMaterials, CarriesEverythingOver) {
  Scene scene = scene_with_textures();
  Material& m = scene.materials[0];
  m.base_color[1] = 0.25f;
  m.metallic = 0.5f;
  m.roughness = 0.75f;
  m.alpha_cutoff = 0.3f;
  m.alpha_mode = AlphaMode::mask;
  m.double_sided = true;
  m.occlusion_texture.uv_set = 1;
  scene.materials.push_back({});
  scene.bindings.push_back({1, false, true});
  TextureSet textures;
  const std::vector<MaterialView> views = compile_materials(scene, textures, select_kernels());
  ASSERT_EQ(views.size(), 2u);
  const MaterialView& v = views[0];
  EXPECT_EQ(v.base_color[1], 0.25f);
  EXPECT_EQ(v.metallic, 0.5f);
  EXPECT_EQ(v.roughness, 0.75f);
  EXPECT_EQ(v.alpha_cutoff, 0.3f);
  EXPECT_EQ(v.emissive[2], 4);  // 0.5 * 8
  EXPECT_EQ(v.alpha_mode, AlphaMode::mask);
  EXPECT_TRUE(v.double_sided && v.has_tangents && !v.has_colors && !v.unlit);
  EXPECT_EQ(v.occlusion_texture.uv_set, 1);
  EXPECT_EQ(v.base_color_texture.texture, textures.find({0, Encoding::srgb}));
  EXPECT_EQ(v.metallic_roughness_texture.texture, textures.find({1, Encoding::linear}));
  EXPECT_EQ(v.normal_texture.texture, textures.find({2, Encoding::linear}));
  EXPECT_EQ(v.occlusion_texture.texture, textures.find({3, Encoding::linear}));
  EXPECT_EQ(v.emissive_texture.texture, textures.find({4, Encoding::srgb}));
  for (const TextureSlotView* slot : {&v.base_color_texture, &v.metallic_roughness_texture, &v.normal_texture,
                                      &v.occlusion_texture, &v.emissive_texture})
    EXPECT_NE(slot->texture, nullptr);
  EXPECT_TRUE(views[1].has_colors);
  EXPECT_EQ(views[1].base_color_texture.texture, nullptr);
}

TEST(CompileMaterials, WhatCannotShowIsNotBuilt) {
  Scene scene = scene_with_textures();
  scene.materials.push_back(scene.materials[0]);  // not bound
  Material& m = scene.materials[0];
  m.metallic = m.roughness = m.normal_scale = m.occlusion_strength = m.emissive_strength = 0;
  for (int c = 0; c < 3; ++c) m.base_color[c] = 0;
  TextureSet none;
  compile(scene, none);
  EXPECT_EQ(none.bytes(), 0u);
  m.alpha_mode = AlphaMode::blend;  // the texture's alpha shows
  TextureSet one;
  EXPECT_NE(compile(scene, one).base_color_texture.texture, nullptr);
  EXPECT_EQ(one.bytes(), 8u);
}

TEST(CompileMaterials, UnlitUsesBaseColorAlone) {
  Scene scene = scene_with_textures();
  scene.materials[0].unlit = true;
  TextureSet textures;
  const MaterialView v = compile(scene, textures);
  EXPECT_TRUE(v.unlit);
  EXPECT_EQ(v.emissive[0], 0);
  EXPECT_NE(v.base_color_texture.texture, nullptr);
  for (const TextureSlotView* slot :
       {&v.metallic_roughness_texture, &v.normal_texture, &v.occlusion_texture, &v.emissive_texture})
    EXPECT_EQ(slot->texture, nullptr);
}

TEST(TextureTransform, ScalesTurnsThenMoves) {
  float t[6];
  texture_transform({}, select_kernels(), t);
  const float identity[6] = {1, 0, 0, 0, 1, 0};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(t[i], identity[i]);

  TextureSlot slot;
  slot.offset[0] = 0.25f, slot.offset[1] = -0.5f;
  slot.scale[0] = 2, slot.scale[1] = 3;
  slot.rotation = 0.7f;
  texture_transform(slot, select_kernels(), t);
  const double u = 0.3, v = 0.9, c = std::cos(0.7), s = std::sin(0.7);
  EXPECT_NEAR(t[0] * u + t[1] * v + t[2], c * 2 * u + s * 3 * v + 0.25, 1e-6);
  EXPECT_NEAR(t[3] * u + t[4] * v + t[5], -s * 2 * u + c * 3 * v - 0.5, 1e-6);
}

// The extension's own example: offset (0, 1), rotation 90 degrees, scale 0.5 "utilizes only the lower left quadrant of
// the source image, rotated clockwise 90 degrees".
TEST(TextureTransform, TheExtensionsExample) {
  TextureSlot slot;
  slot.offset[1] = 1;
  slot.scale[0] = slot.scale[1] = 0.5f;
  slot.rotation = 1.57079632679f;
  float t[6];
  texture_transform(slot, select_kernels(), t);
  for (const double u : {0.1, 0.9})
    for (const double v : {0.1, 0.9}) {
      const double x = t[0] * u + t[1] * v + t[2], y = t[3] * u + t[4] * v + t[5];
      EXPECT_TRUE(x > 0 && x < 0.5) << x;  // left
      EXPECT_TRUE(y > 0.5 && y < 1) << y;  // lower: v points down
    }
}

}  // namespace
}  // namespace tessera

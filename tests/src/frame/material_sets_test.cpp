#include "frame/material_sets.hpp"

#include <gtest/gtest.h>

#include "frame/dispatch.hpp"

namespace tessera {
namespace {

// Two materials: colour; and roughness that shares its texture with occlusion.
Scene textured() {
  Scene scene;
  for (int i = 0; i < 2; ++i) {
    scene.images.push_back({"grey", 2, 2, 1, PixelType::u8, std::vector<std::byte>(4, std::byte{99})});
    scene.textures.push_back({i, {}});
  }
  Material color, rough;
  color.base_color_texture.texture = 0;
  rough.metallic_roughness_texture.texture = rough.occlusion_texture.texture = 1;
  scene.materials = {color, rough};
  scene.bindings = {{0, false, false}, {1, false, false}};
  return scene;
}

TEST(MaterialSets, EachFilterHasItsOwnViewsOfTheSameTexels) {
  const Scene scene = textured();
  MaterialSets sets(scene, select_kernels());
  const std::vector<MaterialView>& filed = sets.get(ColorTexels::halves, TextureFilter::file);
  const TextureView before = *filed[0].base_color_texture.texture;
  for (const TextureFilter filter : {TextureFilter::nearest_mip, TextureFilter::no_mips, TextureFilter::nearest}) {
    const std::vector<MaterialView>& other = sets.get(ColorTexels::halves, filter);
    ASSERT_EQ(other.size(), 2u);
    const TextureView& texture = *other[0].base_color_texture.texture;
    EXPECT_EQ(texture.texels, before.texels);
    EXPECT_EQ(texture.mipmapped, filter != TextureFilter::no_mips);
    const bool nearest_mip = filter == TextureFilter::nearest_mip || filter == TextureFilter::nearest;
    EXPECT_EQ(texture.mip, nearest_mip ? FilterMode::nearest : before.mip);
    EXPECT_EQ(texture.minify, filter == TextureFilter::nearest ? FilterMode::nearest : before.minify);
    EXPECT_EQ(texture.magnify, filter == TextureFilter::nearest ? FilterMode::nearest : before.magnify);
    EXPECT_NE(&texture, filed[0].base_color_texture.texture);
    EXPECT_EQ(other[1].metallic_roughness_texture.texture, other[1].occlusion_texture.texture);
    EXPECT_EQ(other[1].normal_texture.texture, nullptr);
    EXPECT_EQ(&other, &sets.get(ColorTexels::halves, filter));  // kept
  }
  EXPECT_EQ(filed[0].base_color_texture.texture->mip, before.mip);
  EXPECT_EQ(before.mip, FilterMode::linear);
}

TEST(MaterialSets, ColorsInBytesTakeHalfTheMemory) {
  const Scene scene = textured();
  MaterialSets sets(scene, select_kernels());
  sets.get(ColorTexels::halves, TextureFilter::file);
  const std::vector<MaterialView>& bytes = sets.get(ColorTexels::bytes, TextureFilter::nearest);
  EXPECT_EQ(bytes[0].base_color_texture.texture->format, TexelFormat::rgba8_squares);
  EXPECT_EQ(bytes[1].occlusion_texture.texture->format, TexelFormat::rgba8_unorm);
  EXPECT_EQ(sets.texture_bytes(ColorTexels::halves), 5u * 8 + 5u * 4);
  EXPECT_EQ(sets.texture_bytes(ColorTexels::bytes), 5u * 4 + 5u * 4);
}

}  // namespace
}  // namespace tessera

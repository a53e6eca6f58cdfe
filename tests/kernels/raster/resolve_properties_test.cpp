// What must hold for resolve whatever a scene has: results in range and the same everywhere for any bits, and texture
// slots that do not disturb each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "kernels/raster/ray_reference.hpp"
#include "kernels/raster/resolve_fixture.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::resolve_test {
namespace {

// Any bits: the same planes on every instruction set, all of them finite and in range.
TEST(Resolve, AnyInputIsFiniteAndTheSameEverywhere) {
  std::mt19937 random(31);
  const float wild[] = {0, -0.0f, 1e-42f, -1e-30f, 1e-20f, 1e10f, -1e20f, 3e38f, INFINITY, -INFINITY, NAN, 1, -1};
  const auto number = [&](int oddness) {
    if (int(random() % 100) < oddness) return wild[random() % std::size(wild)];
    return float(uniform(random, -40, 40));
  };
  TextureMemory texture;
  for (int i = 0; i < 4 * (64 + 16 + 4 + 1); ++i) texture.bytes.push_back(std::uint8_t(random()));
  texture.view = {nullptr,
                  TexelFormat::rgba8_unorm,
                  8,
                  8,
                  4,
                  WrapMode::repeat,
                  WrapMode::mirrored_repeat,
                  FilterMode::nearest,
                  FilterMode::linear,
                  FilterMode::linear,
                  true};
  TextureMemory halves;
  for (int i = 0; i < 4 * (15 + 3 + 1); ++i) halves.halves.push_back(std::uint16_t(random()));
  halves.view = {nullptr,
                 TexelFormat::rgba16_float,
                 5,
                 3,
                 3,
                 WrapMode::clamp_to_edge,
                 WrapMode::repeat,
                 FilterMode::linear,
                 FilterMode::linear,
                 FilterMode::nearest,
                 true};
  for (int round = 0; round < 40; ++round) {
    const int oddness = round % 4 == 0 ? 0 : round % 4 == 1 ? 3 : round % 4 == 2 ? 20 : 60;
    Workbench bench;
    MaterialView& m = bench.material;
    m.has_colors = round & 1;
    m.has_tangents = round & 2;
    m.double_sided = round & 4;
    m.alpha_mode = AlphaMode(round % 3);
    for (float& c : m.base_color) c = number(oddness);
    for (float& c : m.emissive) c = number(oddness);
    m.metallic = number(oddness), m.roughness = number(oddness);
    m.normal_scale = number(oddness), m.occlusion_strength = number(oddness);
    if (round % 5 != 0) {
      bind(m.base_color_texture, halves);
      bind(m.normal_texture, texture);
      bind(m.metallic_roughness_texture, texture);
      bind(m.occlusion_texture, round & 8 ? texture : halves);
      bind(m.emissive_texture, halves);
      m.occlusion_texture.uv_set = round & 1;
      for (float& t : m.normal_texture.transform) t = number(oddness / 2);
    }
    for (auto* row : {bench.view.x, bench.view.y, bench.view.z, bench.view.w})
      for (int i = 0; i < 4; ++i)
        if (oddness > 0) row[i] += number(oddness);
    bench.pattern = {4, {96, 224, 32, 160}, {32, 96, 160, 224}};
    std::vector<Fragment> fragments;
    for (int k = 0; k < 403; ++k) {
      for (int i = 0; i < 3; ++i) {
        VertexAttributes a;
        float raw[16];
        for (float& x : raw) x = number(oddness);
        std::memcpy(&a, raw, sizeof(a));
        bench.add_vertex(number(oddness), number(oddness), number(oddness), a);
      }
      std::uint32_t v[3];
      for (std::uint32_t& x : v) x = random() % bench.attributes.size();  // often shared, or the same one twice
      const std::uint32_t triangle = bench.add_triangle(v[0], v[1], v[2]);
      const int run = 1 + int(random() % 20);
      for (int r = 0; r < run; ++r)
        fragments.push_back({triangle, std::uint16_t(random() % tile_pixels), std::uint16_t(random() % 16)});
    }
    const auto tables = runnable_kernels();
    const GBuffer first = bench.resolve(*tables[0], fragments);
    const AlignedVector<float> first_alpha = bench.resolve_alpha(*tables[0], fragments);
    for (const Kernels* kernels : tables) {
      const GBuffer out = bench.resolve(*kernels, fragments);
      for (int p = 0; p < gbuffer_planes; ++p)
        ASSERT_EQ(0, std::memcmp(out.planes[p].data(), first.planes[p].data(), fragments.size() * sizeof(float)))
            << kernels->isa << " " << plane_names[p] << " round " << round;
      const AlignedVector<float> alphas = bench.resolve_alpha(*kernels, fragments);
      ASSERT_EQ(0, std::memcmp(alphas.data(), first_alpha.data(), fragments.size() * sizeof(float))) << kernels->isa;
    }
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const auto at = [&](int plane) { return first.planes[plane][i]; };
      for (int p = 0; p < gbuffer_planes; ++p)
        ASSERT_TRUE(std::isfinite(at(p))) << plane_names[p] << " round " << round;
      for (const int p : {int(position), position + 1, position + 2}) ASSERT_LE(std::abs(at(p)), 1e12f);
      for (const int p : {int(emissive), emissive + 1, emissive + 2}) {
        ASSERT_GE(at(p), 0) << plane_names[p];
        ASSERT_LE(at(p), 1e30f) << plane_names[p];
      }
      for (const int p :
           {int(color), color + 1, color + 2, int(metallic), int(roughness), int(occlusion), int(alpha), int(depth)}) {
        ASSERT_GE(at(p), 0) << plane_names[p];
        ASSERT_LE(at(p), 1) << plane_names[p];
      }
      ASSERT_NEAR(std::hypot(at(normal), at(normal + 1), at(normal + 2)), 1, 1e-5) << "round " << round;
      if (m.alpha_mode == AlphaMode::blend) {
        ASSERT_EQ(at(alpha), first_alpha[i]);
      }
    }
  }
}

// Slots that are addressed alike share the work; a difference in any one setting must keep them apart. So every slot
// must come out as if it were alone.
TEST(Resolve, SlotsDoNotDisturbEachOther) {
  std::mt19937 random(61);
  TextureMemory textures[2];
  for (TextureMemory& t : textures) {
    for (int i = 0; i < 4 * (256 + 64 + 16 + 4 + 1); ++i) t.halves.push_back(std::uint16_t(random() % 0x3c00));
    t.view = trilinear(TexelFormat::rgba16_float, 16, 16, 5);
  }
  Workbench bench;
  for (float& e : bench.material.emissive) e = 1;
  add_covering_triangle(bench, [](float x, float y) {
    VertexAttributes a = plain_attributes();
    a.uv[0][0] = 0.13f * x, a.uv[0][1] = 0.11f * y - 1;
    a.uv[1][0] = 0.02f * y, a.uv[1][1] = 0.21f * x;
    return a;
  });
  bind(bench.material.base_color_texture, textures[0]);
  bind(bench.material.emissive_texture, textures[1]);
  const TextureView plain = textures[1].view;
  const std::vector<Fragment> fragments = whole_tile();
  for (int setting = 0; setting < 11; ++setting) {
    Workbench both = bench;
    TextureView& view = textures[1].view = plain;
    TextureSlotView& slot = both.material.emissive_texture;
    if (setting == 1) view.wrap_u = WrapMode::clamp_to_edge;
    if (setting == 2) view.wrap_v = WrapMode::mirrored_repeat;
    if (setting == 3) view.magnify = FilterMode::nearest;
    if (setting == 4) view.minify = FilterMode::nearest;
    if (setting == 5) view.mip = FilterMode::nearest;
    if (setting == 6) view.mipmapped = false;
    if (setting == 7) view.height = 4, view.levels = 5;
    if (setting == 8) view.levels = 2;
    if (setting == 9) slot.uv_set = 1;
    if (setting == 10) slot.transform[5] = 0.3f;
    Workbench first = both, second = both;
    first.material.emissive_texture.texture = nullptr;
    second.material.base_color_texture.texture = nullptr;
    for (const Kernels* kernels : runnable_kernels()) {
      const GBuffer together = both.resolve(*kernels, fragments);
      const GBuffer one = first.resolve(*kernels, fragments), other = second.resolve(*kernels, fragments);
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(together.planes[color + c], one.planes[color + c]) << kernels->isa << " setting " << setting;
        EXPECT_EQ(together.planes[emissive + c], other.planes[emissive + c]) << kernels->isa << " setting " << setting;
      }
    }
  }
}

}  // namespace
}  // namespace tessera::resolve_test

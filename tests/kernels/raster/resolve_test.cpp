// What resolve puts into the G-buffer: points, interpolation and mip levels against rays in double; materials by hand.
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

// Random triangles before a perspective camera, each seen at one pixel of one tile. Vertex colours are unit vectors,
// so that the interpolated colour is the barycentrics.
struct RayScene {
  RayCamera camera;
  Workbench bench;
  std::vector<Fragment> fragments;
  std::vector<RayHit> hits;
  std::vector<Vector> points;

  explicit RayScene(unsigned seed, int wanted) {
    std::mt19937 random(seed);
    bench.view = camera.view();
    bench.tile_x = 1312;
    bench.tile_y = 736;
    bench.material.has_colors = true;
    while (int(fragments.size()) < wanted) {
      Vector p[3];
      for (Vector& v : p) v = camera.random_point(random);
      for (Vector& v : p) v = {float(v.x), float(v.y), float(v.z)};
      const int px = int(random() % tile_size), py = int(random() % tile_size);
      const RayHit hit = camera.intersect(p, bench.tile_x + px + 0.5, bench.tile_y + py + 0.5);
      const Vector e1 = p[1] - p[0], e2 = p[2] - p[0];
      const double slant = std::abs(inner(unit(outer(e1, e2)), unit(hit.t * camera.forward)));
      if (!hit.inside(1e-3) || slant < 0.05) continue;  // edge-on triangles multiply rounding
      std::uint32_t index[3];
      for (int i = 0; i < 3; ++i) {
        VertexAttributes a = plain_attributes();
        for (int c = 0; c < 4; ++c) a.color[c] = c == i || c == 3;
        index[i] = bench.add_vertex(float(p[i].x), float(p[i].y), float(p[i].z), a);
      }
      fragments.push_back({bench.add_triangle(index[0], index[1], index[2]), pixel(px, py), 1});
      hits.push_back(hit);
      points.push_back(hit.b[0] * p[0] + hit.b[1] * p[1] + hit.b[2] * p[2]);
    }
  }
};

TEST(Resolve, InterpolatesWhereTheRayHits) {
  const RayScene scene(21, 3000);
  for (const Kernels* kernels : runnable_kernels()) {
    const GBuffer out = scene.bench.resolve(*kernels, scene.fragments);
    for (std::size_t i = 0; i < scene.fragments.size(); ++i) {
      SCOPED_TRACE(kernels->isa + std::string(" ") + std::to_string(i));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(out.planes[color + c][i], scene.hits[i].b[c], 1e-4);
      EXPECT_NEAR(out.planes[position][i], scene.points[i].x, 1e-3);
      EXPECT_NEAR(out.planes[position + 1][i], scene.points[i].y, 1e-3);
      EXPECT_NEAR(out.planes[position + 2][i], scene.points[i].z, 1e-3);
      const double reversed = scene.camera.near_plane / scene.hits[i].t;
      EXPECT_NEAR(out.planes[depth][i], reversed, 1e-3 * reversed);
    }
  }
}

// Level k of the texture is k / 8 everywhere, so that the colour is the level of detail.
TEST(Resolve, MipLevelIsThatOfTheFootprint) {
  RayScene scene(22, 1000);
  TextureMemory texture;
  const std::uint16_t halves[] = {0, 0x3000, 0x3400, 0x3600, 0x3800, 0x3900, 0x3a00, 0x3b00, 0x3c00};  // 0 .. 1
  for (int k = 0; k < 9; ++k)
    texture.halves.insert(texture.halves.end(), 4 * (256 >> k) * std::max(1, 64 >> k), halves[k]);
  texture.view = trilinear(TexelFormat::rgba16_float, 256, 64, 9);
  Workbench& bench = scene.bench;
  bench.material.has_colors = false;
  TextureSlotView& slot = bench.material.base_color_texture;
  bind(slot, texture);
  slot.uv_set = 1;
  const float transform[6] = {1.5f, -0.7f, 0.3f, 0.4f, 2.5f, -0.1f};
  std::copy_n(transform, 6, slot.transform);
  std::mt19937 random(23);
  for (VertexAttributes& a : bench.attributes) {
    a.uv[1][0] = float(uniform(random, -3, 3));
    a.uv[1][1] = float(uniform(random, -3, 3));
  }
  const auto texels = [&](std::size_t i, double dx, double dy) {
    const Fragment& f = scene.fragments[i];
    Vector p[3];
    double u = 0, v = 0;
    const std::uint32_t* index = bench.triangles[f.triangle].vertex;
    for (int k = 0; k < 3; ++k) {
      const float* at = bench.positions.data() + 3 * std::size_t{index[k]};
      p[k] = {at[0], at[1], at[2]};
    }
    const RayHit hit = scene.camera.intersect(p, bench.tile_x + tile_pixel_x(f.pixel) + 0.5 + dx,
                                              bench.tile_y + tile_pixel_y(f.pixel) + 0.5 + dy);
    for (int k = 0; k < 3; ++k) {
      u += hit.b[k] * bench.attributes[index[k]].uv[1][0];
      v += hit.b[k] * bench.attributes[index[k]].uv[1][1];
    }
    return Vector{256 * (transform[0] * u + transform[1] * v), 64 * (transform[3] * u + transform[4] * v), 0};
  };
  for (const Kernels* kernels : runnable_kernels()) {
    const GBuffer out = bench.resolve(*kernels, scene.fragments);
    for (std::size_t i = 0; i < scene.fragments.size(); ++i) {
      const double h = 1e-3;
      const Vector right = 0.5 / h * (texels(i, h, 0) - texels(i, -h, 0));
      const Vector down = 0.5 / h * (texels(i, 0, h) - texels(i, 0, -h));
      const double lod = 0.5 * std::log2(std::max(inner(right, right), inner(down, down)));
      EXPECT_NEAR(8 * double(out.planes[color][i]), std::clamp(lod, 0.0, 8.0), 5e-3) << kernels->isa << " " << i;
    }
  }
}

TEST(Resolve, ShadesAtTheMeanOfCoveredSamples) {
  Workbench bench;
  bench.pattern = {4, {96, 224, 32, 160}, {32, 96, 160, 224}};  // Direct3D's and Vulkan's
  add_covering_triangle(bench, [](float, float) { return plain_attributes(); });
  std::vector<Fragment> fragments;
  for (int mask = 0; mask < 16; ++mask) fragments.push_back({0, pixel(mask, 31 - mask), std::uint16_t(mask)});
  for (const Kernels* kernels : runnable_kernels()) {
    const GBuffer out = bench.resolve(*kernels, fragments);
    for (int mask = 0; mask < 16; ++mask) {
      double x = 0, y = 0, n = 0;
      for (int s = 0; s < 4; ++s) {
        if ((mask >> s & 1) == 0 && mask != 0) continue;  // none covered counts as all
        x += bench.pattern.x[s];
        y += bench.pattern.y[s];
        ++n;
      }
      EXPECT_NEAR(out.planes[position][mask], mask + x / n / 256, 2e-5) << kernels->isa << " mask " << mask;
      EXPECT_NEAR(out.planes[position + 1][mask], 31 - mask + y / n / 256, 2e-5) << kernels->isa << " mask " << mask;
    }
  }
}

TEST(Resolve, FactorsTimesTexelsTimesColors) {
  Workbench bench;
  MaterialView& m = bench.material;
  const float factor[4] = {0.5f, 0.25f, 1, 0.5f};
  std::copy_n(factor, 4, m.base_color);
  m.metallic = 0.75f;
  m.roughness = 0.5f;
  m.occlusion_strength = 0.5f;
  m.emissive[0] = 6, m.emissive[1] = 1, m.emissive[2] = 0;
  m.alpha_mode = AlphaMode::blend;
  m.has_colors = true;
  TextureMemory base = half_texel(0x3800, 0x3c00, 0x3400, 0x3a00);  // 0.5 1 0.25 0.75
  TextureMemory orm = half_texel(0x3400, 0x3800, 0x3800);           // 0.25 0.5 0.5
  TextureMemory ao = half_texel(0x3800, 0, 0);                      // 0.5
  TextureMemory glow = half_texel(0x3c00, 0x4000, 0x3c00);          // 1 2 1
  bind(m.base_color_texture, base);
  bind(m.metallic_roughness_texture, orm);
  bind(m.occlusion_texture, ao);
  bind(m.emissive_texture, glow);
  add_covering_triangle(bench, [](float, float) {
    VertexAttributes a = plain_attributes();
    a.color[0] = 2, a.color[1] = 0.5f, a.color[2] = 1, a.color[3] = 0.5f;
    return a;
  });
  for (const Kernels* kernels : runnable_kernels()) {
    SCOPED_TRACE(kernels->isa);
    const std::vector<Fragment> one = {{0, pixel(5, 6), 1}};
    GBuffer out = bench.resolve(*kernels, one);
    const auto at = [&](int plane) { return out.planes[plane][0]; };
    EXPECT_NEAR(at(color), 0.5 * 2 * 0.5, 1e-6);
    EXPECT_NEAR(at(color + 1), 0.25 * 0.5 * 1, 1e-6);
    EXPECT_NEAR(at(color + 2), 0.25, 1e-6);
    EXPECT_NEAR(at(alpha), 0.5 * 0.5 * 0.75, 1e-6);
    EXPECT_NEAR(at(metallic), 0.375, 1e-6);
    EXPECT_NEAR(at(roughness), 0.25, 1e-6);
    EXPECT_NEAR(at(occlusion), 1 + 0.5 * (0.5 - 1), 1e-6);
    EXPECT_NEAR(at(emissive), 6, 1e-5);
    EXPECT_NEAR(at(emissive + 1), 2, 1e-6);
    EXPECT_EQ(at(emissive + 2), 0);
    EXPECT_EQ(at(unlit), 0);
    EXPECT_EQ(bench.resolve_alpha(*kernels, one)[0], at(alpha));

    Workbench variant = bench;
    variant.material.occlusion_texture = variant.material.metallic_roughness_texture;  // packed: red of the same texels
    variant.material.alpha_mode = AlphaMode::opaque;
    variant.material.unlit = true;
    out = variant.resolve(*kernels, one);
    EXPECT_NEAR(at(occlusion), 1 + 0.5 * (0.25 - 1), 1e-6);
    EXPECT_NEAR(at(roughness), 0.25, 1e-6);
    EXPECT_EQ(at(alpha), 1);
    EXPECT_EQ(at(unlit), 1);
    variant.material.alpha_mode = AlphaMode::mask;
    out = variant.resolve(*kernels, one);
    EXPECT_EQ(at(alpha), 1);
    variant.material.has_colors = false;
    variant.material.base_color_texture.texture = nullptr;
    out = variant.resolve(*kernels, one);
    EXPECT_EQ(at(color), 0.5f);
    EXPECT_EQ(variant.resolve_alpha(*kernels, one)[0], 0.5f);
  }
}

TEST(Resolve, NormalsAreInterpolatedAndUnit) {
  Workbench bench;
  add_covering_triangle(bench, [](float x, float y) {
    VertexAttributes a = plain_attributes();
    a.normal[0] = 0.01f * x, a.normal[1] = -0.02f * y, a.normal[2] = 1;
    return a;
  });
  const std::vector<Fragment> fragments = whole_tile();
  for (const Kernels* kernels : runnable_kernels()) {
    const GBuffer out = bench.resolve(*kernels, fragments);
    for (int i = 0; i < tile_pixels; ++i) {
      const Vector expected = unit({0.01 * (tile_pixel_x(i) + 0.5), -0.02 * (tile_pixel_y(i) + 0.5), 1});
      ASSERT_NEAR(out.planes[normal][i], expected.x, 1e-6);
      ASSERT_NEAR(out.planes[normal + 1][i], expected.y, 1e-6);
      ASSERT_NEAR(out.planes[normal + 2][i], expected.z, 1e-6);
    }
  }
}

TEST(Resolve, ZeroNormalsFallBackToThePlane) {
  Workbench bench;
  add_covering_triangle(bench, [](float, float) {
    VertexAttributes a = plain_attributes();
    a.normal[2] = 0;
    return a;
  });
  for (int i = 0; i < 3; ++i) bench.positions[3 * i + 2] = 0.5f * bench.positions[3 * i];  // the plane z = x / 2
  const Vector e1{0, 256, 0}, e2{256, 0, 128};
  const Vector expected = unit(outer(e1, e2));
  for (const Kernels* kernels : runnable_kernels()) {
    const GBuffer out = bench.resolve(*kernels, {{0, pixel(1, 2), 1}});
    EXPECT_NEAR(out.planes[normal][0], expected.x, 1e-6);
    EXPECT_NEAR(out.planes[normal + 1][0], expected.y, 1e-6);
    EXPECT_NEAR(out.planes[normal + 2][0], expected.z, 1e-6);
  }
}

TEST(Resolve, BackFacesOfDoubleSidedMaterialsTurnTheirNormals) {
  Workbench bench;
  add_covering_triangle(bench, [](float, float) { return plain_attributes(); });
  bench.add_triangle(0, 2, 1);
  const std::vector<Fragment> both = {{0, pixel(1, 2), 1}, {1, pixel(1, 2), 1}};
  for (const Kernels* kernels : runnable_kernels())
    for (const bool double_sided : {false, true}) {
      bench.material.double_sided = double_sided;
      const GBuffer out = bench.resolve(*kernels, both);
      EXPECT_EQ(out.planes[normal + 2][0], 1);
      EXPECT_EQ(out.planes[normal + 2][1], double_sided ? -1 : 1);
    }
}

// A fragment's result depends on nothing but itself: not on its place, its neighbours or how many there are.
TEST(Resolve, TailsAndNeighboursDoNotShow) {
  RayScene scene(41, 70);
  for (int i = 0; i < 20; ++i)
    scene.fragments.insert(scene.fragments.begin() + 16, scene.fragments[3]);  // one triangle
  for (const Kernels* kernels : runnable_kernels()) {
    const GBuffer all = scene.bench.resolve(*kernels, scene.fragments);
    for (std::size_t first = 0; first < 40; ++first)
      for (const std::size_t count : {1, 2, 3, 5, 8, 15, 16, 17, 33}) {
        if (first + count > scene.fragments.size()) continue;
        const std::vector<Fragment> part(scene.fragments.begin() + first, scene.fragments.begin() + first + count);
        const GBuffer out = scene.bench.resolve(*kernels, part);
        for (int p = 0; p < gbuffer_planes; ++p)
          ASSERT_EQ(0, std::memcmp(out.planes[p].data(), all.planes[p].data() + first, count * sizeof(float)))
              << kernels->isa << " " << plane_names[p] << " from " << first << ", " << count;
      }
  }
}

}  // namespace
}  // namespace tessera::resolve_test

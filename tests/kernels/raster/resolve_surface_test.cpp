// Vertices that carry their whole surface, and G-buffers with planes that nobody wants.
#include <gtest/gtest.h>

#include <random>

#include "kernels/raster/ray_reference.hpp"
#include "kernels/raster/resolve_fixture.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::resolve_test {
namespace {

/// Triangles seen by a camera, each by one fragment, with the same surfaces in both layouts.
struct SurfaceScene {
  RayCamera camera;
  Workbench bench;
  AlignedVector<SurfaceVertex> surfaces;
  std::vector<Fragment> fragments;
  std::vector<RayHit> hits;

  explicit SurfaceScene(int wanted) {
    std::mt19937 random(31);
    bench.view = camera.view();
    bench.tile_x = 1312;
    bench.tile_y = 736;
    bench.material = plain_material();
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
        SurfaceVertex s{};
        VertexAttributes a = plain_attributes();
        s.position[0] = float(p[i].x), s.position[1] = float(p[i].y), s.position[2] = float(p[i].z);
        for (int c = 0; c < 3; ++c) {
          s.normal[c] = a.normal[c] = fragments.size() % 50 == 7 ? 0.0f : float(uniform(random, -1, 1));
          s.base_color[c] = a.color[c] = float(uniform(random, 0, 1));
        }
        s.metallic = float(uniform(random, 0, 1));
        s.roughness = float(uniform(random, 0, 1));
        s.occlusion = float(uniform(random, 0, 1));
        index[i] = bench.add_vertex(s.position[0], s.position[1], s.position[2], a);
        surfaces.push_back(s);
      }
      const std::uint32_t triangle = bench.add_triangle(index[0], index[1], index[2]);
      const int same = fragments.size() % 40 == 0 ? 20 : 1;  // whole vectors of one triangle, too
      for (int i = 0; i < same; ++i) {
        fragments.push_back({triangle, pixel(px, py), 1});
        hits.push_back(hit);
      }
    }
  }
  [[nodiscard]] ResolveArgs args(GBuffer& out, bool of_surfaces) const {
    GeometryView geometry = bench.geometry();
    if (of_surfaces) {
      geometry.attributes = nullptr;
      geometry.surfaces = surfaces.data();
    }
    return {geometry,     bench.view,   &bench.material,  bench.pattern,
            bench.tile_x, bench.tile_y, fragments.data(), std::uint32_t(fragments.size()),
            out.view()};
  }
};

TEST(ResolveSurfaces, EqualTheSameSurfacesInAttributesToTheBit) {
  SurfaceScene scene(2000);
  for (const bool double_sided : {false, true}) {
    scene.bench.material.double_sided = double_sided;
    for (const Kernels* kernels : runnable_kernels()) {
      GBuffer expected(scene.fragments.size()), got(scene.fragments.size());
      kernels->resolve(scene.args(expected, false));
      kernels->resolve(scene.args(got, true));
      for (int plane = 0; plane < gbuffer_planes; ++plane) {
        if (plane == metallic || plane == roughness || plane == occlusion) continue;
        ASSERT_EQ(got.planes[std::size_t(plane)], expected.planes[std::size_t(plane)])
            << kernels->isa << ' ' << plane_names[std::size_t(plane)];
      }
    }
  }
}

TEST(ResolveSurfaces, InterpolateMetallicRoughnessAndOcclusionAndScaleThem) {
  SurfaceScene scene(2000);
  scene.bench.material.metallic = 0.5f;
  scene.bench.material.roughness = 0.25f;
  scene.bench.material.occlusion_strength = 0.75f;
  for (const Kernels* kernels : runnable_kernels()) {
    GBuffer out(scene.fragments.size());
    kernels->resolve(scene.args(out, true));
    for (std::size_t i = 0; i < scene.fragments.size(); ++i) {
      double m = 0, r = 0, o = 0;
      for (int k = 0; k < 3; ++k) {
        const SurfaceVertex& v = scene.surfaces[scene.bench.triangles[scene.fragments[i].triangle].vertex[k]];
        m += scene.hits[i].b[k] * v.metallic;
        r += scene.hits[i].b[k] * v.roughness;
        o += scene.hits[i].b[k] * v.occlusion;
      }
      EXPECT_NEAR(out.planes[metallic][i], 0.5 * m, 1e-3) << kernels->isa;
      EXPECT_NEAR(out.planes[roughness][i], 0.25 * r, 1e-3) << kernels->isa;
      EXPECT_NEAR(out.planes[occlusion][i], 1 + 0.75 * (o - 1), 1e-3) << kernels->isa;
    }
  }
}

TEST(ResolveSurfaces, AlphaIsTheMaterials) {
  SurfaceScene scene(100);
  scene.bench.material.base_color[3] = 0.375f;
  for (const Kernels* kernels : runnable_kernels()) {
    GBuffer ignored(1);
    const ResolveArgs all = scene.args(ignored, true);
    AlignedVector<float> alpha(scene.fragments.size() + max_lanes);
    kernels->resolve_alpha({all.geometry, all.view, all.material, all.pattern, all.tile_x, all.tile_y, all.fragments,
                            all.count, alpha.data()});
    for (std::size_t i = 0; i < scene.fragments.size(); ++i) ASSERT_EQ(alpha[i], 0.375f);
  }
}

TEST(ResolvePlanes, ThoseThatAreNotWantedChangeNothingElse) {
  const SurfaceScene scene(500);
  for (const bool of_surfaces : {false, true})
    for (const Kernels* kernels : runnable_kernels()) {
      GBuffer expected(scene.fragments.size()), got(scene.fragments.size());
      kernels->resolve(scene.args(expected, of_surfaces));
      ResolveArgs few = scene.args(got, of_surfaces);
      few.out.emissive[0] = few.out.emissive[1] = few.out.emissive[2] = nullptr;
      few.out.alpha = few.out.unlit = few.out.depth = nullptr;
      kernels->resolve(few);
      for (std::size_t plane = 0; plane < gbuffer_planes; ++plane) {
        if (plane < emissive) {
          ASSERT_EQ(got.planes[plane], expected.planes[plane]) << kernels->isa << ' ' << plane_names[plane];
        } else {
          for (const float x : got.planes[plane]) ASSERT_EQ(x, -77.0f);
        }
      }
    }
}

}  // namespace
}  // namespace tessera::resolve_test

// Normal maps by hand. The quad lies in the plane z = 1 facing +Z, its image upright as seen by the viewer: u grows
// along +X, v against +Y (the test's window has y up, so that world and picture agree).
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/raster/ray_reference.hpp"
#include "kernels/raster/resolve_fixture.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::resolve_test {
namespace {

constexpr std::uint16_t zero = 0, quarter = 0x3400, half = 0x3800, one = 0x3c00;

// vertex 0 lower left, 1 right, 2 above: counter-clockwise in a y-up world.
Workbench upright(bool mirrored) {
  Workbench bench;
  bench.view.y[1] = -1;
  bench.view.y[3] = 32;
  const float corners[3][2] = {{-64, -64}, {192, -64}, {-64, 192}};
  for (const auto& c : corners) {
    VertexAttributes a = plain_attributes();
    a.uv[0][0] = (mirrored ? -c[0] : c[0]) / 256;
    a.uv[0][1] = -c[1] / 256;
    a.tangent[0] = mirrored ? -1 : 1;
    a.tangent[3] = mirrored ? -1 : 1;
    bench.add_vertex(c[0], c[1], 1, a);
  }
  bench.add_triangle(0, 1, 2);
  return bench;
}

Vector resolved(const Workbench& bench, const Kernels& kernels, int triangle = 0) {
  const GBuffer out = bench.resolve(kernels, {{std::uint32_t(triangle), pixel(9, 13), 1}});
  return {out.planes[normal][0], out.planes[normal + 1][0], out.planes[normal + 2][0]};
}

void expect_vector(Vector found, Vector expected, const std::string& what) {
  EXPECT_NEAR(found.x, expected.x, 2e-6) << what;
  EXPECT_NEAR(found.y, expected.y, 2e-6) << what;
  EXPECT_NEAR(found.z, expected.z, 2e-6) << what;
}

TEST(NormalMap, RedIsRightAndGreenIsUp) {
  for (const Kernels* kernels : runnable_kernels())
    for (const bool mirrored : {false, true})
      for (const bool tangents : {false, true}) {
        Workbench bench = upright(mirrored);
        bench.material.has_tangents = tangents;
        const std::string what =
            std::string(kernels->isa) + (mirrored ? " mirrored" : "") + (tangents ? " tangents" : "");
        const double side = mirrored ? -1 : 1;
        TextureMemory red = half_texel(one, half, one), green = half_texel(half, one, one),
                      flat = half_texel(half, half, one);
        TextureMemory left = half_texel(quarter, half, one);
        bind(bench.material.normal_texture, red);
        expect_vector(resolved(bench, *kernels), unit({side, 0, 1}), what + " red");
        bind(bench.material.normal_texture, green);
        expect_vector(resolved(bench, *kernels), unit({0, 1, 1}), what + " green");
        bind(bench.material.normal_texture, flat);
        expect_vector(resolved(bench, *kernels), {0, 0, 1}, what + " flat");
        bind(bench.material.normal_texture, left);
        bench.material.normal_scale = 3;
        expect_vector(resolved(bench, *kernels), unit({-1.5 * side, 0, 1}), what + " scaled");
      }
}

TEST(NormalMap, TheTextureTransformTurnsTheFrame) {
  for (const Kernels* kernels : runnable_kernels()) {
    Workbench bench = upright(false);
    TextureMemory red = half_texel(one, half, one), green = half_texel(half, one, one);
    bind(bench.material.normal_texture, red);
    const float quarter_turn[6] = {0, 3, 0.7f, -3, 0, 0.2f};  // u' = 3 v, v' = -3 u: u' grows downwards
    std::copy_n(quarter_turn, 6, bench.material.normal_texture.transform);
    expect_vector(resolved(bench, *kernels), unit({0, -1, 1}), "red");
    bind(bench.material.normal_texture, green);
    expect_vector(resolved(bench, *kernels), unit({1, 0, 1}), "green");
  }
}

TEST(NormalMap, BackFacesMirrorTheFront) {
  for (const Kernels* kernels : runnable_kernels())
    for (const bool tangents : {false, true}) {
      Workbench bench = upright(false);
      bench.material.has_tangents = tangents;
      bench.material.double_sided = true;
      bench.view.x[0] = -1;  // seen from behind: the picture is mirrored
      bench.view.x[3] = 32;
      TextureMemory texel = half_texel(one, 0x3a00, one);
      bind(bench.material.normal_texture, texel);
      expect_vector(resolved(bench, *kernels), unit({-1, -0.5, -1}), kernels->isa);
    }
}

TEST(NormalMap, WithoutDirectionThereIsNone) {
  for (const Kernels* kernels : runnable_kernels()) {
    Workbench bench = upright(false);
    TextureMemory red = half_texel(one, half, zero);
    bind(bench.material.normal_texture, red);
    for (VertexAttributes& a : bench.attributes) a.uv[0][0] = a.uv[0][1];  // UVs on a line
    expect_vector(resolved(bench, *kernels), {0, 0, 1}, "no area");
    bench = upright(false);
    TextureMemory none = half_texel(half, half, half);
    bind(bench.material.normal_texture, none);
    expect_vector(resolved(bench, *kernels), {0, 0, 1}, "a texel without direction");
  }
}

// Random triangles, normals and UVs against dP/du and dP/dv solved for in double.
TEST(NormalMap, FrameOfTheUvDerivatives) {
  std::mt19937 random(51);
  for (const Kernels* kernels : runnable_kernels())
    for (int k = 0; k < 300; ++k) {
      Workbench bench = upright(false);
      Vector p[3];
      double uv[3][2];
      const Vector n = unit({uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), 1});
      for (int i = 0; i < 3; ++i) {
        bench.positions[3 * i + 2] = float(uniform(random, -40, 40));
        p[i] = {bench.positions[3 * i], bench.positions[3 * i + 1], bench.positions[3 * i + 2]};
        VertexAttributes& a = bench.attributes[i];
        for (int c = 0; c < 2; ++c) uv[i][c] = a.uv[0][c] = float(uniform(random, 0, 1));
        a.normal[0] = float(n.x), a.normal[1] = float(n.y), a.normal[2] = float(n.z);
      }
      const double a = uv[1][0] - uv[0][0], b = uv[1][1] - uv[0][1], c = uv[2][0] - uv[0][0], d = uv[2][1] - uv[0][1];
      const double det = a * d - b * c;
      if (std::abs(det) < 0.02) continue;
      const Vector along_u = 1 / det * (d * (p[1] - p[0]) - b * (p[2] - p[0]));
      const Vector along_v = 1 / det * (a * (p[2] - p[0]) - c * (p[1] - p[0]));
      const Vector tangent = unit(along_u - inner(along_u, n) * n);
      const Vector upward = -1 * (along_v - inner(along_v, n) * n);
      Vector bitangent = outer(n, tangent);
      if (inner(bitangent, upward) < 0) bitangent = -1 * bitangent;  // of the two perpendiculars, the one that is up
      TextureMemory texel = half_texel(quarter, one, one);
      bind(bench.material.normal_texture, texel);
      const Vector expected = unit(-0.5 * tangent + bitangent + n);
      const Vector found = resolved(bench, *kernels);
      EXPECT_NEAR(found.x, expected.x, 1e-5);
      EXPECT_NEAR(found.y, expected.y, 1e-5);
      EXPECT_NEAR(found.z, expected.z, 1e-5);
    }
}

}  // namespace
}  // namespace tessera::resolve_test

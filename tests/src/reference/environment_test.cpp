#include "reference/environment_shade.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/albedo.hpp"
#include "reference/fresnel.hpp"
#include "reference/microfacet.hpp"
#include "reference/random.hpp"

namespace tessera::reference {
namespace {

constexpr double pi = std::numbers::pi;

SpherePicture sky(int width) {
  SpherePicture picture{width, width / 2, {}, false};
  for (int j = 0; j < width / 2; ++j)
    for (int i = 0; i < width; ++i) {
      const bool sun = i > width / 5 && i < width / 5 + 4 && j > 10 && j < 14;
      for (int c = 0; c < 3; ++c)
        picture.rgb.push_back(sun ? 200.0f : 0.2f + 0.1f * float(c) + float(j) / float(width));
    }
  return picture;
}

// OpenEXR's and Tessera's maps differ by a quarter turn; this is Tessera's: the centre of the map is +X, up is +Y.
TEST(EnvironmentMap, DirectionsAreThoseOfThePicture) {
  SpherePicture picture{64, 32, std::vector<float>(64 * 32 * 3), false};
  picture.rgb[(8 * 64 + 48) * 3] = 1;
  const double theta = pi * 8.5 / 32, phi = 2 * pi * (48.5 / 64 - 0.5);
  const Vec3 d{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
  EXPECT_NEAR(EnvironmentMap(picture, 0).radiance(d).x, 1, 1e-9);
  const double turn = 0.6;
  const Vec3 turned{d.x * std::cos(turn) + d.z * std::sin(turn), d.y, d.z * std::cos(turn) - d.x * std::sin(turn)};
  EXPECT_NEAR(EnvironmentMap(picture, turn).radiance(turned).x, 1, 1e-9);

  SpherePicture faces{8, 48, std::vector<float>(8 * 48 * 3), true};
  faces.rgb[((2 * 8 + 1) * 8 + 6) * 3 + 1] = 3;  // +Y at s = 5/8, t = -5/8: x = s, z = t
  EXPECT_NEAR(EnvironmentMap(faces, 0).radiance(normalize({5.0 / 8, 1, -5.0 / 8})).y, 3, 1e-9);
}

TEST(EnvironmentMap, SamplesFollowTheirDensity) {
  const EnvironmentMap map(sky(128), 0.3);
  Random random(4);
  double inverse = 0, light = 0, expected = 0;
  constexpr int count = 200000;
  for (int k = 0; k < count; ++k) {
    const double u = random.uniform(), v = random.uniform();
    const auto sample = map.sample(u, v);
    ASSERT_NEAR(length(sample.direction), 1, 1e-9);
    ASSERT_NEAR(map.density(sample.direction) / sample.density, 1, 0.9);  // but for samples on a cell's edge
    inverse += 1 / sample.density / count;
    light += map.radiance(sample.direction).x / sample.density / count;
    const double y = 1 - 2 * random.uniform(), phi = 2 * pi * random.uniform(), s = std::sqrt(1 - y * y);
    expected += 4 * pi * map.radiance({s * std::cos(phi), y, s * std::sin(phi)}).x / count;
  }
  EXPECT_NEAR(inverse / (4 * pi), 1, 0.02);
  EXPECT_NEAR(light / expected, 1, 0.1);  // uniform directions rarely meet the sun
}

// A white metal in a white furnace loses nothing; a white dielectric neither.
TEST(IntegrateEnvironment, WhiteFurnace) {
  const EnvironmentMap white({4, 2, std::vector<float>(24, 1.0f), false}, 0);
  const EnergyTable table;
  for (const double metallic : {0.0, 1.0})
    for (const double r : {0.0, 0.1, 0.4, 1.0})
      for (const double mu : {0.1, 0.5, 1.0}) {
        ShadeSurface s;
        s.normal = {0, 1, 0};
        s.base_color = {1, 1, 1};
        s.metallic = metallic;
        s.roughness = r;
        const auto e = integrate_environment(s, {std::sqrt(1 - mu * mu), mu, 0}, white, table, 4000, 7);
        EXPECT_NEAR(e.mean.x, 1, 4 * e.error.x + 3e-3) << metallic << " " << r << " " << mu;
      }
}

// Against a sum over all directions.
TEST(IntegrateEnvironment, MatchesBruteForce) {
  const EnvironmentMap map(sky(64), 0);
  const EnergyTable table;
  for (const double r : {0.35, 0.8})
    for (const double mu : {0.2, 0.8}) {
      ShadeSurface s;
      s.normal = normalize({0.2, 1, 0.1});
      s.base_color = {0.7, 0.5, 0.2};
      s.metallic = 1;
      s.roughness = r;
      s.occlusion = 0.5;
      const Vec3 t = normalize(cross(s.normal, {0, 0, 1})), b = cross(s.normal, t);
      const Vec3 v = s.normal * mu + t * std::sqrt(1 - mu * mu), local{std::sqrt(1 - mu * mu), 0, mu};
      const double alpha = r * r, lost = 1 - directional_albedo(mu, alpha).E(), all = 1 - average_albedo(alpha);
      const double favg = 0.5 + 0.5 / 21;  // green
      double sum = 0;
      constexpr int rings = 300, spokes = 600;
      for (int j = 0; j < rings; ++j)
        for (int i = 0; i < spokes; ++i) {
          const double z = (j + 0.5) / rings, phi = 2 * pi * (i + 0.5) / spokes, q = std::sqrt(1 - z * z);
          const Vec3 l{q * std::cos(phi), q * std::sin(phi), z};
          const double F = fresnel_schlick(0.5, dot(normalize(l + local), local));
          const double single = F * specular_brdf_over_fresnel(local, l, alpha);
          const double multiple = table.loss(z, r) * lost / (pi * all) * favg * favg * (1 - all) / (1 - favg * all);
          sum += (single + multiple) * z * map.radiance(t * l.x + b * l.y + s.normal * z).y * 2 * pi / (rings * spokes);
        }
      const auto e = integrate_environment(s, v, map, table, 20000, 3);
      EXPECT_NEAR(e.mean.y, 0.5 * sum, 4 * e.error.y + 2e-3 * sum) << r << " " << mu;
      EXPECT_LT(e.error.y, 0.02 * sum);
      // The error tells the truth: another seed differs by about as much.
      const auto other = integrate_environment(s, v, map, table, 20000, 4);
      EXPECT_LT(std::abs(e.mean.y - other.mean.y), 5 * (e.error.y + other.error.y));
      EXPECT_NE(e.mean.y, other.mean.y);
    }
}

}  // namespace
}  // namespace tessera::reference

// The default shading path where its formulas are known to be in danger: what happens there is asserted, not hoped for.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "kernels/shade/shade_scene.hpp"
#include "reference/microfacet.hpp"

namespace tessera::test {
namespace {

using reference::Vec3;

LightView directional(const Vec3& towards) {
  LightView light{};
  light.type = LightType::directional;
  light.direction[0] = -float(towards.x), light.direction[1] = -float(towards.y),
  light.direction[2] = -float(towards.z);
  light.color[0] = light.color[1] = light.color[2] = 1;
  return light;
}

reference::ShadeSurface metal(double roughness) {
  reference::ShadeSurface s;
  s.normal = {0, 0, 1};
  s.base_color = {1, 0.7, 0.2};
  s.metallic = 1;
  s.roughness = roughness;
  return s;
}

// One surface, one light, eye in direction v: red radiance on every instruction set, which must agree.
float shade_one(const reference::ShadeSurface& surface, const Vec3& v, const LightView& light) {
  GBuffer gbuffer(1);
  gbuffer.set(0, surface);
  ShadeArgs args = shade_args(gbuffer, v, {}, nullptr);
  args.eye[3] = 0;
  args.lights = &light;
  args.light_count = 1;
  float first = -1;
  for (const Kernels* kernels : runnable_kernels()) {
    kernels->shade(args);
    const float result = gbuffer.radiance()[0][0];
    if (first == -1) first = result;
    EXPECT_EQ(first, result) << kernels->isa;
  }
  EXPECT_TRUE(std::isfinite(first) && first >= 0) << first;
  return first;
}

Vec3 tilted(double theta, double phi = 0) { return reference::from_angles(theta, phi); }

// The sharpest highlight the path makes, within and beyond the lobe. What is left is the rounding of l and v, an angle
// of 1e-7 beside alpha = 2e-3.
TEST(Stability, SharpHighlightsKeepTheirShape) {
  for (const double r : {0.0, 0.03, 0.045, 0.06, 0.1})
    for (const double theta : {0.0, 0.3, 1.0, 1.4})
      for (const double offset : {0.0, 1e-5, 1e-4, 1e-3, 2e-3, 5e-3, 0.02, 0.1}) {
        const Vec3 v = tilted(theta), l = tilted(theta + offset, std::acos(-1.0));
        const Vec3 vf = {float(v.x), float(v.y), float(v.z)}, lf = {float(l.x), float(l.y), float(l.z)};
        reference::ShadeLight light;
        light.type = reference::ShadeLight::Type::directional;
        light.direction = lf * -1;
        light.color = {1, 1, 1};
        const double expected = reference::shade(metal(r), vf * 1e6, {light}, {}).x;
        EXPECT_NEAR(shade_one(metal(r), vf, directional(lf)) / expected, 1, 3e-4) << r << ' ' << theta << ' ' << offset;
      }
}

TEST(Stability, RoughnessBelowTheFloorIsTheFloor) {
  const Vec3 v = tilted(0.5), l = tilted(0.501, std::acos(-1.0));
  const float floor = shade_one(metal(0.045f), v, directional(l));
  for (const double r : {0.0, -0.0, 1e-40, 0.01, 0.044}) EXPECT_EQ(shade_one(metal(r), v, directional(l)), floor);
}

// Steps of one ulp across every branch and clamp: neighbours differ by rounding only.
TEST(Stability, ContinuousAcrossBranches) {
  const auto expect_continuous = [](const char* what, float start, const std::function<float(float)>& f) {
    float x = start;
    for (int k = 0; k < 8; ++k) x = std::nextafter(x, -10.0f);
    float previous = f(x);
    for (int k = 0; k < 16; ++k) {
      x = std::nextafter(x, 10.0f);
      const float value = f(x);
      EXPECT_NEAR(value, previous, 1e-4 * std::abs(previous) + 1e-7) << what << ' ' << x;
      previous = value;
    }
  };
  const Vec3 v = tilted(0.4), l = tilted(0.4, 3.0);
  expect_continuous("roughness floor", 0.045f, [&](float r) { return shade_one(metal(r), v, directional(l)); });
  expect_continuous("roughness 1", 1, [&](float r) { return shade_one(metal(r), v, directional(l)); });
  expect_continuous("metallic 0", 0, [&](float m) {
    auto s = metal(0.3);
    s.metallic = m;
    return shade_one(s, v, directional(l));
  });
  // n.v through its clamp at 1e-4 and through 0.
  for (const float start : {1e-4f, 1e-30f})
    expect_continuous("NoV", start, [&](float z) {
      return shade_one(metal(0.3), {1, 0, z}, directional({-0.8, 0, 0.6}));
    });
  // n.l through 0: light comes up without a jump.
  expect_continuous("NoL", 1e-30f, [&](float z) { return shade_one(metal(0.3), v, directional({-1, 0, z})); });
  // n.h through 0: eye below the shading horizon, light above it.
  expect_continuous("NoH", 0.5f, [&](float z) {
    return shade_one(metal(0.9), {0.8660254, 0, -0.5}, directional({0, std::sqrt(1 - double(z) * z), z}));
  });
  const auto at_distance = [&](LightType type, Falloff falloff, float d) {
    LightView light = directional({0, 0, 1});
    light.type = type;
    light.falloff = falloff;
    light.position[2] = d;
    light.inverse_range_squared = 0.25f;
    return shade_one(metal(0.5), v, light);
  };
  for (const Falloff falloff : {Falloff::inverse_square, Falloff::windowed_plus_one}) {
    expect_continuous("range", 2, [&](float d) { return at_distance(LightType::point, falloff, d); });
    expect_continuous("distance guard", 1e-6f, [&](float d) { return at_distance(LightType::point, falloff, d); });
  }
}

// l = -v: the half vector vanishes. Only an eye behind the surface sees this.
TEST(Stability, LightOppositeToTheEye) {
  for (const double theta : {0.0, 0.7, 1.5, 1.5707})
    for (const double r : {0.0, 0.3, 1.0}) {
      const Vec3 l = tilted(theta), v = l * -1;
      shade_one(metal(r), v, directional(l));
      // and close to it
      for (const double epsilon : {1e-7, 1e-6, 1e-4, 1e-2})
        shade_one(metal(r), reference::normalize(v + Vec3{epsilon, epsilon, 0}), directional(l));
    }
}

TEST(Stability, GrazingEyeAndLight) {
  for (const double NoV : {0.0, 1e-30, 1e-8, 1e-4, 1e-2})
    for (const double NoL : {1e-38, 1e-8, 1e-4, 1e-2})
      for (const double r : {0.0, 0.1, 1.0})
        for (const double side : {-1.0, 1.0}) shade_one(metal(r), {1, 0, NoV}, directional({side, 0, NoL}));
}

TEST(Stability, DegenerateNormals) {
  const Environment white = Environment::constant(1);
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const double values[] = {0, -0.0, 1e-45, 1e-20, 1e20, infinity, -infinity, nan};
  GBuffer gbuffer(8 * 8 * 8);
  for (int i = 0; i < 512; ++i) {
    auto s = metal(0.3);
    s.normal = {values[i % 8], values[i / 8 % 8], values[i / 64]};
    gbuffer.set(i, s);
  }
  const std::vector<LightView> lights = {directional({0, 0, 1}), directional({0.6, 0, -0.8})};
  for (const Kernels* kernels : runnable_kernels()) {
    kernels->clamp_surfaces(gbuffer.view(), 512);
    kernels->shade(shade_args(gbuffer, {0, 0, 5}, lights, &white));
    for (int i = 0; i < 512; ++i) {
      const float x = gbuffer.radiance()[0][i];
      EXPECT_TRUE(std::isfinite(x) && x >= 0) << kernels->isa << ' ' << i;
    }
    // A zero normal faces nothing: no punctual light.
    kernels->shade(shade_args(gbuffer, {0, 0, 5}, lights, nullptr));
    EXPECT_EQ(gbuffer.radiance()[0][0], 0) << kernels->isa;
  }
}

TEST(Stability, LightsAtThePointHugeAndTiny) {
  for (const LightType type : {LightType::point, LightType::spot})
    for (const Falloff falloff : {Falloff::inverse_square, Falloff::windowed_plus_one})
      for (const float color : {1e-45f, 1e-30f, 1.0f, 1e30f, 3e38f})
        for (const float d : {0.0f, 1e-45f, 1e-20f, 1e-6f, 1.0f, 1e6f, 1e12f})
          for (const float inverse_range_squared : {0.0f, 1e-38f, 1.0f, 1e38f}) {
            LightView light = directional({0, 0, 1});
            light.type = type;
            light.falloff = falloff;
            light.position[2] = d;
            light.color[0] = color;
            light.inverse_range_squared = inverse_range_squared;
            light.spot_scale = 1e6f, light.spot_offset = -0.9e6f;
            shade_one(metal(0), tilted(0.001), light);
          }
}

// The eye at the very point: no direction, but a result.
TEST(Stability, EyeAtThePoint) {
  const Environment white = Environment::constant(1);
  GBuffer gbuffer(1);
  gbuffer.set(0, metal(0.5));
  for (const Kernels* kernels : runnable_kernels()) {
    kernels->shade(shade_args(gbuffer, {0, 0, 0}, {directional({0, 0, 1})}, &white));
    EXPECT_TRUE(std::isfinite(gbuffer.radiance()[0][0])) << kernels->isa;
  }
}

// Black and white: F0 = 0 cannot occur (dielectrics have 0.04) but for a black metal, which only reflects at grazing.
TEST(Stability, ExtremeReflectance) {
  auto black = metal(0.5);
  black.base_color = {0, 0, 0};
  EXPECT_LT(shade_one(black, {0, 0, 1}, directional({0, 0, 1})), 1e-6);
  EXPECT_GT(shade_one(black, tilted(1.5), directional(tilted(1.5, std::acos(-1.0)))), 0.01);
}

// alpha -> 0 of D alone: no cap, no overflow down to 1e-18, nothing at all for a perfect mirror.
TEST(Stability, DistributionOfNearMirrors) {
  const std::vector<float> alpha = {1.0f, 1e-2f, 1e-4f, 1e-8f, 1e-12f, 1e-18f, 1e-30f, 0.0f};
  const std::vector<float> one(alpha.size(), 1.0f), zero(alpha.size(), 0.0f);
  for (const Kernels* kernels : runnable_kernels()) {
    const auto peak = evaluate_term(*kernels, "D_GGX", {&one, &zero, &alpha});
    for (std::size_t k = 0; k < alpha.size(); ++k) EXPECT_TRUE(std::isfinite(peak[k]) && peak[k] >= 0) << alpha[k];
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(peak[k] / reference::ggx_distribution(0.0, alpha[k]), 1, 1e-6) << alpha[k];
    EXPECT_EQ(peak.back(), 0);
    const auto horizon = evaluate_term(*kernels, "D_GGX", {&zero, &one, &alpha});
    for (std::size_t k = 0; k < alpha.size(); ++k) EXPECT_TRUE(std::isfinite(horizon[k]) && horizon[k] >= 0);
  }
}

}  // namespace
}  // namespace tessera::test

#define TESSERA_ISA punctual_test
#include "kernels/light/punctual.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;

LightView point_light(Falloff falloff, float range) {
  LightView light{};
  light.type = LightType::point;
  light.falloff = falloff;
  light.direction[2] = -1;
  light.color[0] = light.color[1] = light.color[2] = 1;
  light.inverse_range_squared = range > 0 ? 1 / (range * range) : 0;
  return light;
}

template <class F>
struct Arriving {
  kernel::Vec3<F> l;
  F attenuation;
};

template <class F>
Arriving<F> at(const LightView& light, F x, F y, F z) {
  return kernel::with_kind(kernel::kind_of(light), [&]<kernel::LightKind kind>() -> Arriving<F> {
    const auto reach = kernel::light_reach<kind>(light, kernel::Vec3<F>{x, y, z});
    const auto in = kernel::incident_light<kind>(light, reach);
    return {reach.d * in.inverse_length, in.strength / in.divisor};
  });
}

TEST(PunctualLight, DirectionalIsTheSameEverywhere) {
  LightView light{};
  light.type = LightType::directional;
  light.direction[1] = -1;
  const auto in = at(light, 3.0, -2.0, 1e9);
  EXPECT_EQ(in.l.x, 0);
  EXPECT_EQ(in.l.y, 1);
  EXPECT_EQ(in.attenuation, 1);
}

// One candela: 1/d^2 lux. No 4 pi, no 683.
TEST(PunctualLight, CandelaOverDistanceSquared) {
  const LightView light = point_light(Falloff::inverse_square, 0);
  for (const double d : {1e-5, 0.001, 0.5, 1.0, 10.0, 1e6, 1e12}) {
    const auto in = at(light, 0.0, 0.0, -d);
    EXPECT_NEAR(in.attenuation * d * d, 1, 1e-12) << d;
    EXPECT_NEAR(in.l.z, 1, 1e-12);
    EXPECT_NEAR(at(light, 0.0f, 0.0f, -float(d)).attenuation * d * d, 1, 1e-6) << d;
  }
}

TEST(PunctualLight, RangeWindows) {
  for (const double d : {0.1, 1.0, 1.9, 1.999, 2.0, 2.5, 1000.0}) {
    const double ratio = std::pow(d / 2, 4), window = std::fmin(std::fmax(1 - ratio, 0), 1);
    EXPECT_NEAR(at(point_light(Falloff::inverse_square, 2), 0.0, d, 0.0).attenuation, window / (d * d), 1e-12);
    EXPECT_NEAR(at(point_light(Falloff::windowed_plus_one, 2), 0.0, d, 0.0).attenuation, window * window / (d * d + 1),
                1e-12);
  }
  EXPECT_EQ(at(point_light(Falloff::inverse_square, 2), 0.0f, 2.0f, 0.0f).attenuation, 0);
  EXPECT_GT(at(point_light(Falloff::inverse_square, 2), 0.0f, 1.9999f, 0.0f).attenuation, 0);
}

TEST(PunctualLight, AtThePointItselfIsFiniteAndWithoutDirection) {
  for (const Falloff falloff : {Falloff::inverse_square, Falloff::windowed_plus_one})
    for (const float d : {0.0f, 1e-45f, 1e-38f, 1e-20f, 1e-9f, 1e-7f, 1e-6f}) {
      const auto in = at(point_light(falloff, 0), d, 0.0f, 0.0f);
      EXPECT_TRUE(std::isfinite(in.attenuation)) << d;
      EXPECT_LE(in.attenuation, 1.001e12f);
      EXPECT_LE(std::fabs(in.l.x), 1.00001f);
      EXPECT_TRUE(d > 0 || in.l.x == 0);
    }
}

// Spot: full inside the inner cone, zero outside the outer, squared ramp between, in the cosine.
TEST(PunctualLight, SpotCone) {
  LightView light = point_light(Falloff::inverse_square, 0);
  light.type = LightType::spot;
  const double inner = std::cos(0.3), outer = std::cos(0.5);
  light.spot_scale = float(1 / (inner - outer));
  light.spot_offset = float(-outer / (inner - outer));
  for (const double angle : {0.0, 0.2, 0.299, 0.35, 0.4, 0.45, 0.501, 1.0, 3.14}) {
    const auto in = at(light, 2 * std::sin(angle), 0.0, -2 * std::cos(angle));
    const double ramp = std::fmin(std::fmax((std::cos(angle) - outer) / (inner - outer), 0), 1);
    EXPECT_NEAR(in.attenuation, ramp * ramp / 4, 1e-6) << angle;
  }
}

}  // namespace
}  // namespace tessera::test

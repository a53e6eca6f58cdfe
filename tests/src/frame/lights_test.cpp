#include "frame/lights.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "frame/dispatch.hpp"

namespace tessera {
namespace {

Light light(LightType type, float intensity, float range) {
  Light l;
  l.type = type;
  l.intensity = intensity;
  l.range = range;
  l.color[0] = 0.5f;
  l.color[1] = 1;
  l.color[2] = 0.25f;
  return l;
}

double range_of(const LightView& view) { return 1 / std::sqrt(double(view.inverse_range_squared)); }

TEST(CompileLights, EndWhereTheStrongestChannelFallsToTheCutoff) {
  const std::vector<Light> lights = {light(LightType::point, 40, 0), light(LightType::spot, 2.5f, 0),
                                     light(LightType::point, 40, 3), light(LightType::point, 40, 1000),
                                     light(LightType::directional, 40, 0)};
  const std::vector<LightView> views = compile_lights(lights, select_kernels(), 0.1f);
  ASSERT_EQ(views.size(), 5u);
  EXPECT_NEAR(range_of(views[0]), 20, 1e-4);  // 40 / 20^2 = 0.1
  EXPECT_NEAR(range_of(views[1]), 5, 1e-5);
  EXPECT_NEAR(range_of(views[2]), 3, 1e-5);  // ends earlier by itself
  EXPECT_NEAR(range_of(views[3]), 20, 1e-4);
  EXPECT_EQ(views[4].inverse_range_squared, 0);
  EXPECT_TRUE(LightBounds(views).limited());
}

TEST(CompileLights, WithoutACutoffTheFileDecides) {
  const std::vector<LightView> views =
      compile_lights({light(LightType::point, 40, 0), light(LightType::spot, 40, 4)}, select_kernels());
  EXPECT_EQ(views[0].inverse_range_squared, 0);
  EXPECT_EQ(views[1].inverse_range_squared, 1.0f / 16);
}

TEST(CompileLights, AnyCutoffIsFinite) {
  for (const float intensity : {1e-38f, 1.0f, 1e38f})
    for (const float cutoff : {1e-38f, 1.0f, 1e6f}) {
      const std::vector<LightView> views =
          compile_lights({light(LightType::point, intensity, 0)}, select_kernels(), cutoff);
      ASSERT_EQ(views.size(), 1u);
      EXPECT_TRUE(std::isfinite(views[0].inverse_range_squared));
      EXPECT_LE(views[0].inverse_range_squared, 1e36f);
    }
}

}  // namespace
}  // namespace tessera

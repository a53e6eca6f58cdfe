#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "kernels/runnable_kernels.hpp"
#include "kernels/shade/shade_scene.hpp"

namespace tessera::test {
namespace {

using reference::Vec3;

const Vec3 eye = {0.5, 1, 4};

// Strictly positive and smooth, sharper in level 0 than above.
Vec3 sky(const Vec3& d, int level) {
  const double sharpness = 3.0 / (1 + level);
  return {1 + 0.5 * std::sin(sharpness * d.x), 0.8 + 0.7 * std::sin(sharpness * d.y + 1), 2 + std::cos(2 * d.z)};
}
constexpr double sky_sh[9][3] = {{0.9, 0.8, 1.5},  {0.3, 0.5, 0.2},     {0.1, -0.2, 0.3}, {0.2, 0.1, 0}, {0.05, 0, 0.1},
                                 {-0.1, 0.2, 0.1}, {0.04, 0.03, -0.05}, {0.1, 0, -0.1},   {0.06, 0.1, 0}};

std::vector<Vec3> reference_radiance(const GBuffer& gbuffer, const std::vector<LightView>& lights,
                                     const Environment* environment) {
  std::vector<reference::ShadeLight> reference_lights;
  for (const LightView& light : lights) reference_lights.push_back(to_reference(light));
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < gbuffer.count(); ++i)
    result.push_back(
        reference::shade(gbuffer.surface(i), eye, reference_lights,
                         environment != nullptr ? environment->reference() : reference::ShadeEnvironment{}));
  return result;
}

// Largest |kernel - reference| / (reference + 0.01) over all channels.
double largest_error(const GBuffer& gbuffer, const std::vector<Vec3>& expected) {
  double largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double e[3] = {expected[i].x, expected[i].y, expected[i].z};
    for (int c = 0; c < 3; ++c)
      largest = std::max(largest, std::abs(gbuffer.radiance()[c][i] - e[c]) / (std::abs(e[c]) + 0.01));
  }
  return largest;
}

class ShadeAgainstReference : public testing::Test {
 protected:
  ShadeAgainstReference() : gbuffer_(4001) {
    std::mt19937 random(7);
    for (std::size_t i = 0; i < gbuffer_.count(); ++i) gbuffer_.set(i, random_surface(random, eye));
  }
  GBuffer gbuffer_;
};

// What remains is the rounding of l and v into the half vector: an angle of 1e-7 beside the narrowest lobe's 2e-3.
TEST_F(ShadeAgainstReference, PunctualLights) {
  const auto lights = all_kinds_of_lights();
  const auto expected = reference_radiance(gbuffer_, lights, nullptr);
  for (const Kernels* kernels : runnable_kernels()) {
    kernels->shade(shade_args(gbuffer_, eye, lights, nullptr));
    EXPECT_LT(largest_error(gbuffer_, expected), 3e-5) << kernels->isa;
  }
}

TEST_F(ShadeAgainstReference, EachKindOfLightAlone) {
  for (const LightView& light : all_kinds_of_lights()) {
    const std::vector<LightView> lights = {light};
    const auto expected = reference_radiance(gbuffer_, lights, nullptr);
    for (const Kernels* kernels : runnable_kernels()) {
      kernels->shade(shade_args(gbuffer_, eye, lights, nullptr));
      EXPECT_LT(largest_error(gbuffer_, expected), 3e-5)
          << kernels->isa << " type " << int(light.type) << " falloff " << int(light.falloff);
    }
  }
}

// The light, and two like it from other sides.
std::vector<LightView> three_of(const LightView& light) {
  std::vector<LightView> lights = {light, light, light};
  for (int k = 1; k < 3; ++k) {
    LightView& other = lights[std::size_t(k)];
    for (float(LightView::*vector)[3] : {&LightView::position, &LightView::direction}) {
      const auto& from = light.*vector;
      const float c = k == 1 ? 0.28f : -0.8f, s = k == 1 ? 0.96f : 0.6f;
      (other.*vector)[0] = c * from[0] + s * from[2];
      (other.*vector)[2] = c * from[2] - s * from[0];
    }
    other.color[1] = float(k);
  }
  return lights;
}

// A list of one kind has a loop of its own; a light out of reach adds nothing, but its list is of several kinds.
TEST_F(ShadeAgainstReference, ThreeOfAKind) {
  for (const LightView& light : all_kinds_of_lights()) {
    const std::vector<LightView> lights = three_of(light);
    const auto expected = reference_radiance(gbuffer_, lights, nullptr);
    LightView out_of_reach = light;
    out_of_reach.type = light.type == LightType::point ? LightType::spot : LightType::point;
    out_of_reach.position[0] = 1e6f;
    out_of_reach.inverse_range_squared = 1;
    for (const Kernels* kernels : runnable_kernels()) {
      SCOPED_TRACE(std::string(kernels->isa) + " type " + std::to_string(int(light.type)) + " falloff " +
                   std::to_string(int(light.falloff)));
      kernels->shade(shade_args(gbuffer_, eye, lights, nullptr));
      EXPECT_LT(largest_error(gbuffer_, expected), 3e-5);
      std::vector<float> of_a_kind[3];
      for (int c = 0; c < 3; ++c)
        of_a_kind[c].assign(gbuffer_.radiance()[c], gbuffer_.radiance()[c] + gbuffer_.count());
      for (std::size_t place = 0; place <= lights.size(); ++place) {
        std::vector<LightView> mixed = lights;
        mixed.insert(mixed.begin() + std::ptrdiff_t(place), out_of_reach);
        kernels->shade(shade_args(gbuffer_, eye, mixed, nullptr));
        for (int c = 0; c < 3; ++c)
          EXPECT_EQ(std::memcmp(gbuffer_.radiance()[c], of_a_kind[c].data(), gbuffer_.count() * sizeof(float)), 0);
      }
    }
  }
}

TEST_F(ShadeAgainstReference, Environment) {
  const Environment environment(16, 5, sky, sky_sh);
  const auto expected = reference_radiance(gbuffer_, {}, &environment);
  for (const Kernels* kernels : runnable_kernels()) {
    kernels->shade(shade_args(gbuffer_, eye, {}, &environment));
    EXPECT_LT(largest_error(gbuffer_, expected), 3e-6) << kernels->isa;
  }
}

TEST_F(ShadeAgainstReference, Everything) {
  const Environment environment(16, 5, sky, sky_sh);
  const auto lights = all_kinds_of_lights();
  const auto expected = reference_radiance(gbuffer_, lights, &environment);
  for (const Kernels* kernels : runnable_kernels()) {
    kernels->shade(shade_args(gbuffer_, eye, lights, &environment));
    EXPECT_LT(largest_error(gbuffer_, expected), 3e-5) << kernels->isa;
  }
}

}  // namespace
}  // namespace tessera::test

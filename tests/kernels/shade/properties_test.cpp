// What must hold for the shading kernel whatever its formulas: the same bits from every instance and instruction set,
// energy, reciprocity.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "kernels/runnable_kernels.hpp"
#include "kernels/shade/shade_scene.hpp"
#include "reference/quadrature.hpp"

namespace tessera::test {
namespace {

using reference::Vec3;

std::vector<float> radiance_of(const GBuffer& gbuffer) {
  std::vector<float> all;
  for (int c = 0; c < 3; ++c) all.insert(all.end(), gbuffer.radiance()[c], gbuffer.radiance()[c] + gbuffer.count());
  return all;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

Environment gradient_environment() {
  const double sh[9][3] = {{1, 0.9, 0.8}, {0.4, 0.3, 0.5}, {0.1, 0.2, -0.1}, {0, -0.2, 0.1}};
  return {16, 5,
          [](const Vec3& d, int level) {
            return Vec3{1.5 + d.x, 1.2 + d.y, 2.0 / (1 + level) + d.z * d.z};
          },
          sh};
}

// Every set of features that covers what the fragments use gives the same bits.
TEST(ShadeFeatures, DoNotChangeTheResult) {
  const Vec3 eye = {0, 1, 4};
  const Environment environment = gradient_environment();
  const auto lights = all_kinds_of_lights();
  for (std::uint32_t used = 0; used <= feature_all; ++used) {
    GBuffer gbuffer(500);
    std::mt19937 random(used);
    for (std::size_t i = 0; i < gbuffer.count(); ++i) {
      auto surface = random_surface(random, eye);
      if (!(used & feature_emissive)) surface.emissive = {};
      surface.unlit = surface.unlit && used & feature_unlit;
      gbuffer.set(i, surface);
    }
    for (const Kernels* kernels : runnable_kernels()) {
      std::vector<float> first;
      for (std::uint32_t features = 0; features <= feature_all; ++features) {
        if ((features & used) != used) continue;
        ShadeArgs args = shade_args(gbuffer, eye, used & feature_lights ? lights : std::vector<LightView>{},
                                    used & feature_environment ? &environment : nullptr);
        args.lights = lights.data();
        args.features = features;
        kernels->shade(args);
        const auto result = radiance_of(gbuffer);
        if (first.empty()) first = result;
        ASSERT_TRUE(same_bits(first, result)) << kernels->isa << " used " << used << " features " << features;
      }
    }
  }
}

// A film's pixels are the radiance that the planes would have held, whether its rows lie on cache lines or not.
TEST(ShadeFilm, HoldsTheRadiance) {
  const Vec3 eye = {0, 1, 4};
  const Environment environment = gradient_environment();
  const auto lights = all_kinds_of_lights();
  std::mt19937 random(3);
  for (const std::uint32_t blocks : {1u, 3u, 4u})
    for (const std::uint32_t rows : {1u, 2u, 5u}) {
      GBuffer gbuffer(blocks * rows * 16);
      for (std::size_t i = 0; i < gbuffer.count(); ++i) gbuffer.set(i, random_surface(random, eye));
      for (const EnvironmentLobe lobe : {EnvironmentLobe::mirror, EnvironmentLobe::taps4})
        for (const std::size_t row_stride : {std::size_t{16} * blocks, std::size_t{16} * blocks + 4})
          for (const Kernels* kernels : runnable_kernels()) {
            ShadeArgs args = shade_args(gbuffer, eye, lights, &environment);
            args.environment_shading.lobe = lobe;
            kernels->shade(args);
            AlignedVector<float> film(row_stride * rows * 4 + 16, -7), expected = film;
            for (std::uint32_t i = 0; i < gbuffer.count(); ++i) {
              const std::uint32_t block = i / 16, x = block % blocks * 4 + i % 4, y = block / blocks * 4 + i % 16 / 4;
              for (std::size_t c = 0; c < 4; ++c)
                expected[y * row_stride + 4 * x + c] = c == 3 ? 1.0f : gbuffer.radiance()[c][i];
            }
            args.film = {film.data(), row_stride, blocks};
            for (float*& plane : args.radiance) plane = nullptr;
            kernels->shade(args);
            ASSERT_EQ(film, expected) << kernels->isa << ' ' << blocks << 'x' << rows << " stride " << row_stride;
          }
    }
}

// The same fragment gives the same bits in any lane, beside any neighbours.
TEST(ShadeLanes, NeighboursDoNotShow) {
  const Vec3 eye = {0, 1, 4};
  const Environment environment = gradient_environment();
  const auto lights = all_kinds_of_lights();
  GBuffer gbuffer(257), shifted(257);
  std::mt19937 random(5);
  for (std::size_t i = 0; i < gbuffer.count(); ++i) {
    const auto surface = random_surface(random, eye);
    gbuffer.set(i, surface);
    shifted.set((i + 37) % gbuffer.count(), surface);
  }
  for (const Kernels* kernels : runnable_kernels()) {
    kernels->shade(shade_args(gbuffer, eye, lights, &environment));
    kernels->shade(shade_args(shifted, eye, lights, &environment));
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < gbuffer.count(); ++i)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(gbuffer.radiance()[c][i]),
                  std::bit_cast<std::uint32_t>(shifted.radiance()[c][(i + 37) % gbuffer.count()]));
  }
}

TEST(ClampSurfaces, PutsAnyBitsIntoRangeAndLeavesOthersAlone) {
  constexpr std::size_t count = 999, padded = 1008;
  std::mt19937 random(4);
  GBuffer gbuffer(padded), same(padded);
  const std::vector<float*> planes = gbuffer.planes(), copies = same.planes();
  std::vector<std::vector<float>> before;
  for (float* plane : planes) {
    for (std::size_t i = 0; i < padded; ++i) {
      const std::uint32_t bits = i % 3 ? random() : std::bit_cast<std::uint32_t>(float(random() % 1000) / 999);
      plane[i] = std::bit_cast<float>(bits);
    }
    plane[5] = std::numeric_limits<float>::quiet_NaN();
    plane[7] = std::numeric_limits<float>::infinity();
    plane[8] = -std::numeric_limits<float>::infinity();
    before.emplace_back(plane, plane + padded);
  }
  // As GBuffer has them: position, normal, base colour, emissive, metallic, roughness, occlusion. What follows is not
  // for shading to read, or any number will do.
  constexpr double low[] = {-1e12, -1e12, -1e12, -1, -1, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  constexpr double high[] = {1e12, 1e12, 1e12, 1, 1, 1, 1, 1, 1, 1e30, 1e30, 1e30, 1, 1, 1};
  for (const Kernels* kernels : runnable_kernels()) {
    for (std::size_t p = 0; p < planes.size(); ++p) std::copy(before[p].begin(), before[p].end(), copies[p]);
    kernels->clamp_surfaces(same.view(), count);
    for (std::size_t p = 0; p < planes.size(); ++p)
      for (std::size_t i = 0; i < padded; ++i) {
        const float x = before[p][i];
        float expected = x;
        if (p < std::size(low)) expected = x > float(low[p]) ? std::min(x, float(high[p])) : float(low[p]);
        ASSERT_EQ(std::bit_cast<std::uint32_t>(copies[p][i]), std::bit_cast<std::uint32_t>(expected))
            << kernels->isa << " plane " << p << ": " << x;
      }
  }
  GBufferView some = same.view();
  for (float*& plane : some.emissive) plane = nullptr;
  runnable_kernels().front()->clamp_surfaces(some, count);
}

// A G-buffer of arbitrary bits (a quarter of the values made special on purpose): finite, non-negative, one result.
TEST(ShadeFuzz, MillionLanesOfAnyBits) {
  constexpr std::size_t lanes = 1 << 14, rounds = 64;
  const Environment environment = gradient_environment();
  auto lights = all_kinds_of_lights();
  lights = {lights[0], lights[4], lights[7], lights[10]};  // directional, two point, spot
  const std::uint32_t special[] = {0x00000000, 0x80000000, 0x7f800000, 0xff800000, 0x7fc00000, 0xffc00001,
                                   0x7f800001, 0x00000001, 0x80000001, 0x007fffff, 0x00800000, 0x7f7fffff,
                                   0xff7fffff, 0x3f800000, 0xbf800000, 0x3f7fffff, 0x3f800001, 0x33800000};
  std::mt19937 random(1);
  GBuffer gbuffer(lanes);
  for (std::size_t round = 0; round < rounds; ++round) {
    for (float* plane : gbuffer.planes())
      for (std::size_t i = 0; i < lanes; ++i) {
        std::uint32_t bits = random();
        if (bits % 4 == 0) bits = special[(bits >> 8) % std::size(special)];
        // Half the rounds keep to magnitudes that scenes have, so that the formulas themselves are exercised.
        if (round % 2 && bits % 4 != 0) bits = (bits & 0x80ffffff) | 0x3d000000 | (bits & 0x02000000);
        std::memcpy(plane + i, &bits, sizeof bits);
      }
    std::vector<float> first;
    runnable_kernels().front()->clamp_surfaces(gbuffer.view(), gbuffer.count());
    for (const Kernels* kernels : runnable_kernels()) {
      kernels->shade(shade_args(gbuffer, {0, 1, 4}, lights, &environment));
      const auto result = radiance_of(gbuffer);
      for (const float value : result) ASSERT_TRUE(value >= 0 && value <= 1e30f) << kernels->isa << ' ' << value;
      if (first.empty()) first = result;
      ASSERT_TRUE(same_bits(first, result)) << kernels->isa << " round " << round;
    }
  }
}

// Wherever the eye is, in the surface itself too: finite, non-negative, one result.
TEST(ShadeFuzz, AnyEye) {
  const Environment environment = gradient_environment();
  const auto lights = all_kinds_of_lights();
  std::mt19937 random(3);
  GBuffer gbuffer(64);
  for (std::size_t i = 0; i < 64; ++i) gbuffer.set(i, random_surface(random, {0, 1, 4}));
  const float infinity = std::numeric_limits<float>::infinity();
  const GBufferView view = gbuffer.view();
  const float eyes[][3] = {{infinity, 0, 1},
                           {0, -infinity, infinity},
                           {std::numeric_limits<float>::quiet_NaN(), 1, 1},
                           {3e38f, 3e38f, -3e38f},
                           {view.position[0][7], view.position[1][7], view.position[2][7]},
                           {1e-30f, 1e20f, 0}};
  for (const auto& eye : eyes) {
    for (const float w : {1.0f, 0.0f}) {
      for (const EnvironmentLobe lobe : {EnvironmentLobe::mirror, EnvironmentLobe::taps4, EnvironmentLobe::points8}) {
        std::vector<float> first;
        for (const Kernels* kernels : runnable_kernels()) {
          ShadeArgs args = shade_args(gbuffer, {0, 0, 0}, lights, &environment);
          std::copy_n(eye, 3, args.eye);
          args.eye[3] = w;
          args.environment_shading.lobe = lobe;
          kernels->shade(args);
          const auto result = radiance_of(gbuffer);
          for (const float value : result) ASSERT_TRUE(value >= 0 && value <= 1e30f) << kernels->isa << ' ' << value;
          if (first.empty()) first = result;
          ASSERT_TRUE(same_bits(first, result)) << kernels->isa << ' ' << eye[0] << ' ' << eye[1] << ' ' << eye[2];
        }
      }
    }
  }
}

// White furnace: radiance 1 from everywhere. A white metal and a white dielectric give back exactly what arrives; what
// is between them never more.
TEST(ShadeFurnace, Environment) {
  const Environment white = Environment::constant(1);
  GBuffer gbuffer(33 * 33);
  for (const double metallic : {0.0, 0.25, 0.5, 0.75, 1.0})
    for (const double base : {0.0, 0.5, 1.0}) {
      for (int i = 0; i < 33 * 33; ++i) {
        reference::ShadeSurface s;
        const double mu = 0.001 + 0.999 * (i % 33) / 32;
        s.normal = {std::sqrt(1 - mu * mu), 0, mu};
        s.base_color = {base, base, base};
        s.metallic = metallic;
        s.roughness = double(i / 33) / 32;
        gbuffer.set(i, s);
      }
      for (const Kernels* kernels : runnable_kernels()) {
        ShadeArgs args = shade_args(gbuffer, {0, 0, 1}, {}, &white);
        args.eye[3] = 0;
        kernels->shade(args);
        const float* out = gbuffer.radiance()[0];
        const float highest = *std::max_element(out, out + gbuffer.count());
        const float lowest = *std::min_element(out, out + gbuffer.count());
        EXPECT_LE(highest, 1 + 1e-6) << kernels->isa << " metallic " << metallic << " base " << base;
        const bool lossless = base == 1 && (metallic == 0 || metallic == 1);
        EXPECT_GE(lowest, lossless ? 1 - 1e-6 : 0) << kernels->isa;
      }
    }
}

// A hemisphere of directional lights: the light loop's lobe must integrate to the albedo that quadrature over
// microfacets gives, which is also what the environment's table holds. (A white metal loses the light of further
// bounces here.)
TEST(ShadeFurnace, PunctualLobeIntegratesToItsAlbedo) {
  constexpr int rings = 48, spokes = 96;
  const auto& rule = reference::gauss_legendre(rings);
  std::vector<LightView> hemisphere;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < spokes; ++j) {
      const double z = rule.nodes[i], phi = 2 * std::numbers::pi * (j + 0.5) / spokes, s = std::sqrt(1 - z * z);
      LightView light{};
      light.type = LightType::directional;
      light.direction[0] = float(-s * std::cos(phi));
      light.direction[1] = float(-s * std::sin(phi));
      light.direction[2] = float(-z);
      light.color[0] = light.color[1] = light.color[2] = float(2 * std::numbers::pi / spokes * rule.weights[i]);
      hemisphere.push_back(light);
    }
  GBuffer gbuffer(9);
  for (int i = 0; i < 9; ++i) {
    const double roughness[] = {0.6, 0.8, 1.0}, cosines[] = {0.2, 0.6, 1.0};
    const double r = roughness[i / 3], mu = cosines[i % 3];
    reference::ShadeSurface s;
    s.normal = {0, 0, 1};
    s.position = {-std::sqrt(1 - mu * mu), 0, -mu};
    s.base_color = {1, 0.5, 0};
    s.metallic = 1;
    s.roughness = r;
    gbuffer.set(i, s);
  }
  for (const Kernels* kernels : runnable_kernels()) {
    kernels->shade(shade_args(gbuffer, {0, 0, 0}, hemisphere, nullptr));
    for (int i = 0; i < 9; ++i) {
      const double roughness[] = {0.6, 0.8, 1.0}, cosines[] = {0.2, 0.6, 1.0};
      const auto albedo = reference::directional_albedo(cosines[i % 3], std::pow(roughness[i / 3], 2));
      EXPECT_NEAR(gbuffer.radiance()[0][i], albedo.E(), 2e-4) << kernels->isa << ' ' << i;
      EXPECT_NEAR(gbuffer.radiance()[1][i], 0.5 * albedo.A + albedo.B, 2e-4) << kernels->isa << ' ' << i;
      EXPECT_NEAR(gbuffer.radiance()[2][i], albedo.B, 2e-4) << kernels->isa << ' ' << i;
    }
  }
}

// Helmholtz: eye and light change places. Holds for every part of the punctual BRDF, (1 - F) Lambert with F(v.h)
// included. (The environment's terms depend on n.v alone and are not reciprocal.)
TEST(ShadeReciprocity, PunctualBrdf) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  GBuffer gbuffer(16);
  for (int trial = 0; trial < 400; ++trial) {
    const auto upper = [&] {
      const double cosine = 0.02 + 0.98 * unit(random);
      return reference::from_angles(std::acos(cosine), 6.283 * unit(random));
    };
    const Vec3 v = upper(), l = upper();
    for (std::size_t i = 0; i < gbuffer.count(); ++i) {
      auto s = random_surface(random, {0, 0, 3});
      s.normal = {0, 0, 1};
      s.emissive = {};
      s.unlit = false;
      gbuffer.set(i, s);
    }
    const auto shade_along = [&](const Kernels& kernels, const Vec3& from, const Vec3& to) {
      LightView light{};
      light.type = LightType::directional;
      light.direction[0] = float(-from.x), light.direction[1] = float(-from.y), light.direction[2] = float(-from.z);
      light.color[0] = light.color[1] = light.color[2] = 1;
      ShadeArgs args = shade_args(gbuffer, to, {}, nullptr);
      args.eye[3] = 0;
      args.lights = &light;
      args.light_count = 1;
      kernels.shade(args);
      auto result = radiance_of(gbuffer);
      for (float& value : result) value /= float(from.z);
      return result;
    };
    for (const Kernels* kernels : runnable_kernels()) {
      const auto forth = shade_along(*kernels, l, v), back = shade_along(*kernels, v, l);
      for (std::size_t i = 0; i < forth.size(); ++i) ASSERT_NEAR(forth[i] / back[i], 1, 2e-4) << kernels->isa;
    }
  }
}

}  // namespace
}  // namespace tessera::test

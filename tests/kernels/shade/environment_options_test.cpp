// How the environment can be looked up: the lobes against the integral that they stand for, the two Fresnel forms,
// specular occlusion, the cube of irradiance; what cheaper forms of the tables change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/runnable_kernels.hpp"
#include "kernels/shade/shade_scene.hpp"
#include "reference/albedo.hpp"
#include "reference/microfacet.hpp"
#include "reference/quadrature.hpp"

namespace tessera::test {
namespace {

using reference::Vec3;

constexpr EnvironmentLobe lobes[] = {EnvironmentLobe::mirror, EnvironmentLobe::shifted, EnvironmentLobe::taps2,
                                     EnvironmentLobe::taps4, EnvironmentLobe::points8};

double legendre(int n, double x) {
  double before = 1, now = x;
  if (n == 0) return 1;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
    before = now;
    now = next;
  }
  return now;
}

// A round lobe only dims a Legendre polynomial about an axis (Funk and Hecke): by the mean of P_n over the lobe.
double dimmed(int n, double roughness) {
  const double alpha = std::max(roughness * roughness, 1e-4);
  const auto lobe = [&](double theta) {
    return reference::ggx_distribution(theta / 2, alpha) * std::cos(theta) * std::sin(theta);
  };
  // Crowded to the axis.
  const auto mean = [&](auto f) {
    return reference::integrate([&](double x) { return f(x * x * x * std::acos(0.0)) * 3 * x * x; }, 0, 1, 32, 8);
  };
  return mean([&](double t) { return lobe(t) * legendre(n, std::cos(t)); }) / mean(lobe);
}

constexpr int degree = 6, levels = 7;
const Vec3 axis = reference::normalize({0.6, 0.3, -0.7});

// 1 + 2 P_6(axis.d), prefiltered exactly: no step of the method but the lobe's shape is inexact.
Environment banded() {
  double factors[levels];
  for (int k = 0; k < levels; ++k) factors[k] = dimmed(degree, double(k) / (levels - 1));
  const double sh[9][3] = {{1, 1, 1}};
  return {64, levels,
          [factors](const Vec3& d, int level) {
            const double L = 1 + 2 * factors[level] * legendre(degree, dot(axis, d));
            return Vec3{L, L, L};
          },
          sh};
}

// Mean of the same radiance over the true lobe, brute force over directions.
double true_mean(const Vec3& n, const Vec3& v, double alpha) {
  const Vec3 t = reference::normalize(v - n * dot(n, v)), b = cross(n, t);
  const Vec3 local{dot(v, t), 0, dot(v, n)};
  double sum = 0, weight = 0;
  constexpr int rings = 160, spokes = 320;
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < spokes; ++i) {
      const double z = (j + 0.5) / rings, phi = 2 * std::acos(-1.0) * (i + 0.5) / spokes, s = std::sqrt(1 - z * z);
      const Vec3 l{s * std::cos(phi), s * std::sin(phi), z};
      const double f = reference::specular_brdf_over_fresnel(local, l, alpha) * z;
      weight += f;
      sum += f * (1 + 2 * legendre(degree, dot(axis, t * l.x + b * l.y + n * l.z)));
    }
  return sum / weight;
}

// A grid of white metal: every view angle and roughness, from several sides.
struct Grid {
  std::vector<reference::ShadeSurface> surfaces;
  Vec3 v = {0, 0, 1};
};

Grid grazing_grid() {
  Grid grid;
  for (const double r : {0.3, 0.45, 0.6})
    for (const double mu : {0.1, 0.2, 0.35})
      for (int k = 0; k < 8; ++k) {
        const double phi = 0.7 + k * std::acos(-1.0) / 4, s = std::sqrt(1 - mu * mu);
        reference::ShadeSurface surface;
        surface.normal = {s * std::cos(phi), s * std::sin(phi), mu};
        surface.base_color = {1, 1, 1};
        surface.metallic = 1;
        surface.roughness = r;
        grid.surfaces.push_back(surface);
      }
  return grid;
}

std::vector<float> shaded(const Kernels& kernels, const Grid& grid, const Environment& environment,
                          const EnvironmentShading& shading, const CubeView* specular = nullptr) {
  GBuffer gbuffer(grid.surfaces.size());
  for (std::size_t i = 0; i < grid.surfaces.size(); ++i) gbuffer.set(i, grid.surfaces[i]);
  ShadeArgs args = shade_args(gbuffer, grid.v, {}, &environment);
  args.eye[3] = 0;
  args.environment_shading = shading;
  if (specular != nullptr) args.environment.specular = *specular;
  kernels.shade(args);
  return {gbuffer.radiance()[0], gbuffer.radiance()[0] + grid.surfaces.size()};
}

double mean_error(EnvironmentLobe lobe) {
  static const Grid grid = grazing_grid();
  static const Environment environment = banded();
  static const std::vector<double> truth = [] {
    std::vector<double> values;
    for (const reference::ShadeSurface& s : grid.surfaces) {
      const double alpha = s.roughness * s.roughness;
      // F0 = 1: single scattering E, the rest by irradiance, which is 1.
      const double E = reference::directional_albedo(dot(s.normal, grid.v), alpha, 48).E();
      values.push_back(E * true_mean(s.normal, grid.v, alpha) + 1 - E);
    }
    return values;
  }();
  EnvironmentShading shading;
  shading.lobe = lobe;
  const std::vector<float> found = shaded(*runnable_kernels().back(), grid, environment, shading);
  double sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i) sum += std::abs(double(found[i]) - truth[i]);
  return sum / double(found.size());
}

TEST(EnvironmentLobe, StretchedLobesHalveTheErrorAtGrazingAngles) {
  const double mirror = mean_error(EnvironmentLobe::mirror);
  EXPECT_GT(mirror, 0.08);
  EXPECT_LT(mean_error(EnvironmentLobe::shifted), mirror);
  EXPECT_LT(mean_error(EnvironmentLobe::taps2), 0.5 * mirror);
  EXPECT_LT(mean_error(EnvironmentLobe::taps4), 0.4 * mirror);
  EXPECT_LT(mean_error(EnvironmentLobe::points8), 0.5 * mirror);
}

// Every lobe is a mean: of constant radiance, that radiance; seen along the normal, nearly the round lobe.
TEST(EnvironmentLobe, ConstantStaysConstant) {
  const Environment environment = Environment::constant(2);
  Grid grid;
  for (int i = 0; i < 33 * 33; ++i) {
    const double mu = 0.001 + 0.999 * (i % 33) / 32;
    reference::ShadeSurface s;
    s.normal = {std::sqrt(1 - mu * mu), 0, mu};
    s.base_color = {1, 1, 1};
    s.metallic = 1;
    s.roughness = double(i / 33) / 32;
    grid.surfaces.push_back(s);
  }
  for (const EnvironmentLobe lobe : lobes) {
    EnvironmentShading shading;
    shading.lobe = lobe;
    for (const float value : shaded(*runnable_kernels().back(), grid, environment, shading))
      ASSERT_NEAR(value, 2, 1e-5) << int(lobe);
  }
}

TEST(EnvironmentLobe, SameBitsOnEveryInstructionSet) {
  const Grid grid = grazing_grid();
  const Environment environment = banded();
  for (const EnvironmentLobe lobe : lobes)
    for (const bool occlusion : {false, true}) {
      const EnvironmentShading shading{lobe, EnvironmentFresnel::f0, occlusion};
      const std::vector<float> expected = shaded(*runnable_kernels().front(), grid, environment, shading);
      for (const Kernels* kernels : runnable_kernels())
        EXPECT_EQ(shaded(*kernels, grid, environment, shading), expected) << kernels->isa << " " << int(lobe);
    }
}

// A cube of halves again with nine bits a channel and one exponent: the smallest that the largest channel fits under.
std::vector<std::uint16_t> packed(const CubeView& cube) {
  const std::size_t count = cube_texel_count(cube.size, cube.levels);
  std::vector<std::uint16_t> out;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t* half = cube.texels + 4 * i;
    double c[3];
    for (int k = 0; k < 3; ++k) c[k] = std::ldexp(1024 + half[k] % 1024, half[k] / 1024 - 25);  // normal ones
    int exponent = 1;
    while (std::round(std::ldexp(std::max({c[0], c[1], c[2]}), 24 - exponent)) > 511) ++exponent;
    std::uint32_t word = std::uint32_t(exponent) << 27;
    for (int k = 0; k < 3; ++k) word |= std::uint32_t(std::round(std::ldexp(c[k], 24 - exponent))) << 9 * k;
    out.push_back(std::uint16_t(word & 0xffff));
    out.push_back(std::uint16_t(word >> 16));
  }
  return out;
}

TEST(EnvironmentTexels, NineBitsAreAsNearAsTheyCanBe) {
  const Grid grid = grazing_grid();
  const Environment environment = banded();  // grey: a texel is within 2^-9 of itself
  const std::vector<std::uint16_t> texels = packed(environment.view().specular);
  const CubeView cube{texels.data(), 64, levels, CubeFormat::rgb9_e5};
  for (const EnvironmentLobe lobe : lobes) {
    const EnvironmentShading shading{lobe, EnvironmentFresnel::roughness, false};
    const std::vector<float> halves = shaded(*runnable_kernels().back(), grid, environment, shading);
    std::size_t differ = 0;
    for (const Kernels* kernels : runnable_kernels()) {
      const std::vector<float> found = shaded(*kernels, grid, environment, shading, &cube);
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i], halves[i], halves[i] * 0x1p-9f) << kernels->isa << " " << int(lobe);
        differ += found[i] != halves[i];
      }
      EXPECT_EQ(found, shaded(*runnable_kernels().front(), grid, environment, shading, &cube)) << kernels->isa;
    }
    EXPECT_GT(differ, grid.surfaces.size() / 2);
  }
}

// White metal under radiance 1 reflects what is scattered once, f0 A + B = A + B, and the rest by the same radiance: so
// grey metal is looked at. Against the albedo in double, at the bounds that dfg_fit.hpp states.
TEST(EnvironmentAlbedoForm, FitsAreWithinTheirBounds) {
  const Environment environment = Environment::constant(1);
  Grid grid;
  for (const double r : {0.05, 0.1, 0.25, 0.5, 0.75, 1.0})
    for (const double mu : {0.02, 0.1, 0.3, 0.6, 0.99}) {
      reference::ShadeSurface s;
      s.normal = {std::sqrt(1 - mu * mu), 0, mu};
      s.base_color = {0.5, 0.5, 0.5};
      s.roughness = r;
      s.metallic = 1;
      grid.surfaces.push_back(s);
    }
  const auto reflected = [](double A, double B) {
    const double F = 0.5 * A + B, lost = 1 - A - B, average = 0.5 + 0.5 / 21;
    return F + lost * F * average / (1 - average * lost);
  };
  for (const auto& [form, bound] : {std::pair{EnvironmentAlbedo::fit, 2e-3}, {EnvironmentAlbedo::small_fit, 1.4e-2}}) {
    const EnvironmentShading shading{EnvironmentLobe::taps4, EnvironmentFresnel::f0, false, form};
    const std::vector<float> found = shaded(*runnable_kernels().back(), grid, environment, shading);
    double worst = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const reference::ShadeSurface& s = grid.surfaces[i];
      const auto truth = reference::directional_albedo(dot(s.normal, grid.v), s.roughness * s.roughness, 64);
      double low = 1e9, high = 0;  // over all that A and B may be
      for (const double a : {-bound, bound})
        for (const double b : {-bound, bound}) {
          low = std::min(low, reflected(truth.A + a, truth.B + b));
          high = std::max(high, reflected(truth.A + a, truth.B + b));
        }
      EXPECT_GE(double(found[i]), low - 1e-5) << i;
      EXPECT_LE(double(found[i]), high + 1e-5) << i;
      worst = std::max(worst, std::abs(double(found[i]) - reflected(truth.A, truth.B)));
    }
    EXPECT_GT(worst, bound / 20);  // it is a fit that was evaluated
    for (const Kernels* kernels : runnable_kernels())
      EXPECT_EQ(shaded(*kernels, grid, environment, shading), found) << kernels->isa;
  }
}

// The listing with F0 in the place of kS, in double.
TEST(EnvironmentFresnelForm, F0IsTheDerivation) {
  const Environment environment = Environment::constant(1);
  Grid grid;
  for (const double r : {0.1, 0.5, 0.9})
    for (const double mu : {0.05, 0.3, 0.9}) {
      reference::ShadeSurface s;
      s.normal = {std::sqrt(1 - mu * mu), 0, mu};
      s.base_color = {0.3, 0.3, 0.3};
      s.roughness = r;
      s.metallic = 0.5;
      grid.surfaces.push_back(s);
    }
  EnvironmentShading shading;
  shading.fresnel = EnvironmentFresnel::f0;
  const std::vector<float> found = shaded(*runnable_kernels().back(), grid, environment, shading);
  const reference::ShadeEnvironment exact = environment.reference();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const reference::ShadeSurface& s = grid.surfaces[i];
    const auto dfg = exact.dfg(dot(s.normal, grid.v), s.roughness);
    const double f0 = 0.02 + 0.15, F = f0 * dfg.A + dfg.B, lost = 1 - dfg.E(), average = f0 + (1 - f0) / 21;
    const double multiple = lost * F * average / (1 - average * lost);
    EXPECT_NEAR(double(found[i]), F + multiple + 0.15 * (1 - F - multiple), 1e-5) << i;
  }
}

// Lagarde and de Rousiers 2014, listing 26.
TEST(SpecularOcclusion, FollowsTheListing) {
  const Environment environment = Environment::constant(1);
  for (const double occlusion : {0.0, 0.2, 0.7, 1.0})
    for (const double r : {0.05, 0.4, 1.0})
      for (const double mu : {0.05, 0.5, 1.0}) {
        Grid grid;
        reference::ShadeSurface s;
        s.normal = {std::sqrt(1 - mu * mu), 0, mu};
        s.base_color = {1, 1, 1};
        s.metallic = 1;
        s.roughness = r;
        s.occlusion = occlusion;
        grid.surfaces.push_back(s);
        EnvironmentShading shading;
        shading.specular_occlusion = true;
        const float found = shaded(*runnable_kernels().back(), grid, environment, shading)[0];
        const double E = environment.reference().dfg(mu, r).E();
        const double open = std::clamp(std::pow(mu + occlusion, std::exp2(-16 * r * r - 1)) - 1 + occlusion, 0.0, 1.0);
        EXPECT_NEAR(double(found), E * open + (1 - E) * occlusion, 1e-5) << occlusion << " " << r << " " << mu;
      }
}

TEST(EnvironmentIrradiance, ComesFromTheCubeIfThereIsOne) {
  const Environment four = Environment::constant(4), one = Environment::constant(1);
  GBuffer gbuffer(1);
  reference::ShadeSurface s;
  s.normal = {0, 0, 1};
  s.base_color = {1, 1, 1};
  s.roughness = 1;
  gbuffer.set(0, s);
  ShadeArgs args = shade_args(gbuffer, {0, 0, 1}, {}, &one);
  args.eye[3] = 0;
  const auto dfg = one.reference().dfg(1, 1);
  const double F = 0.04 * dfg.A + dfg.B;
  args.environment.irradiance = four.view().specular;
  runnable_kernels().back()->shade(args);
  EXPECT_NEAR(double(gbuffer.radiance()[0][0]), F * 1 + (1 - F) * 4, 1e-4);
}

}  // namespace
}  // namespace tessera::test

#include "reference/walk.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "reference/albedo.hpp"
#include "reference/fresnel.hpp"
#include "reference/microfacet.hpp"
#include "reference/quadrature.hpp"

namespace tessera::reference {
namespace {

// Seeds are fixed, so a test passes or fails for good: 4 sigma leave room for the number of comparisons made.
constexpr double sigmas = 4;

void expect_within(const Estimate& estimate, double expected, double slack = 1e-9) {
  EXPECT_NEAR(estimate.mean, expected, sigmas * estimate.error + slack);
}

TEST(Walk, FirstOrderIsTheSingleScatteringLobe) {
  std::uint64_t seed = 1;
  for (const double alpha : {0.01, 0.1, 0.5, 1.0})
    for (const double mu : {0.02, 0.1, 0.4, 0.7, 1.0}) {
      SCOPED_TRACE(testing::Message() << "alpha " << alpha << " mu " << mu);
      const WalkResult white = walk_albedo({alpha}, mu, 100000, 3, ++seed);
      expect_within(white.by_order[0], directional_albedo(mu, alpha).E(), 1e-5);
      const auto schlick = [](double c) { return fresnel_schlick(0.3, c); };
      const WalkResult metal = walk_albedo({alpha, schlick}, mu, 100000, 3, ++seed);
      const DirectionalAlbedo parts = directional_albedo(mu, alpha);
      expect_within(metal.by_order[0], 0.3 * parts.A + parts.B, 1e-5);
    }
}

TEST(Walk, WhiteFacetsReflectEverything) {
  std::uint64_t seed = 100;
  for (const auto facets : {Microsurface::Facets::mirror, Microsurface::Facets::diffuse})
    for (const double alpha : {0.001, 0.1, 0.5, 1.0})
      for (const double mu : {1e-3, 0.1, 0.5, 1.0}) {
        const WalkResult result = walk_albedo({alpha, [](double) { return 1.0; }, facets}, mu, 20000, 2, ++seed);
        EXPECT_NEAR(result.total.mean, 1, 1e-6 + 3 * result.total.error) << alpha << " " << mu;
        EXPECT_NEAR(result.by_order[0].mean + result.multiple.mean, result.total.mean, 1e-9);
      }
}

TEST(Walk, BlackFacetsReflectNothingAndOrdersFallWithReflectance) {
  EXPECT_EQ(walk_albedo({0.5, [](double) { return 0.0; }}, 0.5, 1000).total.mean, 0);
  // The same walks for every constant reflectance: order k scales with its power.
  const WalkResult white = walk_albedo({1}, 0.5, 50000, 4, 5);
  const WalkResult grey = walk_albedo({1, [](double) { return 0.5; }}, 0.5, 50000, 4, 5);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(grey.by_order[k].mean, white.by_order[k].mean * std::pow(0.5, k + 1), 1e-12);
}

TEST(Walk, FirstOrderOfTheValueIsTheBrdf) {
  std::uint64_t seed = 200;
  for (const double alpha : {0.1, 0.5, 1.0})
    for (const double angle : {0.1, 0.8, 1.4}) {
      const Vec3 v = from_angles(0.9, 0), l = from_angles(angle, 2.5);
      const WalkResult result = walk_brdf({alpha}, v, l, 20000, 2, ++seed);
      expect_within(result.by_order[0], specular_brdf_over_fresnel(v, l, alpha), 1e-12);
    }
}

TEST(Walk, ValuesIntegrateToTheAlbedo) {
  for (const auto facets : {Microsurface::Facets::mirror, Microsurface::Facets::diffuse}) {
    const Microsurface surface = {0.7, [](double c) { return fresnel_schlick(0.5, c); }, facets};
    const Vec3 v = from_angles(0.9, 0);
    const QuadratureRule& rule = gauss_legendre(12);
    double sum = 0, variance = 0;
    std::uint64_t seed = 300;
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) {
        const double theta = rule.nodes[i] * std::numbers::pi / 2, phi = rule.nodes[j] * std::numbers::pi;
        const Vec3 l = from_angles(theta, phi);
        const double area = rule.weights[i] * rule.weights[j] * std::numbers::pi * std::numbers::pi;  // both halves
        const Estimate f = walk_brdf(surface, v, l, 3000, 1, ++seed).total;
        sum += area * f.mean * l.z * std::sin(theta);
        variance += std::pow(area * f.error * l.z * std::sin(theta), 2);
      }
    const Estimate albedo = walk_albedo(surface, v.z, 200000, 1, 77).total;
    EXPECT_NEAR(sum, albedo.mean, sigmas * std::sqrt(variance + albedo.error * albedo.error) + 1e-3);
  }
}

TEST(Walk, IsReciprocal) {
  std::uint64_t seed = 400;
  for (const auto facets : {Microsurface::Facets::mirror, Microsurface::Facets::diffuse})
    for (const double alpha : {0.2, 0.6, 1.0})
      for (const double phi : {0.3, 1.7, 3.0}) {
        // A diffuse facet is itself reciprocal only if its albedo is the same for every direction.
        const bool mirror = facets == Microsurface::Facets::mirror;
        const auto reflectance = [=](double c) { return mirror ? fresnel_schlick(0.6, c) : 0.6; };
        const Microsurface surface = {alpha, reflectance, facets};
        const Vec3 v = from_angles(0.3, 0), l = from_angles(1.3, phi);
        const WalkResult there = walk_brdf(surface, v, l, 40000, 2, ++seed);
        const WalkResult back = walk_brdf(surface, l, v, 40000, 2, ++seed);
        EXPECT_NEAR(there.total.mean, back.total.mean, sigmas * std::hypot(there.total.error, back.total.error));
        EXPECT_NEAR(there.multiple.mean, back.multiple.mean,
                    sigmas * std::hypot(there.multiple.error, back.multiple.error));
      }
}

TEST(Walk, StandardErrorIsTheSpreadOfIndependentRuns) {
  double sum = 0, squares = 0, claimed = 0;
  constexpr int runs = 200;
  for (int run = 0; run < runs; ++run) {
    const Estimate e = walk_albedo({1, [](double) { return 0.5; }}, 0.3, 500, 1, 1000 + run).total;
    sum += e.mean, squares += e.mean * e.mean, claimed += e.error;
  }
  const double spread = std::sqrt(squares / runs - sum / runs * sum / runs);
  EXPECT_NEAR(spread / (claimed / runs), 1, 0.2);
}

}  // namespace
}  // namespace tessera::reference

#define TESSERA_ISA distribution_other_test
#include "kernels/bsdf/distribution_other.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "reference/distribution.hpp"
#include "reference/microfacet.hpp"
#include "reference/quadrature.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;
using std::numbers::pi;

const double alphas[] = {1e-4, 1e-3, 0.01, 0.1, 0.3, 0.7, 0.99, 1.0};

double sine2(double theta) { return std::sin(theta) * std::sin(theta); }

// The same formula written twice agrees to the last digits of double, at angles of the lobe's own size and elsewhere.
TEST(Distributions, AgreeWithTheReferenceInDouble) {
  for (const double alpha : alphas)
    for (int i = 0; i < 400; ++i) {
      const double theta = i % 2 ? 1.57 * i / 400 : std::atan(alpha * i / 60), c = std::cos(theta), s2 = sine2(theta);
      const auto expect_same = [&](double found, double expected, const char* name) {
        EXPECT_NEAR(found, expected, 1e-9 * expected + 1e-30) << name << " alpha " << alpha << " theta " << theta;
      };
      expect_same(kernel::D_Beckmann(c, s2, alpha), reference::beckmann_distribution(theta, alpha), "Beckmann");
      expect_same(kernel::D_BlinnPhong(s2, alpha), reference::blinn_phong_distribution(theta, alpha), "Blinn-Phong");
      for (const double gamma : {0.5, 1.0, 1.5, 2.0, 4.0})
        expect_same(kernel::D_GTR(c, s2, alpha, gamma), reference::gtr_distribution(theta, alpha, gamma), "GTR");
      expect_same(kernel::D_GTR1(c, s2, alpha), reference::gtr_distribution(theta, alpha, 1), "GTR1");
      expect_same(kernel::D_GTR(c, s2, alpha, 2.0), reference::ggx_distribution(theta, alpha), "GTR 2 is GGX");
      for (const double phi : {0.0, 1.0, 2.5})
        for (const double alpha_y : {0.02, 0.5}) {
          const double x = std::sin(theta) * std::cos(phi), y = std::sin(theta) * std::sin(phi);
          expect_same(kernel::D_GGXAnisotropic(x, y, c, alpha, alpha_y),
                      reference::anisotropic_ggx_distribution(theta, phi, alpha, alpha_y), "anisotropic GGX");
          expect_same(kernel::D_BeckmannAnisotropic(x, y, c, alpha, alpha_y),
                      reference::anisotropic_beckmann_distribution(theta, phi, alpha, alpha_y), "anisotropic Beckmann");
        }
    }
}

// integral D(h) cos(h) dh over the hemisphere = pi integral D ds, s = sin^2; with s = alpha^2 (e^(L x) - 1) it is
// smooth for every alpha and every tail.
double total(double alpha, const std::function<double(double c, double s2)>& D) {
  const double alpha2 = alpha * alpha, L = std::log1p(1 / alpha2);
  return reference::integrate(
      [&](double x) {
        const double s2 = std::min(alpha2 * std::expm1(L * x), 1.0);
        return pi * D(std::sqrt(1 - s2), s2) * alpha2 * std::exp(L * x) * L;
      },
      0, 1, 48, 32);
}

TEST(Distributions, AreNormalised) {
  for (const double alpha : alphas) {
    EXPECT_NEAR(total(alpha, [&](double c, double s2) { return kernel::D_Beckmann(c, s2, alpha); }), 1, 1e-8) << alpha;
    EXPECT_NEAR(total(alpha, [&](double, double s2) { return kernel::D_BlinnPhong(s2, alpha); }), 1, 1e-6) << alpha;
    EXPECT_NEAR(total(alpha, [&](double c, double s2) { return kernel::D_GTR1(c, s2, alpha); }), 1, 1e-6) << alpha;
    for (const double gamma : {1.0, 1.3, 2.0, 3.0})
      EXPECT_NEAR(total(alpha, [&](double c, double s2) { return kernel::D_GTR(c, s2, alpha, gamma); }), 1, 1e-6)
          << alpha << " " << gamma;
  }
}

TEST(Distributions, AnisotropicOnesAreNormalised) {
  for (const double alpha_x : {0.01, 0.2, 1.0})
    for (const double alpha_y : {0.05, 0.6}) {
      // Slopes scaled by the alphas: D cos dh = D cos^4 dslope.
      const auto integral = [&](const auto& D) {
        return reference::integrate(
            [&](double x) {
              const double r = std::tan(x), dr = 1 / (std::cos(x) * std::cos(x));
              return reference::integrate(
                         [&](double phi) {
                           const double sx = alpha_x * r * std::cos(phi), sy = alpha_y * r * std::sin(phi);
                           const double c = 1 / std::sqrt(1 + sx * sx + sy * sy);
                           return D(sx * c, sy * c, c) * c * c * c * c;
                         },
                         0, 2 * pi, 16, 4) *
                     r * dr * alpha_x * alpha_y;
            },
            0, pi / 2, 32, 4);
      };
      EXPECT_NEAR(
          integral([&](double x, double y, double c) { return kernel::D_GGXAnisotropic(x, y, c, alpha_x, alpha_y); }),
          1, 1e-6);
      EXPECT_NEAR(integral([&](double x, double y, double c) {
                    return kernel::D_BeckmannAnisotropic(x, y, c, alpha_x, alpha_y);
                  }),
                  1, 1e-6);
    }
}

// alpha -> 1 and gamma -> 1 are 0/0 in the published forms: stepping through them, nothing jumps.
TEST(Distributions, AreContinuousThroughTheirLimits) {
  const float around_one[] = {std::nextafter(1.0f, 0.0f), 1.0f};
  for (const float theta : {0.0f, 0.4f, 1.2f}) {
    const float c = std::cos(theta), s2 = float(sine2(theta));
    for (float gamma = 0.99999f; gamma < 1.00001f; gamma = std::nextafter(gamma, 2.0f)) {
      const float next = std::nextafter(gamma, 2.0f);
      for (const float alpha : {0.01f, 0.5f, 1.0f})
        ASSERT_NEAR(kernel::D_GTR(c, s2, alpha, next) / kernel::D_GTR(c, s2, alpha, gamma), 1, 4e-6) << gamma;
    }
    for (const float gamma : {0.5f, 1.0f, 2.0f, 3.0f})
      EXPECT_NEAR(kernel::D_GTR(c, s2, around_one[0], gamma) / kernel::D_GTR(c, s2, around_one[1], gamma), 1, 4e-6);
    EXPECT_NEAR(kernel::D_GTR1(c, s2, 1.0f) * pi, 1, 2e-6);
    EXPECT_NEAR(kernel::D_BlinnPhong(s2, 1.0f) * pi, 1, 2e-6);
  }
}

// The naive forms are on the chart to show this: what they lose, and where.
TEST(Distributions, NaiveFormsFailWhereTheChartSaysSo) {
  const float alpha = 1e-4f;
  const double theta = 1e-4, truth = reference::ggx_distribution(theta, double(alpha));
  EXPECT_GT(std::abs(kernel::D_GGX_naive(float(std::cos(theta)), alpha) / truth - 1), 0.5);
  EXPECT_NEAR(kernel::D_GGX(float(std::cos(theta)), float(sine2(theta)), alpha) / truth, 1, 1e-6);
  const double phong = reference::blinn_phong_distribution(theta, double(alpha));
  EXPECT_GT(std::abs(kernel::D_BlinnPhong_naive(float(std::cos(theta)), alpha) / phong - 1), 0.1);
  EXPECT_NEAR(kernel::D_BlinnPhong(float(sine2(theta)), alpha) / phong, 1, 1e-6);
}

TEST(Distributions, HorizonAndPeak) {
  for (const double alpha : {1e-4, 0.01, 1.0}) {
    const float a = float(alpha);
    EXPECT_NEAR(kernel::D_Beckmann(1.0f, 0.0f, a) * pi * alpha * alpha, 1, 2e-6);
    EXPECT_NEAR(kernel::D_BlinnPhong(0.0f, a) * pi * alpha * alpha, 1, 2e-6);
    EXPECT_EQ(kernel::D_Beckmann(0.0f, 1.0f, a), 0);
    EXPECT_TRUE(std::isfinite(kernel::D_BlinnPhong(1.0f, a)));
    EXPECT_TRUE(std::isfinite(kernel::D_BeckmannAnisotropic(1.0f, 0.0f, 0.0f, a, 1.0f)));
  }
}

}  // namespace
}  // namespace tessera::test

#define TESSERA_ISA distribution_test
#include "kernels/bsdf/distribution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/microfacet.hpp"
#include "reference/quadrature.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;

// Whole domain: alpha in [1e-4,1], angles from 1e-7 to the horizon, both on logarithmic grids.
TEST(DGGX, AgreesWithReferenceForTheSameInputs) {
  std::vector<float> cosine, sin2, alpha;
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 140; ++j) {
      const double s2 = j == 0 ? 0 : std::pow(10.0, -14 + 14.0 * j / 140);
      alpha.push_back(float(std::pow(10.0, -4 + 4.0 * i / 60)));
      sin2.push_back(float(s2));
      cosine.push_back(float(std::sqrt(1 - s2)));
    }
  for (const Kernels* kernels : runnable_kernels()) {
    const auto d = evaluate_term(*kernels, "D_GGX", {&cosine, &sin2, &alpha});
    for (std::size_t k = 0; k < d.size(); ++k) {
      const double expected = reference::ggx_distribution(sin2[k], double(cosine[k]) * cosine[k], alpha[k]);
      ASSERT_NEAR(d[k] / expected, 1, 1e-6) << kernels->isa << " alpha " << alpha[k] << " sin^2 " << sin2[k];
    }
  }
}

// From vectors, as a renderer has them: the angle is that between the two float vectors, whatever their last bits.
TEST(DGGX, KeepsItsDigitsForSmallAlphaFromVectors) {
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < 200000; ++trial) {
    const auto direction = [&] {
      const double x = gauss(random), y = gauss(random), z = gauss(random);
      return reference::normalize({x, y, z});
    };
    const double a = std::pow(10.0, -4 + 4 * (trial % 1000) / 1000.0);
    const reference::Vec3 n0 = direction(), offset = direction() * (a * std::abs(gauss(random)));
    const reference::Vec3 h0 = reference::normalize(n0 + offset);
    const kernel::Vec3<float> n = {float(n0.x), float(n0.y), float(n0.z)}, h = {float(h0.x), float(h0.y), float(h0.z)};
    const float alpha = float(a);

    const reference::Vec3 nd = {n.x, n.y, n.z}, hd = {h.x, h.y, h.z}, c = reference::cross(nd, hd);
    const double lengths = reference::dot(nd, nd) * reference::dot(hd, hd);
    const double cosine = reference::dot(nd, hd);
    const double expected =
        reference::ggx_distribution(reference::dot(c, c) / lengths, cosine * cosine / lengths, alpha);
    const float d = kernel::D_GGX(std::min(kernel::dot(n, h), 1.0f), kernel::sin2_between(n, h), alpha);
    ASSERT_NEAR(d / expected, 1, 1e-5) << "alpha " << alpha;
  }
}

TEST(DGGX, PeakIsNotCapped) {
  for (const double alpha : {1e-4, 1e-3, 0.1, 1.0})
    EXPECT_NEAR(kernel::D_GGX(1.0f, 0.0f, float(alpha)) * std::numbers::pi * alpha * alpha, 1, 1e-6);
}

// integral D(h) cos(h) dh = 1: with tan^2 = alpha^2 tan^2(x) the integrand is smooth for every alpha.
TEST(DGGX, Normalised) {
  for (const double alpha : {1e-4, 1e-3, 0.01, 0.1, 0.3, 0.7, 1.0}) {
    const double total = reference::integrate(
        [&](double x) {
          const double t = alpha * std::tan(x), theta = std::atan(t), c = std::cos(theta), s = std::sin(theta);
          const double dtheta_dx = alpha / (std::cos(x) * std::cos(x)) / (1 + t * t);
          return 2 * std::numbers::pi * kernel::D_GGX(c, s * s, alpha) * c * s * dtheta_dx;
        },
        0, std::numbers::pi / 2, 32, 4);
    EXPECT_NEAR(total, 1, 1e-9) << alpha;
  }
}

TEST(DGGX, DoubleEvaluationIsTheReference) {
  for (const double alpha : {1e-4, 0.02, 0.5, 1.0})
    for (double theta = 0; theta < 1.57; theta += 0.01) {
      const double s = std::sin(theta), expected = reference::ggx_distribution(theta, alpha);
      EXPECT_NEAR(kernel::D_GGX(std::cos(theta), s * s, alpha) / expected, 1, 1e-12);
    }
}

}  // namespace
}  // namespace tessera::test

#define TESSERA_ISA masking_test
#include "kernels/bsdf/masking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/bsdf/distribution.hpp"
#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/microfacet.hpp"
#include "reference/quadrature.hpp"
#include "reference/vector.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;

// NoV and NoL from 1e-4 to 1, alpha from 1e-4 to 1.
TEST(VSmithGGXCorrelated, AgreesWithReference) {
  std::vector<float> NoV, NoL, alpha;
  const auto logarithmic = [](int i) { return float(std::pow(10.0, -4 + 4.0 * i / 24)); };
  for (int i = 0; i <= 24; ++i)
    for (int j = 0; j <= 24; ++j)
      for (int k = 0; k <= 24; ++k) {
        NoV.push_back(logarithmic(i));
        NoL.push_back(logarithmic(j));
        alpha.push_back(logarithmic(k));
      }
  for (const Kernels* kernels : runnable_kernels()) {
    const auto v = evaluate_term(*kernels, "V_SmithGGXCorrelated", {&NoV, &NoL, &alpha});
    for (std::size_t k = 0; k < v.size(); ++k) {
      const double G =
          reference::smith_masking_shadowing(std::acos(double(NoV[k])), std::acos(double(NoL[k])), alpha[k]);
      const double expected = G / (4 * double(NoV[k]) * NoL[k]);
      ASSERT_NEAR(v[k] / expected, 1, 1e-6) << kernels->isa << ' ' << NoV[k] << ' ' << NoL[k] << ' ' << alpha[k];
    }
  }
}

TEST(VSmithGGXCorrelated, SymmetricAndFiniteAtTheHorizon) {
  for (const float mu : {1e-4f, 0.01f, 0.5f, 1.0f})
    for (const float alpha : {1e-4f, 0.002f, 0.3f, 1.0f}) {
      EXPECT_TRUE(std::isfinite(kernel::V_SmithGGXCorrelated(mu, 0.0f, alpha)));
      EXPECT_NEAR(kernel::V_SmithGGXCorrelated(mu, 0.7f, alpha) / kernel::V_SmithGGXCorrelated(0.7f, mu, alpha), 1,
                  3e-7);
    }
}

// integral G1(v,m) max(0, v.m) D(m) dm = n.v (Heitz 2014, eq. 5) with G1 = 2 mu / (mu + root): masking and distribution
// belong together.
TEST(SmithRootGGX, ObeysTheMaskingConstraint) {
  for (const double alpha : {0.05, 0.2, 0.5, 1.0})
    for (const double mu : {0.1, 0.4, 0.8, 1.0}) {
      const double G1 = 2 * mu / (mu + kernel::smith_root_GGX(mu, alpha * alpha));
      const double sin_v = std::sqrt(1 - mu * mu);
      const double projected = reference::integrate(
          [&](double x) {
            const double t = alpha * std::tan(x), theta = std::atan(t), c = std::cos(theta), s = std::sin(theta);
            const double dtheta_dx = alpha / (std::cos(x) * std::cos(x)) / (1 + t * t);
            // The azimuth where the facet turns away from v cuts the inner integral.
            const double ratio = sin_v * s > 0 ? -mu * c / (sin_v * s) : -2;
            const double edge = ratio <= -1 ? std::numbers::pi : std::acos(ratio);
            const double facing = 2 * (edge * mu * c + std::sin(edge) * sin_v * s);
            return facing * kernel::D_GGX(c, s * s, alpha) * s * dtheta_dx;
          },
          0, std::numbers::pi / 2, 48, 24);
      EXPECT_NEAR(G1 * projected, mu, 1e-6) << alpha << ' ' << mu;
    }
}

}  // namespace
}  // namespace tessera::test

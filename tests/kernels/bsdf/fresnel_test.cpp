#define TESSERA_ISA fresnel_test
#include "kernels/bsdf/fresnel.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/fresnel.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;

TEST(FSchlick, AgreesWithReference) {
  std::vector<float> f0, VoH;
  for (int i = 0; i <= 50; ++i)
    for (int j = 0; j <= 200; ++j) {
      f0.push_back(float(i) / 50);
      VoH.push_back(float(j) / 200);
    }
  for (const Kernels* kernels : runnable_kernels()) {
    const auto f = evaluate_term(*kernels, "F_Schlick", {&f0, &VoH});
    for (std::size_t k = 0; k < f.size(); ++k)
      ASSERT_NEAR(f[k], reference::fresnel_schlick(f0[k], VoH[k]), 2.5e-7) << f0[k] << ' ' << VoH[k];
  }
}

TEST(FSchlick, EndsAreExactAndItStaysBetweenThem) {
  for (float f0 = 0; f0 <= 1; f0 += 1.0f / 256) {
    EXPECT_EQ(kernel::F_Schlick(f0, 1.0f), f0);
    EXPECT_EQ(kernel::F_Schlick(f0, 0.0f), 1.0f);
    for (float VoH = 0; VoH <= 1; VoH += 1.0f / 512) {
      EXPECT_GE(kernel::F_Schlick(f0, VoH), f0);
      EXPECT_LE(kernel::F_Schlick(f0, VoH), 1.0f);
    }
  }
}

// The method's own error, for a dielectric of ior 1.5 (F0 = 0.04): 0.0357, near 87 degrees.
TEST(FSchlick, NearTheExactDielectric) {
  double largest = 0;
  for (double c = 0; c <= 1; c += 1e-3)
    largest = std::max(largest, std::abs(kernel::F_Schlick(0.04, c) - reference::fresnel_dielectric(c, 1.5)));
  EXPECT_LT(largest, 0.036);
  EXPECT_GT(largest, 0.01);
}

TEST(FSchlickRoughness, SmoothSurfaceIsSchlickAndRoughOneIsFlat) {
  for (const double f0 : {0.0, 0.04, 0.5, 1.0})
    for (double c = 0; c <= 1; c += 0.05) {
      const double weight = kernel::schlick_weight(c);
      EXPECT_NEAR(kernel::F_SchlickRoughness(f0, weight, 0.0), reference::fresnel_schlick(f0, c), 1e-12);
      EXPECT_EQ(kernel::F_SchlickRoughness(f0, weight, 1.0), f0);
    }
}

TEST(ReferenceFresnel, KnownValues) {
  EXPECT_NEAR(reference::fresnel_dielectric(1, 1.5), 0.04, 1e-12);
  EXPECT_NEAR(reference::fresnel_dielectric(0, 1.5), 1, 1e-12);
  EXPECT_EQ(reference::fresnel_dielectric(0.5, 1 / 1.5), 1);  // beyond the critical angle
  // Brewster's angle: only s-polarised light is reflected, ((n^2 - 1)/(n^2 + 1))^2 of it.
  EXPECT_NEAR(reference::fresnel_dielectric(std::cos(std::atan(1.5)), 1.5), 0.5 * std::pow(1.25 / 3.25, 2), 1e-12);
  // Normal incidence on a metal: ((eta-1)^2 + k^2) / ((eta+1)^2 + k^2).
  EXPECT_NEAR(reference::fresnel_conductor(1, 0.2, 3.9), (0.64 + 15.21) / (1.44 + 15.21), 1e-12);
}

}  // namespace
}  // namespace tessera::test

#define TESSERA_ISA fresnel_other_test
#include "kernels/bsdf/fresnel_other.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/fresnel.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;

TEST(Fresnel, ExactFormsAgreeWithTheReferenceInDouble) {
  for (int i = 0; i <= 1000; ++i) {
    const double c = std::max(i / 1000.0, 1e-4);  // at 0 an index of 1 has two limits
    for (const double eta : {0.4, 0.66, 0.99, 1.0, 1.01, 1.33, 1.5, 2.4, 5.0})
      EXPECT_NEAR(kernel::F_Dielectric(eta, c), reference::fresnel_dielectric(c, eta), 1e-12) << eta << " " << c;
    for (const double eta : {0.05, 0.2, 1.0, 2.8})
      for (const double k : {0.5, 2.9, 9.0})
        EXPECT_NEAR(kernel::F_Conductor(eta, k, c), reference::fresnel_conductor(c, eta, k), 1e-12) << eta << " " << k;
    for (const double f0 : {0.0, 0.02, 0.04, 0.5, 0.9}) {
      const double root = std::sqrt(f0), eta = (1 + root) / (1 - root);
      EXPECT_NEAR(kernel::F_CookTorrance(f0, c), reference::fresnel_dielectric(c, eta), 1e-12) << f0;
      EXPECT_NEAR(kernel::F_Gotanda(f0, c), reference::fresnel_dielectric(c, eta), 1e-12) << f0;
    }
  }
}

TEST(Fresnel, NormalIncidenceAndGrazing) {
  for (const double f0 : {0.02, 0.3, 0.8, 0.95}) {
    EXPECT_NEAR(kernel::F_SchlickGaussian(f0, 1.0), f0 + (1 - f0) * std::exp2(-12.53789), 1e-15);
    EXPECT_NEAR(kernel::F_SchlickGaussianSingle(f0, 1.0), f0 + (1 - f0) * std::exp2(-8.35), 1e-15);
    EXPECT_NEAR(kernel::F_CookTorrance(f0, 1.0), f0, 1e-12);
    EXPECT_NEAR(kernel::F_Gotanda(f0, 1.0), f0, 1e-12);
    EXPECT_NEAR(kernel::F_Gulbrandsen(f0, 0.4, 1.0), f0, 1e-12);
    EXPECT_NEAR(kernel::F_Schlick82(f0, 0.5, 1.0), f0, 1e-15);
    EXPECT_NEAR(kernel::F_Schlick82(f0, 0.5, 1.0 / 7), 0.5, 1e-14);
    EXPECT_NEAR(kernel::F_LazanyiSzirmayKalos(f0, 1.1, 5.0, 1.0), f0, 1e-15);
    for (const auto F : {kernel::F_Schlick<double>, kernel::F_SchlickGaussian<double>, kernel::F_CookTorrance<double>})
      EXPECT_NEAR(F(f0, 0.0), 1, 1e-12);
    EXPECT_NEAR(kernel::F_Gotanda(f0, 0.0), 1, 1e-12);
    EXPECT_NEAR(kernel::F_Gulbrandsen(f0, 0.4, 0.0), 1, 1e-12);
    EXPECT_NEAR(kernel::F_Schlick82(f0, 0.5, 0.0), 1, 1e-15);
  }
}

// Written out literally.
TEST(Fresnel, CorrectionsAgreeWithTheirPapers) {
  for (int i = 0; i <= 50; ++i) {
    const double c = i / 50.0, f0 = 0.9, schlick = f0 + (1 - f0) * std::pow(1 - c, 5);
    EXPECT_NEAR(kernel::F_LazanyiSzirmayKalos(f0, 1.2, 6.0, c), schlick - 1.2 * c * std::pow(1 - c, 6), 1e-12);
    EXPECT_NEAR(kernel::F_SchlickTwoPercent(0.5, 0.01, c), 0.5 * std::pow(1 - c, 5) + (1 - std::pow(1 - c, 5)) * 0.5,
                1e-12);
    EXPECT_NEAR(kernel::F_SchlickTwoPercent(0.9, 0.9, c), schlick, 1e-12);
    EXPECT_NEAR(kernel::F_SchlickRough(0.2, c, 0.3), 0.2 + 0.5 * std::pow(1 - c, 5), 1e-12);
    const double at82 = f0 + (1 - f0) * std::pow(6.0 / 7, 5), a = (at82 - 0.85) / (1.0 / 7 * std::pow(6.0 / 7, 6));
    EXPECT_NEAR(kernel::F_Schlick82(f0, 0.85, c), schlick - a * c * std::pow(1 - c, 6), 1e-12);
  }
}

// As published, with its differences.
TEST(Fresnel, GotandasFormAgreesWithThePublishedOne) {
  for (const double f0 : {0.02, 0.04, 0.3, 0.8, 0.95})
    for (int i = 1; i <= 100; ++i) {
      const double c = i / 100.0, plus = std::sqrt(f0) + 1, minus = std::sqrt(f0) - 1;
      const double alpha = std::sqrt(1 - minus * minus * (1 - c * c) / (plus * plus));
      const double left = (plus * c + minus * alpha) / (plus * c - minus * alpha),
                   right = (minus * c + plus * alpha) / (minus * c - plus * alpha);
      EXPECT_NEAR(kernel::F_Gotanda(f0, c), 0.5 * (left * left + right * right), 1e-12) << f0 << " " << c;
    }
}

// Total internal reflection begins where the branch is: no jump across it, and the curve falls monotonically from 1.
TEST(Fresnel, DielectricFromWithinIsContinuousAtTheCriticalAngle) {
  for (const float eta : {0.4f, 0.66f, 0.9f}) {
    float c = std::sqrt(1 - eta * eta);
    for (int i = 0; i < 200; ++i) c = std::nextafter(c, 0.0f);
    float last = kernel::F_Dielectric(eta, c);
    for (int i = 0; i < 400; ++i) {
      c = std::nextafter(c, 1.0f);
      const float f = kernel::F_Dielectric(eta, c);
      // The curve leaves 1 like a square root: one ulp of the cosine is worth 3e-3.
      ASSERT_LE(std::abs(f - last), 5e-3f) << eta << " step " << i;
      ASSERT_LE(f, 1.0f);
      last = f;
    }
  }
}

TEST(Fresnel, ExtremesAreFiniteAndWithinOne) {
  for (const float F0 : {0.0f, 1e-40f, 1e-10f, 1.0f, 0.999999f})
    for (const float c : {0.0f, 1e-40f, 1e-20f, 1e-7f, 0.5f, 1.0f})
      for (const float f :
           {kernel::F_SchlickGaussian(F0, c), kernel::F_CookTorrance(F0, c), kernel::F_Gotanda(F0, c),
            kernel::F_Gulbrandsen(F0, 1.0f, c), kernel::F_Gulbrandsen(F0, 0.0f, c), kernel::F_Schlick82(F0, 0.0f, c),
            kernel::F_Schlick82(F0, 1.0f, c), kernel::F_Conductor(F0, 0.0f, c), kernel::F_Conductor(F0, 20.0f, c),
            kernel::F_Dielectric(1.0f + F0, c), kernel::F_Dielectric(1.0f, c)}) {
        EXPECT_GE(f, 0.0f) << F0 << " " << c;
        EXPECT_LE(f, 1.0f) << F0 << " " << c;
      }
}

}  // namespace
}  // namespace tessera::test

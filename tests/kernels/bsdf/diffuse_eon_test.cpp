#define TESSERA_ISA diffuse_eon_test
#include "kernels/bsdf/diffuse_eon.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/bsdf/diffuse_inputs.hpp"
#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/diffuse.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;
using reference::Vec3;

TEST(FdFujii, AgreesWithReference) {
  const DiffuseInputs in = diffuse_inputs();
  for (const Kernels* kernels : runnable_kernels()) {
    const auto f = evaluate_term(*kernels, "Fd_Fujii", {&in.roughness, &in.NoV, &in.NoL, &in.LoV});
    for (std::size_t k = 0; k < f.size(); ++k) {
      const auto& e = in.exact[k];
      ASSERT_NEAR(f[k], reference::fujii_diffuse(1, e.roughness, e.v, e.l), 1e-6 + 4e-8 / std::max(e.v.z, e.l.z))
          << in.NoV[k] << ' ' << in.NoL[k] << ' ' << in.roughness[k];
    }
  }
}

// Against directional albedos by quadrature, which know nothing of the closed forms.
TEST(FdEON, AgreesWithReference) {
  const DiffuseInputs in = diffuse_inputs(2);
  for (const Kernels* kernels : runnable_kernels()) {
    const auto exact = evaluate_term(*kernels, "Fd_EONExact", {&in.albedo, &in.roughness, &in.NoV, &in.NoL, &in.LoV});
    const auto fit = evaluate_term(*kernels, "Fd_EON", {&in.albedo, &in.roughness, &in.NoV, &in.NoL, &in.LoV});
    for (std::size_t k = 0; k < fit.size(); ++k) {
      const auto& e = in.exact[k];
      static std::vector<double> expected;
      if (expected.size() == k) expected.push_back(reference::eon_diffuse(e.albedo, e.roughness, e.v, e.l));
      const double rounding = 1e-6 + 4e-8 / std::max(e.v.z, e.l.z);
      ASSERT_NEAR(exact[k], expected[k], rounding) << in.NoV[k] << ' ' << in.NoL[k] << ' ' << in.roughness[k];
      ASSERT_NEAR(fit[k], expected[k], rounding + 1e-4);
    }
  }
}

double white_albedo(bool exact, double roughness, double mu) {
  return reference::hemispherical_albedo(
      [&](const Vec3& v, const Vec3& l) {
        return exact ? kernel::Fd_EONExact(1.0, roughness, v.z, l.z, dot(v, l))
                     : kernel::Fd_EON(1.0, roughness, v.z, l.z, dot(v, l));
      },
      mu);
}

// The promise of the model.
TEST(FdEON, WhiteFurnace) {
  for (const double r : {0.0, 0.1, 0.5, 1.0})
    for (const double mu : {0.001, 0.02, 0.1, 0.3, 0.6, 1.0}) {
      EXPECT_NEAR(white_albedo(true, r, mu), 1, 1e-7) << r << ' ' << mu;
      EXPECT_NEAR(white_albedo(false, r, mu), 1, 3e-4) << r << ' ' << mu;
    }
}

TEST(FdEON, GreyAbsorbsMoreTheRougherItIs) {
  double previous = 1;
  for (const double r : {0.0, 0.25, 0.5, 1.0}) {
    const double albedo = reference::hemispherical_albedo(
        [&](const Vec3& v, const Vec3& l) { return kernel::Fd_EONExact(0.5, r, v.z, l.z, dot(v, l)); }, 0.7);
    EXPECT_LT(albedo, previous);
    previous = albedo;
  }
  EXPECT_NEAR(reference::hemispherical_albedo(
                  [](const Vec3& v, const Vec3& l) { return kernel::Fd_EONExact(0.5, 0.0, v.z, l.z, dot(v, l)); }, 0.7),
              0.5, 1e-12);
}

TEST(FdEON, ReciprocalFiniteAndNotNegative) {
  const float ends[] = {0.0f, 1e-40f, 1e-4f, 0.03f, 0.5f, 1.0f};
  for (const float v : ends)
    for (const float l : ends)
      for (const float r : ends)
        for (const float albedo : ends)
          for (const float c : {-1.0f, -1e-40f, 0.0f, 0.5f, 1.0f}) {
            const float fit = kernel::Fd_EON(albedo, r, v, l, c), exact = kernel::Fd_EONExact(albedo, r, v, l, c);
            ASSERT_TRUE(fit >= 0 && fit < 1e30f && exact >= 0 && exact < 1e30f)
                << v << ' ' << l << ' ' << r << ' ' << c;
            ASSERT_EQ(fit, kernel::Fd_EON(albedo, r, l, v, c));
            ASSERT_EQ(exact, kernel::Fd_EONExact(albedo, r, l, v, c));
          }
}

// Fujii's change: where s changes sign, the lobe does not jump.
TEST(FdFujii, ContinuousAcrossItsBranch) {
  const float NoV = 0.3f, NoL = 0.4f, at = NoV * NoL;
  for (float LoV = at * 0.99999f; LoV < at * 1.00001f; LoV = std::nextafter(LoV, 2.0f))
    ASSERT_NEAR(kernel::Fd_Fujii(1.0f, NoV, NoL, LoV), kernel::Fd_Fujii(1.0f, NoV, NoL, std::nextafter(LoV, 2.0f)),
                5e-8f);
}

}  // namespace
}  // namespace tessera::test

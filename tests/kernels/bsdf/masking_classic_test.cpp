#define TESSERA_ISA masking_classic_test
#include "kernels/bsdf/masking_classic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/bsdf/masking_inputs.hpp"
#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/masking.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;

using Inputs = std::initializer_list<const std::vector<float>*>;

template <class Reference>
void expect_agreement(const char* term, const MaskingInputs& in, Inputs inputs, double bound, Reference G) {
  for (const Kernels* kernels : runnable_kernels()) {
    const auto V = evaluate_term(*kernels, term, inputs);
    for (std::size_t k = 0; k < V.size(); ++k) {
      const MaskingInputs::Exact& e = in.exact[k];
      const double expected = G(e) / (4 * e.v.z * e.l.z);
      ASSERT_NEAR(V[k] / expected, 1, bound)
          << kernels->isa << ' ' << in.NoV[k] << ' ' << in.NoL[k] << ' ' << in.phi[k] << ' ' << in.alpha[k];
    }
  }
}

TEST(VClassic, AgreesWithReference) {
  const MaskingInputs in = masking_inputs();
  using Exact = MaskingInputs::Exact;
  const Inputs with_alpha = {&in.NoV, &in.NoL, &in.alpha};
  expect_agreement("V_SmithGGXCorrelatedFast", in, with_alpha, 1e-6,
                   [](const Exact& e) { return reference::hammon_masking(e.v, e.l, e.alpha); });
  expect_agreement("V_SchlickGGX", in, with_alpha, 1e-6,
                   [](const Exact& e) { return reference::schlick_masking(e.v, e.l, e.alpha / 2); });
  expect_agreement("V_SchlickBeckmann", in, with_alpha, 1e-6, [](const Exact& e) {
    return reference::schlick_masking(e.v, e.l, e.alpha * std::sqrt(2 / std::numbers::pi));
  });
  expect_agreement("V_SchlickGGXRemapped", in, {&in.NoV, &in.NoL, &in.roughness}, 1e-6, [](const Exact& e) {
    return reference::schlick_masking(e.v, e.l, (e.roughness + 1) * (e.roughness + 1) / 8);
  });
  // Inputs of these are rounded from the same pair of directions.
  expect_agreement("V_CookTorrance", in, {&in.NoV, &in.NoL, &in.NoH, &in.VoH}, 1e-6,
                   [](const Exact& e) { return reference::cook_torrance_masking(e.v, e.l); });
  expect_agreement("V_Neumann", in, {&in.NoV, &in.NoL}, 1e-6,
                   [](const Exact& e) { return reference::neumann_masking(e.v, e.l); });
  expect_agreement("V_Kelemen", in, {&in.VoH}, 1e-6,
                   [](const Exact& e) { return reference::kelemen_masking(e.v, e.l); });
  expect_agreement("V_Implicit", in, {&in.NoV, &in.NoL}, 1e-6,
                   [](const Exact& e) { return reference::implicit_masking(e.v, e.l); });
}

// Hammon's form is Smith's own at the ends of roughness.
TEST(VSmithGGXCorrelatedFast, ExactForSmoothAndForRough) {
  for (const double v : {0.01, 0.3, 1.0})
    for (const double l : {0.02, 0.6, 1.0})
      for (const double alpha : {0.0, 1.0})
        EXPECT_NEAR(kernel::V_SmithGGXCorrelatedFast(v, l, alpha) / kernel::V_SmithGGXCorrelated(v, l, alpha), 1,
                    1e-12);
}

// Where UE4's remapping goes wrong: k = 1/8 for a mirror, which nothing should mask.
TEST(VSchlickGGXRemapped, MasksAMirror) {
  const double mu = 0.05, remapped = kernel::V_SchlickGGXRemapped(mu, mu, 0.0) * 4 * mu * mu;
  EXPECT_NEAR(kernel::V_SchlickGGX(mu, mu, 0.0) * 4 * mu * mu, 1, 1e-12);
  EXPECT_NEAR(remapped, 0.0877, 1e-4);  // (0.05 / (0.05 * 7/8 + 1/8))^2
}

// The minimum of three fractions: continuous where one takes over from another, by steps of one ulp.
TEST(VCookTorrance, ContinuousWhereItsMinimumChanges) {
  const float NoH = 0.7f, VoH = 0.56f, kink = VoH / (2 * NoH);  // 2 NoH low = VoH at low = 0.4
  for (const float NoV : {0.6f, kink})                          // and where NoL passes NoV
    for (float NoL = kink * 0.99999f; NoL < kink * 1.00001f; NoL = std::nextafter(NoL, 2.0f)) {
      const float next = kernel::V_CookTorrance(NoV, std::nextafter(NoL, 2.0f), NoH, VoH);
      ASSERT_NEAR(kernel::V_CookTorrance(NoV, NoL, NoH, VoH) / next, 1, 3e-7) << NoL;
    }
}

// Mu to 0, v.h to 0 (l = -v), alpha at both ends.
TEST(VClassic, FiniteAtTheEndsOfTheDomain) {
  const float ends[] = {0.0f, 1e-40f, 1e-20f, 1e-4f, 0.5f, 1.0f};
  for (const float v : ends)
    for (const float l : ends)
      for (const float a : ends)
        for (const float b : ends)
          for (const float V : {kernel::V_SmithGGXCorrelatedFast(v, l, a), kernel::V_SchlickGGX(v, l, a),
                                kernel::V_SchlickGGXRemapped(v, l, a), kernel::V_SchlickBeckmann(v, l, a),
                                kernel::V_CookTorrance(v, l, a, b), kernel::V_Neumann(v, l), kernel::V_Kelemen(b)}) {
            ASSERT_TRUE(V >= 0 && V <= 1e31f) << v << ' ' << l << ' ' << a << ' ' << b << ": " << V;
          }
}

}  // namespace
}  // namespace tessera::test

#define TESSERA_ISA masking_smith_test
#include "kernels/bsdf/masking_smith.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "kernels/bsdf/masking_inputs.hpp"
#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/masking.hpp"
#include "reference/microfacet.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;
using reference::Joint;
using Exact = MaskingInputs::Exact;
using Lambda = double (*)(double, double);

double G(Joint joint, Lambda lambda, const Exact& e) {
  return reference::joint_masking(joint, lambda(e.theta_v, e.alpha), lambda(e.theta_l, e.alpha), e.phi);
}

struct Form {
  const char* term;
  bool takes_azimuth;
  Joint joint;
  Lambda lambda;
};
const Form forms[] = {
    {"V_SmithGGXSeparable", false, Joint::separable, reference::ggx_lambda},
    {"V_SmithGGXDirectionCorrelated", true, Joint::direction, reference::ggx_lambda},
    {"V_SmithGGXHeightDirectionCorrelated", true, Joint::height_direction, reference::ggx_lambda},
    {"V_SmithBeckmannSeparable", false, Joint::separable, reference::beckmann_lambda},
    {"V_SmithBeckmannCorrelated", false, Joint::height, reference::beckmann_lambda},
    {"V_SmithBeckmannRationalSeparable", false, Joint::separable, reference::beckmann_lambda_rational},
    {"V_SmithBeckmannRationalCorrelated", false, Joint::height, reference::beckmann_lambda_rational},
};

class SmithVisibility : public testing::TestWithParam<Form> {};

TEST_P(SmithVisibility, AgreesWithReference) {
  const Form& form = GetParam();
  const MaskingInputs in = masking_inputs();
  for (const Kernels* kernels : runnable_kernels()) {
    const auto V = form.takes_azimuth ? evaluate_term(*kernels, form.term, {&in.NoV, &in.NoL, &in.phi, &in.alpha})
                                      : evaluate_term(*kernels, form.term, {&in.NoV, &in.NoL, &in.alpha});
    for (std::size_t k = 0; k < V.size(); ++k) {
      const Exact& e = in.exact[k];
      // The fit jumps where a = 1.6: a float may lie on the other side.
      const auto near_jump = [&](double theta) { return std::abs(1 / (e.alpha * std::tan(theta)) - 1.6) < 1e-5; };
      if (near_jump(e.theta_v) || near_jump(e.theta_l)) continue;
      const double expected = G(form.joint, form.lambda, e) / (4 * e.v.z * e.l.z);
      ASSERT_NEAR(V[k] / expected, 1, 2e-6)
          << kernels->isa << ' ' << in.NoV[k] << ' ' << in.NoL[k] << ' ' << in.phi[k] << ' ' << in.alpha[k];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, SmithVisibility, testing::ValuesIn(forms),
                         [](const auto& info) { return std::string(info.param.term); });

// What holds between the forms, for every pair: independent masking is the darkest, masking correlated by height lies
// above it, and correlation by direction lifts either.
TEST(SmithVisibilities, AreOrdered) {
  for (const double alpha : {0.01, 0.3, 1.0})
    for (const double v : {0.01, 0.2, 0.9})
      for (const double l : {0.02, 0.5, 1.0})
        for (const double phi : {0.0, 0.5, 3.0}) {
          const double separable = kernel::V_SmithGGXSeparable(v, l, alpha);
          const double height = kernel::V_SmithGGXCorrelated(v, l, alpha);
          EXPECT_LE(separable, height * (1 + 1e-12));
          EXPECT_LE(separable, kernel::V_SmithGGXDirectionCorrelated(v, l, phi, alpha) * (1 + 1e-12));
          EXPECT_LE(height, kernel::V_SmithGGXHeightDirectionCorrelated(v, l, phi, alpha) * (1 + 1e-12));
        }
}

// Seen along the light, nothing that is seen is in shadow: G = G1. Only the forms that know of direction have that.
TEST(SmithVisibilities, NoShadowIsSeenAlongTheLight) {
  for (const double mu : {0.05, 0.5, 1.0})
    for (const double alpha : {0.1, 1.0}) {
      const double G1 = kernel::G1_SmithGGX(mu, alpha), over = 4 * mu * mu;
      EXPECT_NEAR(kernel::V_SmithGGXDirectionCorrelated(mu, mu, 0.0, alpha) * over, G1, 1e-12);
      EXPECT_NEAR(kernel::V_SmithGGXHeightDirectionCorrelated(mu, mu, 0.0, alpha) * over, G1, 1e-12);
      if (mu < 1) {
        EXPECT_LT(kernel::V_SmithGGXCorrelated(mu, mu, alpha) * over, G1 - 1e-6);
      }
    }
}

TEST(SmithG1, AgreesWithReference) {
  std::vector<float> mu, alpha;
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 60; ++j) {
      mu.push_back(float(std::pow(10.0, -4 + 4.0 * i / 60)));
      alpha.push_back(float(std::pow(10.0, -4 + 4.0 * j / 60)));
    }
  for (const Kernels* kernels : runnable_kernels()) {
    const auto ggx = evaluate_term(*kernels, "G1_SmithGGX", {&mu, &alpha});
    const auto beckmann = evaluate_term(*kernels, "G1_SmithBeckmann", {&mu, &alpha});
    const auto rational = evaluate_term(*kernels, "G1_SmithBeckmannRational", {&mu, &alpha});
    for (std::size_t k = 0; k < mu.size(); ++k) {
      const double theta = std::acos(double(mu[k])), a = alpha[k];
      ASSERT_NEAR(ggx[k] * (1 + reference::ggx_lambda(theta, a)), 1, 1e-6) << mu[k] << ' ' << a;
      const double exact = 1 / (1 + reference::beckmann_lambda(theta, a));
      ASSERT_NEAR(beckmann[k] / exact, 1, 1e-6) << mu[k] << ' ' << a;
      ASSERT_NEAR(rational[k], exact, 0.0034) << mu[k] << ' ' << a;  // the fit's own error
    }
  }
}

// alpha = 0 masks nothing; mu = 1 is not masked.
TEST(SmithG1, IsOneWhereNothingMasks) {
  for (const float x : {1e-4f, 0.1f, 0.7f, 1.0f}) {
    EXPECT_NEAR(kernel::G1_SmithGGX(x, 0.0f), 1, 1e-6);
    EXPECT_NEAR(kernel::G1_SmithBeckmann(x, 0.0f), 1, 1e-6);
    EXPECT_NEAR(kernel::G1_SmithBeckmannRational(x, 0.0f), 1, 1e-6);
    EXPECT_NEAR(kernel::G1_SmithGGX(1.0f, x), 1, 1e-6);
    EXPECT_NEAR(kernel::G1_SmithBeckmann(1.0f, x), 1, 1e-6);
    EXPECT_NEAR(kernel::G1_SmithBeckmannRational(1.0f, x), 1, 1e-6);
  }
}

// The fit is cut at a = 1.6, where it is above 1: a step, of this height and no more.
TEST(SmithG1, RationalFitStepsAtItsCut) {
  const double alpha = 0.5, at = 1.6 * alpha / std::sqrt(1 + 1.6 * 1.6 * alpha * alpha);  // mu where a = 1.6
  const double below = kernel::G1_SmithBeckmannRational(at * (1 - 1e-9), alpha);
  EXPECT_EQ(kernel::G1_SmithBeckmannRational(at * (1 + 1e-9), alpha), 1);
  EXPECT_GT(below, 1);
  EXPECT_LT(below, 1 + 1e-4);
}

TEST(Azimuth, OfVectors) {
  for (const double phi : {0.0, 1e-3, 0.7, 2.0, 3.1}) {
    const reference::Vec3 v = reference::from_angles(1.1, 0.3), l = reference::from_angles(0.4, 0.3 + phi);
    const double along = reference::dot(v, l) - v.z * l.z, across = reference::cross(v, l).z;
    EXPECT_NEAR(kernel::azimuth_between(along, across), phi, 1e-12);
    EXPECT_NEAR(kernel::azimuth_between(along, -across), phi, 1e-12);
    EXPECT_NEAR(kernel::decorrelation_vanGinneken(2 * std::numbers::pi - phi), 4.41 * phi / (4.41 * phi + 1), 1e-12);
  }
  EXPECT_EQ(kernel::azimuth_between(0.0f, 0.0f), 0.0f);  // one direction is the normal: any will do
}

// Every corner of the domain, both directions in the horizon among them.
TEST(SmithVisibilities, FiniteAtTheEndsOfTheDomain) {
  const float ends[] = {0.0f, 1e-40f, 1e-20f, 1e-4f, 0.5f, 1.0f};
  for (const float v : ends)
    for (const float l : ends)
      for (const float alpha : ends)
        for (const float phi : {0.0f, 1e-40f, 3.1415927f, 6.2831855f})
          for (const float V :
               {kernel::V_SmithGGXSeparable(v, l, alpha), kernel::V_SmithGGXDirectionCorrelated(v, l, phi, alpha),
                kernel::V_SmithGGXHeightDirectionCorrelated(v, l, phi, alpha),
                kernel::V_SmithBeckmannSeparable(v, l, alpha), kernel::V_SmithBeckmannCorrelated(v, l, alpha),
                kernel::V_SmithBeckmannRationalSeparable(v, l, alpha),
                kernel::V_SmithBeckmannRationalCorrelated(v, l, alpha)}) {
            ASSERT_TRUE(V >= 0 && V <= 1e31f) << v << ' ' << l << ' ' << alpha << ' ' << phi << ": " << V;
          }
}

}  // namespace
}  // namespace tessera::test

#define TESSERA_ISA diffuse_split_test
#include "kernels/bsdf/diffuse_split.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/albedo.hpp"
#include "reference/fresnel.hpp"
#include "reference/quadrature.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;

TEST(Split, TermsAreTheFormulas) {
  std::vector<float> a, b, c, d;
  for (int i = 0; i < 625; ++i) {
    a.push_back(float(i % 5) / 4), b.push_back(float(i / 5 % 5) / 8), c.push_back(float(i / 25 % 5) / 8);
    d.push_back(float(i / 125) / 4);
  }
  for (const Kernels* kernels : runnable_kernels()) {
    const auto fresnel = evaluate_term(*kernels, "kd_Fresnel", {&a, &b});
    const auto scaled = evaluate_term(*kernels, "kd_AlbedoScaled", {&a, &b, &c, &d});
    const auto coupled = evaluate_term(*kernels, "kd_Coupled", {&a, &b, &c, &d});
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double x = a[i], y = b[i], z = c[i], metallic = d[i];
      ASSERT_NEAR(fresnel[i], (1 - x) * (1 - y), 1e-7);
      ASSERT_NEAR(scaled[i], (1 - x * y - z) * (1 - metallic), 2e-7);
      ASSERT_NEAR(coupled[i], (1 - x) * (1 - y) / (1 - z) * (1 - metallic), 4e-7);
    }
  }
}

// A dielectric over white Lambert, no absorption anywhere: specular and diffuse together return what? Scaling by
// albedo and coupling return all of it, by construction; Fresnel's weight does not.
TEST(Split, WhiteDielectricInAFurnace) {
  const double f0 = 0.04, roughness = 0.6, alpha = roughness * roughness;
  const auto E = [&](double mu) {
    const auto dfg = reference::directional_albedo(mu, alpha, 48);
    return f0 * dfg.A + dfg.B;
  };
  const double average = reference::integrate([&](double mu) { return 2 * mu * E(mu); }, 0, 1, 24);
  for (const double mu : {0.1, 0.5, 1.0}) {
    const auto dfg = reference::directional_albedo(mu, alpha, 48);
    const double scaled = kernel::kd_AlbedoScaled(f0, dfg.A, dfg.B, 0.0);
    EXPECT_NEAR(E(mu) + scaled, 1, 1e-12);
    const double coupled = reference::integrate(
        [&](double mu_l) { return 2 * mu_l * kernel::kd_Coupled(E(mu), E(mu_l), average, 0.0); }, 0, 1, 24);
    EXPECT_NEAR(E(mu) + coupled, 1, 1e-6);
    // With Fresnel's at n.v: what comes back lies below 1, for E < F(n.v) or so on a rough surface.
    const double fresnel = kernel::kd_Fresnel(reference::fresnel_schlick(f0, mu), 0.0);
    EXPECT_LT(E(mu) + fresnel, 1.001);
  }
  const double grazing = kernel::kd_Fresnel(reference::fresnel_schlick(f0, 0.1), 0.0);
  EXPECT_LT(E(0.1) + grazing, 0.8);
}

// kd(v,l) = kd(l,v)? Of v.h, yes, whatever is said of it; of n.v, no.
TEST(Split, Reciprocity) {
  const double f0 = 0.04, NoV = 0.1, NoL = 0.9;
  EXPECT_GT(std::abs(kernel::kd_Fresnel(reference::fresnel_schlick(f0, NoV), 0.0) -
                     kernel::kd_Fresnel(reference::fresnel_schlick(f0, NoL), 0.0)),
            0.5);
  EXPECT_EQ(kernel::kd_Coupled(0.3f, 0.7f, 0.2f, 0.0f), kernel::kd_Coupled(0.7f, 0.3f, 0.2f, 0.0f));
}

TEST(Split, EndsOfTheDomain) {
  EXPECT_EQ(kernel::kd_Fresnel(1.0f, 0.0f), 0);
  EXPECT_EQ(kernel::kd_Fresnel(0.0f, 1.0f), 0);
  EXPECT_EQ(kernel::kd_AlbedoScaled(1.0f, 0.9f, 0.11f, 0.0f), 0);  // A + B above 1: a fit's error
  EXPECT_EQ(kernel::kd_Coupled(1.0f, 1.0f, 1.0f, 0.0f), 0);        // a specular lobe that takes all
  EXPECT_EQ(kernel::kd_Coupled(0.0f, 0.0f, 0.0f, 0.0f), 1);
}

}  // namespace
}  // namespace tessera::test

#define TESSERA_ISA ggx_lobe_test
#include "kernels/bsdf/ggx_lobe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/microfacet.hpp"

namespace tessera::test {
namespace {

struct LobeInputs {
  std::vector<float> H2, NoH, tangential2, NoV, NoL, alpha;
  std::vector<double> expected;
};

// Pairs of directions above the horizon, half of them within a lobe's width of mirror reflection. The quantities are
// rounded once from double, so that the fused form's own arithmetic shows.
LobeInputs make_inputs() {
  LobeInputs in;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> gauss;
  while (in.expected.size() < 20003) {
    const double r = 0.045 + 0.955 * unit(random), alpha = r * r;
    const reference::Vec3 v = reference::from_angles(std::acos(1e-3 + 0.999 * unit(random)), 0);
    const bool near_mirror = unit(random) < 0.5;
    const reference::Vec3 mirror = {-v.x, 0, v.z};
    const double dx = gauss(random), dy = gauss(random), dz = gauss(random);
    const reference::Vec3 l = near_mirror ? reference::normalize(mirror + reference::Vec3{dx, dy, dz} * alpha)
                                          : reference::from_angles(std::acos(unit(random)), 6.28 * unit(random));
    if (l.z < 1e-3) continue;
    const reference::Vec3 H = l + v;
    in.H2.push_back(float(reference::dot(H, H)));
    in.NoH.push_back(float(H.z));
    in.tangential2.push_back(float(H.x * H.x + H.y * H.y));
    in.NoV.push_back(float(v.z));
    in.NoL.push_back(float(l.z));
    in.alpha.push_back(float(alpha));
    in.expected.push_back(reference::specular_brdf_over_fresnel(v, l, alpha));
  }
  return in;
}

TEST(DVGGX, IsDTimesV) {
  const LobeInputs in = make_inputs();
  for (const Kernels* kernels : runnable_kernels()) {
    const auto dv = evaluate_term(*kernels, "DV_GGX", {&in.H2, &in.NoH, &in.tangential2, &in.NoV, &in.NoL, &in.alpha});
    for (std::size_t k = 0; k < dv.size(); ++k)
      ASSERT_NEAR(dv[k] / in.expected[k], 1, 2e-6) << kernels->isa << " alpha " << in.alpha[k] << " NoV " << in.NoV[k];
  }
}

}  // namespace
}  // namespace tessera::test

#define TESSERA_ISA energy_test
#include "kernels/bsdf/energy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/albedo.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;

// A mirror-white metal must lose nothing: what a single bounce drops, the others return.
TEST(FdezAguera, WhiteMetalReflectsEverything) {
  for (const double r : {0.05, 0.3, 0.6, 1.0})
    for (const double mu : {0.05, 0.3, 0.7, 1.0}) {
      const auto dfg = reference::directional_albedo(mu, r * r, 32);
      const auto split =
          kernel::multiple_scattering_FdezAguera<double>({1, 1, 1}, dfg.A, dfg.B, kernel::schlick_weight(mu), r);
      EXPECT_NEAR(split.all.x, 1, 1e-12);
    }
}

// Fdez-Aguera 2019's series, summed bounce by bounce: each further bounce keeps Favg of what was left, of which Ess
// leaves. F_ms E_ms = sum over k >= 1 of FssEss (1 - Ess)^k Favg^k.
TEST(FdezAguera, IsTheGeometricSeriesOfBounces) {
  for (const double f0 : {0.04, 0.3, 0.9})
    for (const double r : {0.3, 0.7, 1.0})
      for (const double mu : {0.1, 0.5, 1.0}) {
        const auto dfg = reference::directional_albedo(mu, r * r, 32);
        const double weight = std::pow(1 - mu, 5), kS = f0 + (std::max(1 - r, f0) - f0) * weight;
        const double single = kS * dfg.A + dfg.B, Favg = f0 + (1 - f0) / 21;
        double multiple = 0;
        for (int k = 1; k < 200; ++k) multiple += single * std::pow((1 - dfg.E()) * Favg, k);
        const auto split = kernel::multiple_scattering_FdezAguera<double>({f0, 0, 1}, dfg.A, dfg.B, weight, r);
        EXPECT_NEAR(split.single.x, single, 1e-12);
        EXPECT_NEAR(split.all.x, single + multiple, 1e-12);
      }
}

}  // namespace
}  // namespace tessera::test

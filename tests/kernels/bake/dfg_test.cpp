#define TESSERA_ISA scalar_test
#include "kernels/bake/dfg.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/runnable_kernels.hpp"
#include "reference/albedo.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// Against a quadrature over other variables, in double, at the nodes of the default table. The rule's own error is
// largest, 7e-6, at grazing angles; float arithmetic adds 1e-6.
TEST(IntegrateDfg, MatchesTheReference) {
  for (const int j : {0, 1, 4, 12, 32, 64, 100, 127}) {
    for (const int i : {0, 1, 3, 8, 20, 48, 90, 127}) {
      const double mu = (i + 0.5) / 128, r = (j + 0.5) / 128;
      const reference::DirectionalAlbedo expected = reference::directional_albedo(mu, r * r, 192);
      const Dfg<double> exact = integrate_dfg(mu, r);
      const Dfg<float> single = integrate_dfg(float(mu), float(r));
      EXPECT_NEAR(exact.A, expected.A, 2e-5) << mu << " " << r;
      EXPECT_NEAR(exact.B, expected.B, 2e-5) << mu << " " << r;
      EXPECT_NEAR(double(single.A), exact.A, 1e-6) << mu << " " << r;
      EXPECT_NEAR(double(single.B), exact.B, 1e-6) << mu << " " << r;
    }
  }
}

// The catalogue's spot values, which are good to about 5e-5.
TEST(IntegrateDfg, MatchesPublishedValues) {
  const double values[4][4] = {{0.5, 0.5, 0.834916, 0.022347},
                               {0.25, 0.25, 0.758036, 0.203536},
                               {0.1, 0.1, 0.415817, 0.578358},
                               {1, 1, 0.306819, 0.000034}};
  for (const auto& [mu, r, A, B] : values) {
    const Dfg<double> dfg = integrate_dfg(mu, r);
    EXPECT_NEAR(dfg.A, A, 6e-5);
    EXPECT_NEAR(dfg.B, B, 6e-5);
  }
}

TEST(IntegrateDfg, StaysABrdfAtTheEndsOfItsDomain) {
  for (const float mu : {1e-6f, 1e-3f, 0.5f, 1.0f}) {
    for (const float r : {1e-10f, 1e-4f, 0.01f, 1.0f}) {
      const Dfg<float> dfg = integrate_dfg(mu, r);
      EXPECT_GE(dfg.A, 0) << mu << " " << r;
      EXPECT_GE(dfg.B, 0) << mu << " " << r;
      EXPECT_LE(dfg.A + dfg.B, 1.0001f) << mu << " " << r;
    }
  }
}

TEST(DfgTable, SameBitsOnEveryInstructionSetAndHoldsTheNodes) {
  for (const int size : {2, 7, 32}) {
    std::vector<float> first;
    for (const Kernels* kernels : runnable_kernels()) {
      std::vector<float> table(std::size_t(size * size * 2), -1.0f);
      for (int row = 0; row < size; ++row) kernels->dfg_table({table.data(), size, row, row + 1});
      if (first.empty()) first = table;
      ASSERT_EQ(table, first) << kernels->isa << " " << size;
    }
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) {
        const Dfg<double> node = integrate_dfg((i + 0.5) / size, (j + 0.5) / size);
        ASSERT_NEAR(double(first[std::size_t((j * size + i) * 2)]), node.A, 2e-6);
        ASSERT_NEAR(double(first[std::size_t((j * size + i) * 2 + 1)]), node.B, 2e-6);
      }
    }
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

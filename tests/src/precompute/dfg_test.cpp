#include "precompute/dfg.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "frame/dispatch.hpp"
#include "reference/albedo.hpp"

namespace tessera {
namespace {

// Bilinear, clamped: DfgView's rule.
double look_up(const DfgTable& table, double mu, double r, int c) {
  const double last = table.size - 1;
  const double x = std::clamp(mu * table.size - 0.5, 0.0, last), y = std::clamp(r * table.size - 0.5, 0.0, last);
  const int i = std::min(int(x), table.size - 2), j = std::min(int(y), table.size - 2);
  const auto at = [&](int a, int b) {
    return double(table.texels[std::size_t(((j + b) * table.size + i + a) * 2 + c)]);
  };
  const double wx = x - i, wy = y - j;
  return (at(0, 0) * (1 - wx) + at(1, 0) * wx) * (1 - wy) + (at(0, 1) * (1 - wx) + at(1, 1) * wx) * wy;
}

double worst_between_nodes(const DfgTable& table, double from_mu, double from_r) {
  double worst = 0;
  for (double mu = from_mu; mu < 1; mu += 0.0731) {
    for (double r = from_r; r < 1; r += 0.0577) {
      // The middle of a cell, where a linear axis errs most.
      const double m = (std::floor(mu * table.size) + 1) / table.size,
                   q = (std::floor(r * table.size) + 1) / table.size;
      if (m > 1 || q > 1) continue;
      const reference::DirectionalAlbedo exact = reference::directional_albedo(m, q * q, 64);
      worst =
          std::max({worst, std::abs(look_up(table, m, q, 0) - exact.A), std::abs(look_up(table, m, q, 1) - exact.B)});
    }
  }
  return worst;
}

// Linear axes are the limit between nodes.
TEST(DfgTable, IsCloseBetweenItsNodes) {
  const DfgTable table = build_dfg_table(select_kernels());
  ASSERT_EQ(table.size, 128);
  const double inside = worst_between_nodes(table, 0.1, 0.1);
  const double grazing = worst_between_nodes(table, 0.012, 0.03);
  RecordProperty("inside", std::to_string(inside));
  RecordProperty("grazing", std::to_string(grazing));
  EXPECT_LT(inside, 2e-4);
  EXPECT_LT(grazing, 4e-3);
}

TEST(DfgTable, SameBitsForAnyThreadCount) {
  const Kernels& kernels = select_kernels();
  const DfgTable first = build_dfg_table(kernels, 16);
  for (const int threads : {1, 2, 7}) {
    run_with_threads(threads, [&] { EXPECT_EQ(build_dfg_table(kernels, 16).texels, first.texels) << threads; });
  }
}

}  // namespace
}  // namespace tessera

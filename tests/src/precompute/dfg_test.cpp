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
  const auto at = [&](int a, int b) { return table.node(i + a, j + b)[std::size_t(c)]; };
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

// What the renderer reads: A and B within 1e-4 wherever a surface can be, far from the nodes or at them.
TEST(DfgTable, WarpedIsWithinATenThousandthEverywhere) {
  const DfgTable table = build_warped_dfg_table(select_kernels());
  const double last = table.size - 1;
  const auto at = [&](int i, int j, int c) { return table.node(i, j)[std::size_t(c)]; };
  double worst = 0;
  for (double mu = 1e-3; mu < 1; mu *= 1.137) {
    for (double r = 0.02; r < 1; r += 0.0377) {
      const double s = std::sqrt(mu), x = last * s * (1 + 2 * r) / (s + 2 * r), y = last * std::sqrt(r);
      const int i = std::min(int(x), table.size - 2), j = std::min(int(y), table.size - 2);
      const double wx = x - i, wy = y - j;
      const auto read = [&](int c) {
        return (at(i, j, c) * (1 - wx) + at(i + 1, j, c) * wx) * (1 - wy) +
               (at(i, j + 1, c) * (1 - wx) + at(i + 1, j + 1, c) * wx) * wy;
      };
      const double B = std::pow(1 - mu, 5) - read(1), A = 1 - read(0) - B;
      const reference::DirectionalAlbedo exact = reference::directional_albedo(mu, r * r, 96);
      worst = std::max({worst, std::abs(A - exact.A), std::abs(B - exact.B)});
    }
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 1e-4);
}

// With a border of copies, each node beside what lies below it; what is beyond a node's range is cut to it.
TEST(DfgTable, KeepsItsPairs) {
  constexpr int size = 3;
  const float pairs[size * size * 2] = {0,    1,    0.5f, 0.25f, 0.75f, -0.0156f, 0.1f, 0.2f,  0.3f,
                                        0.4f, 0.6f, 0.7f, 0.8f,  0.9f,  2,        -1,   0.55f, 0.45f};
  const DfgTable table(pairs, size);
  const int pitch = dfg_pitch(size);
  const auto number = [&](int row, int column, int k) {
    return table.view().nodes[(row * pitch + column) * dfg_node_shorts + k] * dfg_step + dfg_middle;
  };
  for (int row = 0; row < pitch; ++row)
    for (int column = 0; column < pitch; ++column)
      for (int k = 0; k < dfg_node_shorts; ++k) {
        const int i = std::clamp(column - 1, 0, size - 1), j = std::clamp(row - 1 + k % 2, 0, size - 1);
        const double expected = std::clamp(double(pairs[(j * size + i) * 2 + k / 2]), -1.0 / 64, 1.0);
        EXPECT_NEAR(number(row, column, k), expected, 8e-6) << row << " " << column << " " << k;
        if (k % 2 != 0) continue;
        EXPECT_EQ(table.node(i, j)[std::size_t(k / 2)], number(row, column, k));
      }
}

TEST(DfgTable, SameBitsForAnyThreadCount) {
  const Kernels& kernels = select_kernels();
  const DfgTable first = build_dfg_table(kernels, 16);
  for (const int threads : {1, 2, 7}) {
    run_with_threads(threads, [&] { EXPECT_EQ(build_dfg_table(kernels, 16).nodes, first.nodes) << threads; });
  }
}

}  // namespace
}  // namespace tessera

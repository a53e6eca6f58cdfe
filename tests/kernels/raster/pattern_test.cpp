#include <gtest/gtest.h>

#include "kernels/runnable_kernels.hpp"

namespace tessera {
namespace {

TEST(SamplePattern, IsTheStandardOne) {
  for (const Kernels* k : runnable_kernels()) {
    for (const int samples : {1, 2, 4, 8, 16}) {
      const SamplePattern p = k->sample_pattern(samples);
      ASSERT_EQ(p.count, samples);
      // From 4 samples on they form a "rooks" pattern: no two share a row or a column of the grid.
      const int cell = samples == 1 ? 256 : samples == 2 ? 128 : 256 / samples;
      std::uint32_t columns = 0, rows = 0;
      for (int s = 0; s < samples; ++s) {
        columns |= 1u << p.x[s] / cell;
        rows |= 1u << p.y[s] / cell;
        EXPECT_EQ(p.x[s] % 16, 0);
        EXPECT_EQ(p.y[s] % 16, 0);
      }
      EXPECT_EQ(columns, (1u << samples) - 1);
      EXPECT_EQ(rows, (1u << samples) - 1);
    }
    // Vulkan 1.3, table "Standard sample locations", in 1/16 pixel: one of each.
    const auto is = [&](int samples, int s, int x, int y) {
      const SamplePattern p = k->sample_pattern(samples);
      EXPECT_EQ(p.x[s], x * 16) << samples << ' ' << s;
      EXPECT_EQ(p.y[s], y * 16) << samples << ' ' << s;
    };
    is(1, 0, 8, 8), is(2, 0, 12, 12), is(2, 1, 4, 4);
    is(4, 0, 6, 2), is(4, 1, 14, 6), is(4, 2, 2, 10), is(4, 3, 10, 14);
    is(8, 0, 9, 5), is(8, 4, 3, 13), is(8, 7, 15, 1);
    is(16, 0, 9, 9), is(16, 12, 0, 8), is(16, 15, 1, 0);
  }
}

}  // namespace
}  // namespace tessera

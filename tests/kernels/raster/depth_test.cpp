// Depth, the depth test and its independence of order: kernels/raster/edges.hpp and coverage.hpp.
#include <gtest/gtest.h>

#include "kernels/raster/oracle.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::raster_test {
namespace {

class Visibility : public testing::TestWithParam<int> {};

TEST_P(Visibility, EqualsTheOracleInAnyOrder) {
  const int samples = GetParam();
  Random random(static_cast<std::uint64_t>(samples) * 77);
  for (int round = 0; round < 64 / samples; ++round) {
    const int x = random.between(0, 511) * tile_size, y = random.between(0, 511) * tile_size;
    const int width = round % 2 == 0 ? tile_size : random.between(1, tile_size);
    const int height = round % 2 == 0 ? tile_size : random.between(1, tile_size);
    const std::vector<SetupTriangle> soup = random_soup(random, x, y, 60);
    std::vector<std::uint32_t> list(soup.size());
    for (std::uint32_t i = 0; i < list.size(); ++i) list[i] = i;
    const Tile expected(x, y, width, height, samples);
    draw(expected, runnable_kernels().front()->sample_pattern(samples), soup);
    for (int order = 0; order < 3; ++order) {
      for (std::size_t i = list.size() - 1; order > 0 && i > 0; --i) std::swap(list[i], list[random.next() % (i + 1)]);
      for (const Kernels* k : runnable_kernels()) {
        const Tile tile(x, y, width, height, samples);
        std::fill_n(tile.view.depth, samples * tile_pixels, -3.0f);
        k->clear_visibility(tile.view);
        RasterCounters counters{};
        k->rasterize_opaque({tile.view, soup.data(), list.data(), static_cast<std::uint32_t>(list.size())}, &counters);
        EXPECT_EQ(tile.triangle, expected.triangle) << k->isa << " order " << order;
        ASSERT_TRUE(same_bits(tile.depth.data(), expected.depth.data(), expected.depth.size()))
            << k->isa << " order " << order;
        // What is hidden is found out in the order of drawing, and not always.
        EXPECT_GE(counters.samples_passed, static_cast<std::uint64_t>(std::ranges::count_if(
                                               expected.triangle, [](std::uint32_t t) { return t != no_triangle; })));
        EXPECT_GE(counters.samples_tested, counters.samples_passed);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, Visibility, testing::Values(1, 2, 4, 8, 16));

// Depth of a sample must not depend on which tile or path evaluates it: the same triangle, moved by whole tiles.
TEST(Depth, DoesNotDependOnThePlaceOfTheTile) {
  Random random(8);
  for (const Kernels* k : runnable_kernels()) {
    for (int round = 0; round < 50; ++round) {
      const std::vector<SetupTriangle> soup = random_soup(random, 0, 0, 1);
      SetupTriangle moved = soup[0];
      const int dx = random.between(0, 511) * tile_size, dy = random.between(0, 511) * tile_size;
      for (int i = 0; i < 3; ++i) {
        moved.x[i] += dx * 256;
        moved.y[i] += dy * 256;
      }
      const Tile here(0, 0, tile_size, tile_size, 4), there(dx, dy, tile_size, tile_size, 4);
      const std::uint32_t list = 0;
      RasterCounters counters{};
      k->rasterize_opaque({here.view, soup.data(), &list, 1}, &counters);
      k->rasterize_opaque({there.view, &moved, &list, 1}, &counters);
      EXPECT_EQ(here.depth, there.depth);
      EXPECT_EQ(here.triangle, there.triangle);
    }
  }
}

TEST(Depth, EqualDepthGoesToTheLowerTriangleAlsoBeyondTwoBillion) {
  for (const Kernels* k : runnable_kernels()) {
    std::vector<SetupTriangle> same(3, make_triangle(0, 8192, 8192, 8192, 8192, 0));
    same[0].triangle = 0xfffffff0u, same[1].triangle = 0x7fffffffu, same[2].triangle = 0x80000000u;
    const Tile tile(0, 0, tile_size, tile_size, 1);
    RasterCounters counters{};
    const std::uint32_t list[3] = {0, 2, 1};
    k->rasterize_opaque({tile.view, same.data(), list, 3}, &counters);
    EXPECT_EQ(tile.triangle[tile_pixel(31, 31)], 0x7fffffffu);
    EXPECT_EQ(tile.triangle[0], no_triangle);
  }
}

// The far plane of an orthographic camera is depth 0 and is seen; beyond it nothing is.
TEST(Depth, BeyondTheFarPlaneNothingIsSeen) {
  for (const Kernels* k : runnable_kernels()) {
    SetupTriangle t = make_triangle(0, 0, 0, 8192 * 4, 8192 * 4, 0);
    t.depth = 0.25f, t.depth_dx = -1.0f / 64, t.depth_min = -1, t.depth_max = 1;  // 0 at x = 16
    const Tile tile(0, 0, tile_size, tile_size, 1);
    RasterCounters counters{};
    const std::uint32_t list = 0;
    k->rasterize_opaque({tile.view, &t, &list, 1}, &counters);
    for (int x = 0; x < tile_size; ++x) EXPECT_EQ(tile.triangle[tile_pixel(x, 0)], x < 16 ? 0u : no_triangle) << x;
  }
}

}  // namespace
}  // namespace tessera::raster_test

#include <gtest/gtest.h>

#include "kernels/raster/oracle.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::raster_test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int scale = 20;  // sanitizers look for other things
#else
constexpr int scale = 1;
#endif

/// One triangle into an empty tile, by every instruction set, against the oracle.
class CoverageOracle {
 public:
  explicit CoverageOracle(int samples)
      : pattern_(kernels_.front()->sample_pattern(samples)), tile_(0, 0, tile_size, tile_size, samples) {}

  [[nodiscard]] int mismatches() const { return mismatches_; }
  [[nodiscard]] std::uint64_t covered() const { return covered_; }
  SetupTriangle worst{};

  void check(const SetupTriangle& t, int tile_x, int tile_y, int width = tile_size, int height = tile_size) {
    VisibilityTile& view = tile_.view;
    view.x = tile_x, view.y = tile_y, view.width = width, view.height = height;
    const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
    const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
    const int x0 = std::clamp((left >> 8) - tile_x, 0, width), x1 = std::clamp((right >> 8) + 1 - tile_x, 0, width);
    const int y0 = std::clamp((top >> 8) - tile_y, 0, height), y1 = std::clamp((bottom >> 8) + 1 - tile_y, 0, height);
    expected_.clear();
    for (int s = 0; s < pattern_.count; ++s)
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
          if (covers(t, (tile_x + x) * 256 + pattern_.x[s], (tile_y + y) * 256 + pattern_.y[s]))
            expected_.push_back(s * tile_pixels + tile_pixel(x, y));
    covered_ += expected_.size();
    const std::uint32_t list = 0;
    for (const Kernels* k : kernels_) {
      RasterCounters counters{};
      k->rasterize_opaque({view, &t, &list, 1}, &counters);
      // Everything expected was drawn; the number drawn says that nothing else was.
      bool same = counters.samples_passed == expected_.size() && counters.samples_tested == expected_.size();
      for (const int i : expected_) {
        same &= tile_.triangle[i] == t.triangle && tile_.depth[i] == t.depth;
        tile_.triangle[i] = no_triangle;
        tile_.depth[i] = 0;
      }
      if (!same) {
        ++mismatches_;
        worst = t;
        k->clear_visibility(view);
      }
    }
  }

 private:
  std::vector<const Kernels*> kernels_ = runnable_kernels();
  SamplePattern pattern_;
  Tile tile_;
  std::vector<int> expected_;
  int mismatches_ = 0;
  std::uint64_t covered_ = 0;
};

void expect_exact(const CoverageOracle& oracle) {
  const SetupTriangle& t = oracle.worst;
  EXPECT_EQ(oracle.mismatches(), 0) << "for example (" << t.x[0] << ',' << t.y[0] << ") (" << t.x[1] << ',' << t.y[1]
                                    << ") (" << t.x[2] << ',' << t.y[2] << ')';
  EXPECT_GT(oracle.covered(), 0u);
}

/// A triangle of at most `extent` pixels, somewhere at the tile; corners are multiples of `grid` / 256 pixel.
SetupTriangle small_triangle(Random& random, int tile_x, int tile_y, int extent, int grid) {
  const int range = extent * 256 / grid;
  const int x = tile_x * 256 + random.between(-range, tile_size * 256 / grid) * grid;
  const int y = tile_y * 256 + random.between(-range, tile_size * 256 / grid) * grid;
  const auto offset = [&] { return random.between(0, range) * grid; };
  const int x0 = x + offset(), y0 = y + offset(), x1 = x + offset(), y1 = y + offset(), x2 = x + offset();
  return make_triangle(x0, y0, x1, y1, x2, y + offset());
}

int random_tile(Random& random) { return random.between(0, max_frame_size / tile_size - 1) * tile_size; }

// Together at least 10^7 triangles for each instruction set.
TEST(Coverage, SmallTrianglesAreExact) {
  Random random(1);
  CoverageOracle oracle(1);
  for (int i = 0; i < 7500000 / scale; ++i) {
    const int x = random_tile(random), y = random_tile(random);
    SetupTriangle t = small_triangle(random, x, y, random.between(1, 5), 1);
    if (orient(t)) oracle.check(t, x, y);
  }
  expect_exact(oracle);
}

TEST(Coverage, EdgesThroughSamplesAreExact) {
  Random random(2);
  CoverageOracle oracle(1);
  for (int i = 0; i < 2000000 / scale; ++i) {
    const int x = random_tile(random), y = random_tile(random);
    SetupTriangle t = small_triangle(random, x, y, random.between(1, 6), i % 2 == 0 ? 128 : 64);
    if (orient(t)) oracle.check(t, x, y);
  }
  expect_exact(oracle);
}

TEST(Coverage, SliversAreExact) {
  Random random(3);
  CoverageOracle oracle(1);
  for (int i = 0; i < 1000000 / scale; ++i) {
    const int x = random_tile(random), y = random_tile(random);
    // A long edge, and a third vertex a few units off it.
    const auto around = [&](int tile) {
      return (tile + random.between(-16, tile_size + 16)) * 256 + random.between(0, 255);
    };
    const int x0 = around(x), y0 = around(y), x1 = x0 + random.between(-4096, 4096),
              y1 = y0 + random.between(-4096, 4096);
    const double along = random.unit() * 1.5 - 0.25;
    const int x2 = static_cast<int>(x0 + along * (x1 - x0)) + random.between(-2, 2);
    const int y2 = static_cast<int>(y0 + along * (y1 - y0)) + random.between(-2, 2);
    SetupTriangle t = make_triangle(x0, y0, x1, y1, x2, y2);
    if (orient(t)) oracle.check(t, x, y);
  }
  expect_exact(oracle);
}

TEST(Coverage, MediumTrianglesAndPartialTilesAreExact) {
  Random random(4);
  CoverageOracle oracle(1);
  for (int i = 0; i < 300000 / scale; ++i) {
    const int x = random_tile(random), y = random_tile(random);
    SetupTriangle t = small_triangle(random, x, y, random.between(8, 60), i % 3 == 0 ? 128 : 1);
    const int width = i % 2 == 0 ? tile_size : random.between(1, tile_size);
    if (orient(t)) oracle.check(t, x, y, width, random.between(1, tile_size));
  }
  expect_exact(oracle);
}

TEST(Coverage, HugeTrianglesAreExact) {
  Random random(5);
  CoverageOracle oracle(1);
  const auto anywhere = [&] { return random.between(-(1 << 22), 1 << 23); };
  for (int i = 0; i < 100000 / scale; ++i) {
    const int x = random_tile(random), y = random_tile(random);
    // Two vertices anywhere in the guard band; the third near the tile, anywhere, or on the band's corner.
    SetupTriangle t = small_triangle(random, x, y, 40, 1);
    t.x[1] = anywhere(), t.y[1] = anywhere(), t.x[2] = anywhere(), t.y[2] = anywhere();
    if (i % 3 == 0) t.x[0] = anywhere(), t.y[0] = anywhere();
    if (i % 5 == 0) t.x[2] = i % 2 == 0 ? -(1 << 22) : 1 << 23, t.y[2] = 1 << 23;
    if (orient(t)) oracle.check(t, x, y);
  }
  expect_exact(oracle);
}

class MultisampleCoverage : public testing::TestWithParam<int> {};

TEST_P(MultisampleCoverage, IsExact) {
  const int samples = GetParam();
  Random random(static_cast<std::uint64_t>(samples));
  CoverageOracle oracle(samples);
  for (int i = 0; i < 600000 / samples / scale; ++i) {
    const int x = random_tile(random), y = random_tile(random);
    const int extent = i % 16 == 0 ? 30 : random.between(1, 4);
    SetupTriangle t = small_triangle(random, x, y, extent, i % 4 == 0 ? 16 : 1);
    if (orient(t)) oracle.check(t, x, y, i % 8 == 0 ? random.between(1, tile_size) : tile_size);
  }
  expect_exact(oracle);
}

INSTANTIATE_TEST_SUITE_P(Samples, MultisampleCoverage, testing::Values(2, 4, 8, 16));

}  // namespace
}  // namespace tessera::raster_test

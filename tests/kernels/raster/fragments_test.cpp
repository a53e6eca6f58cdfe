#include <gtest/gtest.h>

#include <map>

#include "kernels/raster/oracle.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::raster_test {
namespace {

bool same(const Fragment& a, const Fragment& b) {
  return a.triangle == b.triangle && a.pixel == b.pixel && a.samples == b.samples;
}

void expect_same(const std::vector<Fragment>& got, const std::vector<Fragment>& expected, const char* isa) {
  ASSERT_EQ(got.size(), expected.size()) << isa;
  for (std::size_t i = 0; i < got.size(); ++i) {
    ASSERT_TRUE(same(got[i], expected[i]))
        << isa << " fragment " << i << ": triangle " << got[i].triangle << " pixel " << got[i].pixel << " samples "
        << got[i].samples << ", expected " << expected[i].triangle << ' ' << expected[i].pixel << ' '
        << expected[i].samples;
  }
}

class Fragments : public testing::TestWithParam<int> {
 protected:
  int samples = GetParam();
  SamplePattern pattern = runnable_kernels().front()->sample_pattern(samples);

  [[nodiscard]] std::vector<Fragment> collect(const Kernels& k, const Tile& tile, const SetupTriangle& t,
                                              bool split) const {
    std::vector<Fragment> out(std::size_t(tile_pixels) * samples);
    out.resize(k.collect_triangle(tile.view, t, split, out.data()));
    return out;
  }
};

TEST_P(Fragments, CollectTriangleThenCommitEqualsTheOracle) {
  Random random(static_cast<std::uint64_t>(samples) + 5);
  for (int round = 0; round < 24; ++round) {
    const int x = random.between(0, 511) * tile_size, y = random.between(0, 511) * tile_size;
    const int width = round % 2 == 0 ? tile_size : random.between(1, tile_size);
    const int height = round % 2 == 0 ? tile_size : random.between(1, tile_size);
    const std::vector<SetupTriangle> soup = random_soup(random, x, y, 12);
    for (const Kernels* k : runnable_kernels()) {
      const Tile tile(x, y, width, height, samples), expected(x, y, width, height, samples);
      for (const SetupTriangle& t : soup) {
        // What draws t over the tile so far is what passes.
        const Tile before(x, y, width, height, samples);
        std::copy(expected.depth.begin(), expected.depth.end(), before.view.depth);
        std::copy(expected.triangle.begin(), expected.triangle.end(), before.view.triangle);
        draw(expected, pattern, {t});
        std::vector<Fragment> whole, single;
        for (int p = 0; p < tile_pixels; ++p) {
          Fragment f{t.triangle, static_cast<std::uint16_t>(p), 0};
          for (int s = 0; s < samples; ++s) {
            const int i = s * tile_pixels + p;
            if (expected.triangle[i] == before.triangle[i] && expected.depth[i] == before.depth[i]) continue;
            f.samples = static_cast<std::uint16_t>(f.samples | 1u << s);
            single.push_back({t.triangle, f.pixel, static_cast<std::uint16_t>(1u << s)});
          }
          if (f.samples != 0) whole.push_back(f);
        }
        expect_same(collect(*k, tile, t, false), whole, k->isa);
        const std::vector<Fragment> fragments = collect(*k, tile, t, true);
        expect_same(fragments, single, k->isa);
        // An alpha test rejects some of them.
        std::vector<std::uint8_t> keep(fragments.size());
        for (std::size_t i = 0; i < keep.size(); ++i) {
          keep[i] = random.between(0, 3) != 0;
          const int at = __builtin_ctz(fragments[i].samples) * tile_pixels + fragments[i].pixel;
          if (keep[i] == 0) {
            expected.view.depth[at] = before.depth[at];
            expected.view.triangle[at] = before.triangle[at];
          }
        }
        k->commit_fragments(tile.view, t, fragments.data(), keep.data(), static_cast<std::uint32_t>(keep.size()));
        ASSERT_EQ(tile.depth, expected.depth) << k->isa;
        ASSERT_EQ(tile.triangle, expected.triangle) << k->isa;
      }
    }
  }
}

TEST_P(Fragments, CommittingLateKeepsTheNearest) {
  Random random(static_cast<std::uint64_t>(samples) + 9);
  const std::vector<SetupTriangle> soup = random_soup(random, 64, 32, 20);
  for (const Kernels* k : runnable_kernels()) {
    const Tile tile(64, 32, tile_size, tile_size, samples), expected(64, 32, tile_size, tile_size, samples);
    draw(expected, pattern, soup);
    std::vector<std::vector<Fragment>> all;
    for (const SetupTriangle& t : soup) all.push_back(collect(*k, tile, t, false));
    for (std::size_t i = 0; i < soup.size(); ++i) {
      const std::vector<std::uint8_t> keep(all[i].size(), 1);
      k->commit_fragments(tile.view, soup[i], all[i].data(), keep.data(), static_cast<std::uint32_t>(keep.size()));
    }
    EXPECT_EQ(tile.depth, expected.depth) << k->isa;
    EXPECT_EQ(tile.triangle, expected.triangle) << k->isa;
  }
}

TEST_P(Fragments, CollectVisibleListsDistinctPairsInOrder) {
  Random random(static_cast<std::uint64_t>(samples) + 11);
  for (int round = 0; round < 40; ++round) {
    const int width = random.between(1, tile_size), height = random.between(1, tile_size);
    const Tile tile(0, 0, width, height, samples);
    const int different = round % 4;  // 0: nothing but emptiness, and in the end all 16 samples may differ
    for (int s = 0; s < samples; ++s)
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const bool copy = s > 0 && random.between(0, 2) != 0;
          const int p = tile_pixel(x, y);
          const auto id = static_cast<std::uint32_t>(random.next() >> 32);
          tile.view.triangle[s * tile_pixels + p] = different == 0   ? no_triangle
                                                    : copy           ? tile.view.triangle[p]
                                                    : id % 3 == 0    ? no_triangle
                                                    : different == 1 ? id % 4
                                                                     : id;
        }
    std::vector<Fragment> expected;
    for (int p = 0; p < tile_pixels; ++p) {
      std::map<std::uint32_t, std::uint32_t> seen;
      for (int s = 0; s < samples; ++s) seen[tile.triangle[std::size_t(s) * tile_pixels + p]] |= 1u << s;
      for (const auto& [triangle, mask] : seen)
        if (triangle != no_triangle)
          expected.push_back({triangle, static_cast<std::uint16_t>(p), static_cast<std::uint16_t>(mask)});
    }
    for (const Kernels* k : runnable_kernels()) {
      std::vector<Fragment> got(std::size_t(tile_pixels) * samples);
      got.resize(k->collect_visible(tile.view, got.data()));
      expect_same(got, expected, k->isa);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, Fragments, testing::Values(1, 2, 4, 8, 16));

}  // namespace
}  // namespace tessera::raster_test

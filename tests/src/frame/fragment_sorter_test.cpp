// The order of compositing, against a plain sort of everything.
#include "frame/fragment_sorter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

namespace tessera {
namespace {

struct Case {
  std::size_t opaque, transparent;
  int pixels, depths;  // how many different ones
  bool in_order;
};

TEST(FragmentSorter, SortsAsAPlainSortDoes) {
  std::mt19937 random(17);
  FragmentSorter sorter;  // one for all: what is left of a tile must not show in the next
  for (const Case& c : {Case{0, 1, 1, 1, true},
                        {1, 1, 1, 1, false},
                        {1000, 1, 1024, 50, false},
                        {1024, 1024, 1024, 2, true},
                        {900, 4000, 1024, 1000, false},
                        {0, 5000, 40, 7, false},
                        {64, 3000, 3, 100000, true},
                        {0, 300, 1024, 3, false}}) {
    // Distinct fragments; the opaque ones by pixel and triangle.
    std::set<std::tuple<std::uint16_t, std::uint32_t, std::uint16_t>> taken;
    std::vector<Fragment> opaque, transparent;
    const auto draw = [&](std::vector<Fragment>& out) {
      Fragment f{std::uint32_t(random() % 5000), std::uint16_t(int(random() % 1024) % c.pixels),
                 std::uint16_t(1 + random() % 3)};
      if (taken.insert({f.pixel, f.triangle, f.samples}).second) out.push_back(f);
    };
    while (opaque.size() < c.opaque) draw(opaque);
    while (transparent.size() < c.transparent) draw(transparent);
    std::sort(opaque.begin(), opaque.end(), [](const Fragment& a, const Fragment& b) {
      return std::tie(a.pixel, a.triangle, a.samples) < std::tie(b.pixel, b.triangle, b.samples);
    });

    TileFragments tile;
    tile.fragments.assign(opaque.begin(), opaque.end());
    tile.fragments.insert(tile.fragments.end(), transparent.begin(), transparent.end());
    const auto count = static_cast<std::uint32_t>(tile.fragments.size());
    tile.reserve_planes(count);
    tile.in_order = c.in_order;
    for (std::uint32_t i = 0; i < count; ++i) tile.slots.push_back(i);
    if (!c.in_order) std::shuffle(tile.slots.begin(), tile.slots.end(), random);
    for (std::uint32_t i = 0; i < count; ++i)
      tile.gbuffer().depth[tile.slot(i)] = float(int(random() % 100000) % c.depths) / float(c.depths);

    struct Entry {
      Fragment fragment;
      std::uint32_t slot;
      float depth;
    };
    std::vector<Entry> expected;
    std::set<std::uint16_t> through;
    for (const Fragment& f : transparent) through.insert(f.pixel);
    for (std::uint32_t i = 0; i < count; ++i)
      expected.push_back({tile.fragments[i], tile.slot(i), tile.gbuffer().depth[tile.slot(i)]});
    std::sort(expected.begin(), expected.end(), [&](const Entry& a, const Entry& b) {
      const bool sees = through.contains(a.fragment.pixel);
      return std::tuple(a.fragment.pixel, sees ? -a.depth : 0, a.fragment.triangle, a.fragment.samples) <
             std::tuple(b.fragment.pixel, sees ? -b.depth : 0, b.fragment.triangle, b.fragment.samples);
    });

    sorter.sort(tile, opaque.size());
    EXPECT_FALSE(tile.in_order);
    ASSERT_EQ(tile.fragments.size(), count);
    for (std::uint32_t i = 0; i < count; ++i) {
      ASSERT_EQ(tile.fragments[i].pixel, expected[i].fragment.pixel) << i;
      ASSERT_EQ(tile.fragments[i].triangle, expected[i].fragment.triangle) << i;
      ASSERT_EQ(tile.fragments[i].samples, expected[i].fragment.samples) << i;
      ASSERT_EQ(tile.slots[i], expected[i].slot) << i;
    }
  }
}

}  // namespace
}  // namespace tessera

// The compositor against a sample-by-sample "over" in double.
#include "frame/composite.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "golden/builder.hpp"

namespace tessera {
namespace {

TEST(Composite, AgreesWithSampleBySampleOver) {
  golden::Random random(7);
  for (const int samples : {1, 2, 4, 8, 16}) {
    TileFragments tile;
    for (int pixel = 0; pixel < tile_pixels; pixel += 1 + static_cast<int>(random.next() % 3))
      for (int n = static_cast<int>(random.next() % 5); n > 0; --n)
        tile.fragments.push_back({0, static_cast<std::uint16_t>(pixel),
                                  static_cast<std::uint16_t>(1 + random.next() % ((1u << samples) - 1))});
    const auto count = static_cast<std::uint32_t>(tile.fragments.size());
    tile.reserve_planes(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      tile.slots.push_back(count - 1 - i);
      tile.gbuffer().alpha[i] = random.next() % 3 == 0 ? 1.0f : static_cast<float>(random.uniform());
      for (float* plane : tile.radiance()) plane[i] = static_cast<float>(random.between(0, 10));
    }
    CompositeScratch scratch;
    composite_surfaces(tile, samples, scratch);
    for (int pixel = 0; pixel < tile_pixels; ++pixel) {
      double expected[4] = {}, left = 0;
      for (int s = 0; s < samples; ++s) {
        double t = 1;
        for (std::uint32_t i = 0; i < count; ++i) {
          if (tile.fragments[i].pixel != pixel || !(tile.fragments[i].samples >> s & 1)) continue;
          const std::uint32_t slot = tile.slots[i];
          const double a = tile.gbuffer().alpha[slot];
          for (int k = 0; k < 3; ++k) expected[k] += t * a * tile.radiance()[k][slot] / samples;
          expected[3] += t * a / samples;
          t *= 1 - a;
        }
        left += t / samples;
      }
      for (int k = 0; k < 4; ++k)
        ASSERT_NEAR(scratch.rgba[4 * pixel + k], expected[k], 2e-5)
            << "pixel " << pixel << ", " << samples << " samples";
      ASSERT_NEAR(scratch.remaining[pixel], left, 1e-6);
    }
  }
}

}  // namespace
}  // namespace tessera

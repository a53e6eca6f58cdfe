// The compositor against a sample-by-sample "over" in double.
#include "frame/composite.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "frame/dispatch.hpp"
#include "golden/builder.hpp"
#include "golden/scenes.hpp"
#include "precompute/environment.hpp"

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
    TilePixels pixels;
    composite_surfaces(tile, samples, pixels);
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
        ASSERT_NEAR(pixels.rgba[k][pixel], expected[k], 2e-5) << "pixel " << pixel << ", " << samples << " samples";
      ASSERT_NEAR(pixels.remaining[pixel], left, 1e-6);
    }
  }
}

TEST(Composite, ATileOfBackgroundAloneIsWhatCompositingNothingGives) {
  const Kernels& kernels = select_kernels();
  const Environment environment = build_environment(golden::golden_environment(), {}, kernels);
  Camera camera;
  const View view = make_view(camera, 100, 70, kernels);
  for (const Background kind : {Background::color, Background::transparent, Background::environment}) {
    const BackgroundSource background{kind, {0.25f, -0.0f, 7}, environment.view().background, 1.5f};
    TilePixels pixels, other;
    std::vector<float> expected(std::size_t{4} * 40 * tile_size, -3), got = expected;
    const auto film = [&](std::vector<float>& rgba) { return TileFilm{64, 32, 31, 27, rgba.data(), 4 * 40}; };
    composite_surfaces(TileFragments(), 4, pixels);
    composite_background(background, view, kernels, pixels, film(expected));
    background_alone(background, view, kernels, other, film(got));
    EXPECT_EQ(0, std::memcmp(got.data(), expected.data(), got.size() * sizeof(float))) << static_cast<int>(kind);
  }
}

}  // namespace
}  // namespace tessera

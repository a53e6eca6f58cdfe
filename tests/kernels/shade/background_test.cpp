// The background kernel against lookups in double along each pixel's ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/light/test_cube.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::test {
namespace {

struct Planes {
  alignas(64) float rgba[4][tile_pixels], remaining[tile_pixels];
  // What surfaces left: some pixels all covered, some open, some between.
  Planes() {
    std::mt19937 random(5);
    for (auto& plane : rgba)
      for (float& x : plane) x = float(random() % 256) / 256;
    for (int i = 0; i < tile_pixels; ++i) remaining[i] = i < 300 ? 0.0f : float(random() % 5) / 4;
  }
};

// A tile somewhere in a picture whose rays cross three faces.
BackgroundArgs tile_of_rays(Planes& planes) {
  BackgroundArgs args{};
  const float corner[3] = {-1.1f, 0.4f, -1.0f}, dx[3] = {0.011f, 0.001f, 0.004f}, dy[3] = {0.0005f, -0.009f, 0.002f};
  std::copy_n(corner, 3, args.corner);
  std::copy_n(dx, 3, args.dx);
  std::copy_n(dy, 3, args.dy);
  args.x = 64;
  args.y = 32;
  args.width = args.height = tile_size;
  for (int k = 0; k < 4; ++k) args.rgba[k] = planes.rgba[k];
  return args;
}

Color behind(const BackgroundArgs& args, const TestCube& cube, int pixel) {
  const double x = args.x + tile_pixel_x(pixel) + 0.5, y = args.y + tile_pixel_y(pixel) + 0.5;
  const auto along = [&](int k) { return double(args.corner[k]) + x * double(args.dx[k]) + y * double(args.dy[k]); };
  return cube.sample({along(0), along(1), along(2)}, args.lod);
}

TEST(Background, IsTheCubeAlongThePixelsRays) {
  const TestCube cube(16);
  for (const Kernels* kernels : runnable_kernels())
    for (const float lod : {0.0f, 1.0f, 1.75f, 4.0f, -1.0f, 99.0f})
      for (const bool alone : {false, true}) {
        const Planes before;
        Planes after;
        BackgroundArgs args = tile_of_rays(after);
        args.cube = cube.view();
        args.lod = lod;
        if (!alone) args.remaining = after.remaining;
        kernels->background(args);
        for (int i = 0; i < tile_pixels; ++i) {
          const Color expected = behind(args, cube, i);
          const double open = alone ? 1 : double(before.remaining[i]);
          for (std::size_t k = 0; k < 3; ++k)
            ASSERT_NEAR(double(after.rgba[k][i]), (alone ? 0 : double(before.rgba[k][i])) + open * expected[k], 0.02)
                << kernels->isa << " lod " << lod << " pixel " << i;
          ASSERT_EQ(after.rgba[3][i], open > 0 ? 1.0f : before.rgba[3][i]);
        }
      }
}

TEST(Background, WithoutACubeIsOneColor) {
  for (const Kernels* kernels : runnable_kernels()) {
    const Planes before;
    Planes after;
    BackgroundArgs args = tile_of_rays(after);
    args.color[0] = 0.25f;
    args.color[1] = -0.0f;
    args.color[2] = 7;
    args.remaining = after.remaining;
    kernels->background(args);
    for (int i = 0; i < tile_pixels; ++i)
      for (int k = 0; k < 3; ++k)
        ASSERT_EQ(after.rgba[k][i], before.rgba[k][i] + before.remaining[i] * args.color[k]) << kernels->isa;
    args.remaining = nullptr;
    kernels->background(args);
    for (int i = 0; i < tile_pixels; ++i) {
      for (int k = 0; k < 3; ++k) ASSERT_EQ(after.rgba[k][i], args.color[k]);
      ASSERT_FALSE(std::signbit(after.rgba[1][i]));
      ASSERT_EQ(after.rgba[3][i], 1.0f);
    }
  }
}

TEST(Background, FillsTheVisiblePart) {
  for (const Kernels* kernels : runnable_kernels())
    for (const int width : {1, 7, 20, 32})
      for (const int height : {1, 10, 32}) {
        Planes after;
        BackgroundArgs args = tile_of_rays(after);
        args.width = width;
        args.height = height;
        args.color[0] = 3;
        kernels->background(args);
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) ASSERT_EQ(after.rgba[0][tile_pixel(x, y)], 3.0f) << kernels->isa;
      }
}

}  // namespace
}  // namespace tessera::test

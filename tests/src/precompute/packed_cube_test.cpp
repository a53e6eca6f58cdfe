#include "precompute/packed_cube.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/half.hpp"
#include "frame/dispatch.hpp"

namespace tessera {
namespace {

// EXT_texture_shared_exponent, by arithmetic.
double channel(const CubeView& cube, std::size_t texel, int c) {
  const std::uint64_t word = cube.texels[2 * texel] + 65536ull * cube.texels[2 * texel + 1];
  return std::ldexp(double((word >> (9 * c)) % 512), int(word >> 27) - 24);
}

TEST(PackedCube, EveryTexelIsTheNearest) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> exponent(-20, 15.9f), share(0, 1);
  constexpr int size = 32, levels = 4;
  Cube cube(size, levels);
  for (int level = 0; level < levels; ++level) {
    CubeLevel floats(size >> level);
    for (std::size_t i = 0; i < floats.texels.size(); i += 4) {
      const float brightest = std::exp2(exponent(random));
      for (std::size_t c = 0; c < 3; ++c) floats.texels[i + c] = brightest * share(random);
    }
    cube.store(level, floats, select_kernels());
  }
  const PackedCube packed(cube, select_kernels());
  const CubeView view = packed.view(), halves = cube.view();
  EXPECT_EQ(view.format, CubeFormat::rgb9_e5);
  EXPECT_EQ(view.size, size);
  EXPECT_EQ(view.levels, levels);
  EXPECT_LE(packed.bytes(), cube.texels().size() + 4);  // half of two bytes each
  for (std::size_t i = 0; i < cube_texel_count(size, levels); ++i) {
    double expected[3], largest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      expected[c] = double(half_to_float(halves.texels[4 * i + c]));
      largest = std::max(largest, expected[c]);
    }
    // Half a unit of nine bits of the largest channel, or of the smallest exponent. A channel that would round to 512
    // takes the next exponent: 511.5 of 512.
    const double bound = std::max(largest * (1.0 / 511), 0x1p-25);
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(channel(view, i, c), expected[c], bound) << i;
  }
}

TEST(PackedCube, SameOnEveryInstructionSet) {
  Cube cube(8, 2);
  CubeLevel level(8);
  for (std::size_t i = 0; i < level.texels.size(); ++i) level.texels[i] = float(i % 97) * 0.37f;
  cube.store(0, level, select_kernels());
  const PackedCube first(cube, *built_kernels()[0]);
  const std::size_t words = 2 * cube_texel_count(8, 2);
  for (const Kernels* kernels : built_kernels()) {
    if (!cpu_runs(*kernels)) continue;
    const PackedCube other(cube, *kernels);
    EXPECT_TRUE(std::equal(first.view().texels, first.view().texels + words, other.view().texels)) << kernels->isa;
  }
}

}  // namespace
}  // namespace tessera

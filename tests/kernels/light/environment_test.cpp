#define TESSERA_ISA scalar_test
#include "kernels/light/environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "kernels/light/test_cube.hpp"
#include "kernels/runnable_kernels.hpp"
#include "kernels/shade/stages.hpp"
#include "precompute/dfg.hpp"

namespace tessera::TESSERA_ISA {
namespace {

using test::Color;
using test::Direction;
using test::TestCube;

std::vector<Direction> test_directions() {
  std::vector<Direction> directions;
  for (int x = -1; x <= 1; ++x)  // all ties
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) directions.push_back({double(x), double(y), double(z)});
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (int i = 0; i < 4000; ++i) {
    Direction d{uniform(random), uniform(random), uniform(random)};
    if (i % 4 == 0) d.y = d.x + 1e-3 * d.y;  // near an edge
    if (i % 8 == 0) d.z = d.x - 1e-3 * d.z;  // near a corner
    directions.push_back({float(d.x), float(d.y), float(d.z)});
  }
  return directions;
}

constexpr double test_lods[] = {0, 0.25, 1, 1.75, 3.5, -2, 99};

TEST(SampleCube, MatchesItsDefinition) {
  for (const int size : {1, 2, 4, 16, 64}) {
    const TestCube cube(size);
    for (const Direction& d : test_directions()) {
      for (const double lod : test_lods) {
        const Color expected = cube.sample(d, lod);
        const Vec3<double> exact = sample_cube(cube.view(), Vec3<double>{d.x, d.y, d.z}, lod);
        const Vec3<float> single =
            sample_cube(cube.view(), Vec3<float>{float(d.x), float(d.y), float(d.z)}, float(lod));
        ASSERT_NEAR(exact.x, expected[0], 1e-9) << size << " " << d.x << " " << d.y << " " << d.z << " " << lod;
        ASSERT_NEAR(exact.y, expected[1], 1e-9);
        ASSERT_NEAR(exact.z, expected[2], 1e-9);
        // A texel coordinate errs by about 2 ulp of the size; texels differ by up to 1020.
        const double tolerance = 1020 * (size * 4e-7 + 1e-6);
        ASSERT_NEAR(double(single.x), expected[0], tolerance);
        ASSERT_NEAR(double(single.y), expected[1], tolerance);
        ASSERT_NEAR(double(single.z), expected[2], tolerance);
      }
    }
  }
}

TEST(SampleCube, TexelsInFewerBitsGiveTheSame) {
  const TestCube cube(16);
  const std::vector<Direction> directions = test_directions();
  for (std::size_t i = 0; i + Float::lanes <= directions.size(); i += Float::lanes) {
    float x[Float::lanes], y[Float::lanes], z[Float::lanes], lod[Float::lanes];
    for (std::size_t k = 0; k < Float::lanes; ++k) {
      x[k] = float(directions[i + k].x), y[k] = float(directions[i + k].y), z[k] = float(directions[i + k].z);
      lod[k] = float(test_lods[(i + 3 * k) % std::size(test_lods)]);
    }
    const Vec3<Float> packed = sample_cube<Rgb9e5Texels>(
        cube.packed_view(), Vec3<Float>{load<Float>(x), load<Float>(y), load<Float>(z)}, load<Float>(lod));
    for (int k = 0; k < Float::lanes; ++k) {
      const Vec3<float> d{x[k], y[k], z[k]};
      const Vec3<float> plain = sample_cube(cube.view(), d, lod[k]);
      const Vec3<float> single = sample_cube<Rgb9e5Texels>(cube.packed_view(), d, lod[k]);
      ASSERT_EQ(lane(packed.x, k), plain.x);
      ASSERT_EQ(lane(packed.y, k), plain.y);
      ASSERT_EQ(lane(packed.z, k), plain.z);
      ASSERT_EQ(single.x, plain.x);
      ASSERT_EQ(single.y, plain.y);
      ASSERT_EQ(single.z, plain.z);
    }
  }
}

// EXT_texture_shared_exponent: red_s * 2^(exp_shared - 15 - 9), from the lowest bits on.
TEST(Rgb9e5, EveryExponentIsDecodedExactly) {
  std::mt19937 random(9);
  for (int exponent = 0; exponent < 32; ++exponent)
    for (int i = 0; i < 64; ++i) {
      const int c[3] = {int(random() % 512), i == 0 ? 0 : int(random() % 512), i == 1 ? 511 : int(random() % 512)};
      const auto word = std::int32_t(unsigned(c[0]) + 512u * unsigned(c[1]) + 262144u * unsigned(c[2]) +
                                     134217728u * unsigned(exponent));
      const Vec3<float> single = decode_rgb9e5<float>(word);
      const Vec3<Float> many = decode_rgb9e5<Float>(Int(word));
      ASSERT_EQ(single.x, std::ldexp(float(c[0]), exponent - 24));
      ASSERT_EQ(single.y, std::ldexp(float(c[1]), exponent - 24));
      ASSERT_EQ(single.z, std::ldexp(float(c[2]), exponent - 24));
      ASSERT_EQ(lane(many.x, 0), single.x);
      ASSERT_EQ(lane(many.y, Float::lanes - 1), single.y);
      ASSERT_EQ(lane(many.z, 0), single.z);
    }
}

TEST(SampleCube, VectorsEqualScalarsToTheBit) {
  const TestCube cube(16);
  const std::vector<Direction> directions = test_directions();
  for (std::size_t i = 0; i + Float::lanes <= directions.size(); i += Float::lanes) {
    float x[Float::lanes], y[Float::lanes], z[Float::lanes], lod[Float::lanes];
    for (std::size_t k = 0; k < Float::lanes; ++k) {
      x[k] = float(directions[i + k].x), y[k] = float(directions[i + k].y), z[k] = float(directions[i + k].z);
      lod[k] = float(test_lods[(i + 3 * k) % std::size(test_lods)]);
    }
    const Vec3<Float> d{load<Float>(x), load<Float>(y), load<Float>(z)};
    const Vec3<Float> varying = sample_cube(cube.view(), d, load<Float>(lod));
    const Vec3<Float> uniform = sample_cube_uniform(cube.view(), d, lod[0]);
    for (int k = 0; k < Float::lanes; ++k) {
      const Vec3<float> one{x[k], y[k], z[k]};
      const Vec3<float> a = sample_cube(cube.view(), one, lod[k]), b = sample_cube_uniform(cube.view(), one, lod[0]);
      ASSERT_EQ(lane(varying.x, k), a.x);
      ASSERT_EQ(lane(varying.z, k), a.z);
      ASSERT_EQ(lane(uniform.x, k), b.x);
      ASSERT_EQ(lane(uniform.z, k), b.z);
    }
  }
}

// Through the one entry that reads a cube along given directions: a lobe of a single point.
TEST(SampleCube, SameBitsOnEveryInstructionSet) {
  const TestCube cube(16);
  constexpr int size = 8;
  for (int i = 0; i < 64; ++i) {
    const Direction d = test_directions()[std::size_t(30 + i)];
    const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    const float x = float(d.x / length), y = float(d.y / length), z = float(d.z / length), weight = 1;
    const float lod = float(test_lods[std::size_t(i) % std::size(test_lods)]);
    std::vector<float> first;
    for (const Kernels* kernels : runnable_kernels()) {
      std::vector<float> texels(size * size * 4);
      kernels->prefilter_cube({cube.view(), {&x, &y, &z, &weight, &lod, 1}, {i % 6, size, 0, size, texels.data()}, {}});
      if (first.empty()) first = texels;
      ASSERT_EQ(texels, first) << kernels->isa;
    }
  }
}

TEST(SampleCube, AnyBitsGiveATexelOfTheCube) {
  const TestCube cube(16);
  constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {0.0f, -0.0f, nan, inf, -inf, 1e-44f, 3e38f, -1.0f})
    for (const float y : {0.0f, nan, inf, 1e-44f, 3e38f, 1.0f})
      for (const float z : {0.0f, nan, -inf, 1e-44f, 3e38f, 1.0f})
        for (const float lod : {nan, inf, -inf, 1e30f, 2.5f}) {
          const Vec3<float> c = sample_cube(cube.view(), Vec3<float>{x, y, z}, lod);
          for (const float value : {c.x, c.y, c.z}) {
            ASSERT_GE(value, 0.0f);
            ASSERT_LE(value, 1020.001f);
          }
        }
}

TEST(Irradiance, IsTheSeries) {
  float sh[9][3];
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (auto& row : sh)
    for (float& value : row) value = uniform(random);
  for (int i = 0; i < 1000; ++i) {
    Direction n{uniform(random), uniform(random), uniform(random)};
    const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    n = {n.x / length, n.y / length, n.z / length};
    const double basis[9] = {
        1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
    for (int c = 0; c < 3; ++c) {
      const double got = irradiance(irradiance_polynomial<double>(sh, c), Vec3<double>{n.x, n.y, n.z});
      const float single =
          irradiance(irradiance_polynomial<float>(sh, c), Vec3<float>{float(n.x), float(n.y), float(n.z)});
      double sum = 0;
      for (std::size_t k = 0; k < 9; ++k) sum += double(sh[k][c]) * basis[k];
      ASSERT_NEAR(got, std::max(sum, 0.0), 1e-14);
      ASSERT_NEAR(double(single), std::max(sum, 0.0), 2e-6);
    }
  }
}

// A table of random pairs, read by shading's stages.
class RandomDfg {
 public:
  static constexpr int size = 16;
  explicit RandomDfg(bool warped, unsigned seed) : pairs_(random_pairs(seed)), table_(pairs_.data(), size, warped) {
    args_.dfg = table_.view();
    block_.first = 0;
    block_.count = block_size;
    block_.roughness = roughness_;
  }
  [[nodiscard]] double pair(int i, int j, int c) const {
    i = std::clamp(i, 0, size - 1), j = std::clamp(j, 0, size - 1);
    return double(pairs_[std::size_t((j * size + i) * 2 + c)]);
  }
  /// Bilinear between pairs, x and y in nodes from the first.
  [[nodiscard]] double between(double x, double y, int c) const {
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const double wx = x - i, wy = y - j;
    return (pair(i, j, c) * (1 - wx) + pair(i + 1, j, c) * wx) * (1 - wy) +
           (pair(i, j + 1, c) * (1 - wx) + pair(i + 1, j + 1, c) * wx) * wy;
  }
  /// check(NoV, roughness, A, B) for a grid of both.
  template <class Check>
  void read(const Check& check) {
    for (int row = 0; row <= 96; ++row) {
      for (int i = 0; i < block_size; ++i) {
        block_.nv[i] = std::max(float(i) / (block_size - 1), 1e-4f);
        roughness_[i] = float(row) / 96;
      }
      find_dfg_footprints<Wide>(args_, block_);
      read_dfg(args_, block_);
      for (int i = 0; i < block_size; ++i)
        check(double(block_.nv[i]), double(roughness_[i]), double(block_.A[i]), double(block_.B[i]));
    }
  }

 private:
  static std::vector<float> random_pairs(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<float> pairs(size * size * 2);
    for (float& x : pairs) x = float(random() % 1000) / 1000;
    return pairs;
  }

  std::vector<float> pairs_;
  DfgTable table_;
  ShadeArgs args_{};
  Block block_{};
  alignas(64) float roughness_[block_size] = {};
};

// A node keeps its numbers within 8e-6. What rows count for is a multiple of 1/32767, found in steps of 1/32768.
constexpr double node_step = 8e-6, row_step = 4.7e-5;

TEST(ReadDfg, IsBilinearAndClampsToTheEdge) {
  RandomDfg dfg(false, 5);
  dfg.read([&](double NoV, double r, double A, double B) {
    const double x = NoV * RandomDfg::size - 0.5, y = r * RandomDfg::size - 0.5;
    ASSERT_NEAR(A, dfg.between(x, y, 0), node_step + row_step) << NoV << " " << r;
    ASSERT_NEAR(B, dfg.between(x, y, 1), node_step + row_step) << NoV << " " << r;
  });
}

// The warped axes written out once more: u = s (1 + 2 r) / (s + 2 r) and root r, over loss and drop.
TEST(ReadDfg, WarpedIsLossAndDropOnItsAxes) {
  RandomDfg dfg(true, 6);
  dfg.read([&](double NoV, double r, double A, double B) {
    const double s = std::sqrt(NoV), last = RandomDfg::size - 1;
    const double x = last * s * (1 + 2 * r) / (s + 2 * r), y = last * std::sqrt(r);
    const double expected_B = std::pow(1 - NoV, 5) - dfg.between(x, y, 1),
                 expected_A = 1 - dfg.between(x, y, 0) - expected_B;
    ASSERT_NEAR(A, expected_A, 2 * (node_step + row_step)) << NoV << " " << r;
    ASSERT_NEAR(B, expected_B, node_step + row_step) << NoV << " " << r;
  });
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// The sampling kernels against a slow decoder and sampler in double, written from the formats' definitions.
#include "precompute/sampling_texture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "frame/dispatch.hpp"

namespace tessera {
namespace {

using Rgb = std::array<double, 3>;

// Sign-less float: five bits of exponent above `bits` of mantissa.
double decode_small(std::uint32_t x, int bits) {
  const int exponent = int(x >> bits), mantissa = int(x & ((1u << bits) - 1));
  return exponent == 0 ? std::ldexp(mantissa, -14 - bits) : std::ldexp((1 << bits) + mantissa, exponent - 15 - bits);
}

Rgb decode(SamplingFormat format, const std::uint32_t* w) {
  switch (format) {
    case SamplingFormat::rgba32_float:
      return {double(std::bit_cast<float>(w[0])), double(std::bit_cast<float>(w[1])),
              double(std::bit_cast<float>(w[2]))};
    case SamplingFormat::rgba16_float:
      return {decode_small(w[0] & 0xffff, 10), decode_small(w[0] >> 16, 10), decode_small(w[1] & 0xffff, 10)};
    case SamplingFormat::rgb9_e5: {
      const int exponent = int(w[0] >> 27) - 15 - 9;
      return {std::ldexp(w[0] & 511, exponent), std::ldexp(w[0] >> 9 & 511, exponent),
              std::ldexp(w[0] >> 18 & 511, exponent)};
    }
    default:
      return {decode_small(w[0] & 0x7ff, 6), decode_small(w[0] >> 11 & 0x7ff, 6), decode_small(w[0] >> 22, 5)};
  }
}

// Walks a tile or a curve step by step; no arithmetic shared with the kernels.
std::size_t index_of(SamplingLayout layout, int x, int y, int n) {
  if (layout == SamplingLayout::linear) return std::size_t(y * n + x);
  if (layout == SamplingLayout::morton) {  // quadrant by quadrant
    std::size_t index = 0;
    for (int half = n / 2; half > 0; half /= 2) {
      index = index * 4 + std::size_t((y >= half ? 2 : 0) + (x >= half ? 1 : 0));
      x %= half, y %= half;
    }
    return index;
  }
  const int t = layout == SamplingLayout::tiled_4 ? 4 : 8;
  std::size_t index = 0;
  for (int tile_y = 0; tile_y < n; tile_y += t)
    for (int tile_x = 0; tile_x < n; tile_x += t)
      for (int v = 0; v < t; ++v)
        for (int u = 0; u < t; ++u, ++index)
          if (tile_x + u == x && tile_y + v == y) return index;
  return 0;
}

struct Sampler {
  const SamplingTexture& texture;
  SamplingFormat format;
  SamplingLayout layout;
  bool cube;

  Rgb texel(int level, int face, int x, int y) const {
    std::size_t first = 0;
    const int n = texture.view.size >> level;
    for (int k = 0; k < level; ++k)
      first += std::size_t(cube ? 6 : 1) * std::size_t((texture.view.size >> k) * (texture.view.size >> k));
    first += std::size_t(face) * std::size_t(n * n);
    if (cube) {
      x = std::clamp(x, 0, n - 1), y = std::clamp(y, 0, n - 1);
    } else {
      x = (x % n + n) % n, y = (y % n + n) % n;
    }
    return decode(format,
                  texture.words.data() + (first + index_of(layout, x, y, n)) * (sampling_texel_bytes(format) / 4));
  }

  Rgb level(int k, int face, double s, double t, bool linear) const {
    const int n = texture.view.size >> k;
    if (!linear) return texel(k, face, std::min(int(s * n), n - 1), std::min(int(t * n), n - 1));
    const double x = s * n - 0.5, y = t * n - 0.5;
    const int i = int(std::floor(x)), j = int(std::floor(y));
    Rgb sum = {};
    for (int b = 0; b < 2; ++b)
      for (int a = 0; a < 2; ++a) {
        const double weight = (a != 0 ? x - i : 1 - (x - i)) * (b != 0 ? y - j : 1 - (y - j));
        const Rgb one = texel(k, face, i + a, j + b);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * one[c];
      }
    return sum;
  }

  Rgb operator()(int face, double s, double t, double lod, SamplingFilter filter) const {
    if (filter != SamplingFilter::trilinear) return level(0, face, s, t, filter == SamplingFilter::bilinear);
    lod = std::clamp(lod, 0.0, texture.view.levels - 1.0);
    const int fine = int(lod), coarse = std::min(fine + 1, texture.view.levels - 1);
    const Rgb a = level(fine, face, s, t, true), b = level(coarse, face, s, t, true);
    Rgb out;
    for (std::size_t c = 0; c < 3; ++c) out[c] = a[c] + (lod - fine) * (b[c] - a[c]);
    return out;
  }
};

// A texture of noise, the same for the same place.
SamplingColor noise(int level, int face, int x, int y) {
  std::minstd_rand random(unsigned(1 + x + 97 * y + 7919 * face + 104729 * level));
  random.discard(3);
  const auto value = [&] { return float(random() % 4096) / 1024; };
  const float r = value(), g = value(), b = value();
  return {r, g, b};
}

std::vector<const SamplingKernels*> runnable_sampling() {
  std::vector<const SamplingKernels*> runnable;
  for (const Kernels* kernels : built_kernels())
    for (const SamplingKernels* const* list = sampling_tables; *list != nullptr; ++list)
      if (std::strcmp((*list)->isa, kernels->isa) == 0 && cpu_runs(*kernels)) runnable.push_back(*list);
  return runnable;
}

struct Sampled {
  std::vector<float> in[4], out[3];

  void operator()(const SamplingKernel& kernel, const SamplingView& view) {
    SamplingArgs args{};
    args.texture = view;
    args.count = in[0].size();
    for (std::size_t k = 0; k < 4; ++k) args.in[k] = in[k].data();
    for (std::size_t k = 0; k < 3; ++k) {
      out[k].assign(args.count, -1);
      args.out[k] = out[k].data();
    }
    kernel.run(args);
  }
};

constexpr std::size_t count = 1003;

TEST(Sampling, AgreesWithTheSlowSampler) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(0, 1), turns(-3, 3), levels(-1, 5);
  ASSERT_FALSE(runnable_sampling().empty());
  for (int k = 0; k < runnable_sampling()[0]->count; ++k) {
    const SamplingKernel& first = runnable_sampling()[0]->first[k];
    const SamplingTexture texture = build_sampling_texture(first.format, first.layout, first.cube, 64, 4, noise);
    const Sampler sampler{texture, first.format, first.layout, first.cube};
    Sampled run;
    std::vector<Rgb> expected;
    for (std::size_t i = 0; i < count; ++i) {
      if (first.cube) {  // a direction through a chosen point of a chosen face
        const int face = int(i % 6);
        const float s = unit(random), t = unit(random), sc = 2 * s - 1, tc = 2 * t - 1, length = 0.1f + unit(random);
        const float axes[6][3] = {{1, -tc, -sc}, {-1, -tc, sc}, {sc, 1, tc},
                                  {sc, -1, -tc}, {sc, -tc, 1},  {-sc, -tc, -1}};
        for (std::size_t c = 0; c < 3; ++c) run.in[c].push_back(axes[face][c] * length);
        run.in[3].push_back(levels(random));
        expected.push_back(sampler(face, double(s), double(t), double(run.in[3][i]), first.filter));
      } else {
        run.in[0].push_back(turns(random));
        run.in[1].push_back(turns(random));
        run.in[2].push_back(levels(random));
        run.in[3].push_back(0);
        const double u = double(run.in[0][i]), v = double(run.in[1][i]);
        expected.push_back(sampler(0, u - std::floor(u), v - std::floor(v), double(run.in[2][i]), first.filter));
      }
    }
    std::vector<float> bits;
    for (const SamplingKernels* list : runnable_sampling()) {
      run(list->first[k], texture.view);
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c)
          if (std::abs(double(run.out[c][i]) - expected[i][c]) > 2e-4) ++wrong;
      // Nearest: a coordinate on the edge between two texels may fall to either side of it in float.
      EXPECT_LE(wrong, first.filter == SamplingFilter::nearest ? 6u : 0u)
          << list->isa << " format " << int(first.format) << " layout " << int(first.layout) << " filter "
          << int(first.filter) << " cube " << first.cube;
      std::vector<float> all;
      for (const auto& plane : run.out) all.insert(all.end(), plane.begin(), plane.end());
      if (bits.empty()) bits = all;
      EXPECT_EQ(std::memcmp(bits.data(), all.data(), bits.size() * sizeof(float)), 0) << list->isa << " differs";
    }
  }
}

// No read outside, no NaN: whatever the coordinates and the words.
TEST(Sampling, AnyBits) {
  std::mt19937 random(10);
  for (const SamplingKernels* list : runnable_sampling())
    for (int k = 0; k < list->count; ++k) {
      const SamplingKernel& kernel = list->first[k];
      SamplingTexture texture = build_sampling_texture(kernel.format, kernel.layout, kernel.cube, 8, 1, noise);
      if (kernel.format != SamplingFormat::rgba32_float)
        for (auto& word : texture.words) word = std::uint32_t(random());
      Sampled run;
      for (std::size_t i = 0; i < count; ++i)
        for (auto& plane : run.in) plane.push_back(std::bit_cast<float>(std::uint32_t(random())));
      run(kernel, texture.view);
      for (const auto& plane : run.out)
        for (const float x : plane) ASSERT_TRUE(std::isfinite(x)) << list->isa << " kernel " << k;
    }
}

// What each format keeps: half a unit of its last place.
TEST(SamplingFormats, KeepTheirDigits) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> exponent(-9, 14);
  for (int i = 0; i < 20000; ++i) {
    const double brightest = std::exp2(exponent(random));
    const SamplingColor color = {float(brightest), float(brightest * 0.37), float(brightest * 0.011)};
    const auto relative = [&](SamplingFormat format, std::size_t channel) {
      const auto words = encode_sampling_texel(format, color);
      return std::abs(decode(format, words.data())[channel] / double(color[channel]) - 1);
    };
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_LE(relative(SamplingFormat::rgba32_float, c), 0);
      EXPECT_LE(relative(SamplingFormat::rgba16_float, c), c == 2 ? 4e-3 : 0x1p-11);  // the third may be subnormal
      EXPECT_LE(
          std::abs(decode(SamplingFormat::rgb9_e5, encode_sampling_texel(SamplingFormat::rgb9_e5, color).data())[c] -
                   double(color[c])),
          0x1p-9 * brightest);
    }
    EXPECT_LE(relative(SamplingFormat::r11_g11_b10, 0), 0x1p-7);
    EXPECT_LE(relative(SamplingFormat::r11_g11_b10, 1), 0x1p-7);
  }
}

TEST(SamplingFormats, EndsOfTheirRange) {
  for (const SamplingFormat format :
       {SamplingFormat::rgba16_float, SamplingFormat::rgb9_e5, SamplingFormat::r11_g11_b10}) {
    const auto black = encode_sampling_texel(format, {0, -1, std::nanf("")});
    const auto bright = encode_sampling_texel(format, {1e30f, 1, INFINITY});
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(decode(format, black.data())[c], 0);
    EXPECT_GE(decode(format, bright.data())[0], 64000);
    EXPECT_LE(decode(format, bright.data())[0], 65504);
  }
}

}  // namespace
}  // namespace tessera

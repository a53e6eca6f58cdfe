// The kernels that work through arrays, on random bit patterns: elementary functions, halves, mips, the background, and
// texture sampling by format, layout and filter.
#include <gtest/gtest.h>

#include <cmath>

#include "fuzz/random_bits.hpp"
#include "kernels/runnable_kernels.hpp"
#include "kernels/sampling.hpp"
#include "kernels/shade/shade_scene.hpp"

namespace tessera::test {
namespace {

constexpr std::size_t block = 4096;

std::uint32_t bits(float x) { return x != x ? 0x7fc00000u : std::bit_cast<std::uint32_t>(x); }  // all NaNs are one

bool same(const std::vector<float>& a, const std::vector<float>& b) {
  bool equal = true;
  for (std::size_t i = 0; i < a.size(); ++i) equal &= bits(a[i]) == bits(b[i]);
  return equal;
}

bool all_finite(const std::vector<float>& values) {
  bool finite = true;
  for (const float x : values) finite &= std::abs(x) <= 3.4e38f;
  return finite;
}

TEST(ArraysFuzz, FunctionsAreTheSameOnTheNarrowestAndTheWidest) {
  const Kernels &narrow = *runnable_kernels().front(), &wide = *runnable_kernels().back();
  RandomBits random(31);
  std::vector<float> a(block), b(block), out(block), other(block);
  for (std::uint64_t done = 0; done < fuzz_count(); done += block) {
    random.fill(a.data(), block);
    random.fill(b.data(), block);
    for (std::size_t i = 0; i < block; i += 2) b[i] = float(double(std::bit_cast<std::int32_t>(b[i])) * 0x1p-28);
    for (int f = 0; f <= int(MathFunction::linear_to_srgb); ++f) {
      narrow.evaluate(MathFunction(f), a.data(), b.data(), out.data(), block);
      wide.evaluate(MathFunction(f), a.data(), b.data(), other.data(), block);
      ASSERT_TRUE(same(out, other)) << "function " << f << ", block " << done / block;
    }
  }
}

TEST(ArraysFuzz, HalvesAndMipsAreTheSameOnTheNarrowestAndTheWidest) {
  const Kernels &narrow = *runnable_kernels().front(), &wide = *runnable_kernels().back();
  RandomBits random(32);
  std::vector<float> in(block), out(block), other(block);
  std::vector<std::uint16_t> half(block), same_half(block);
  for (std::uint64_t done = 0; done < fuzz_count(); done += block) {
    random.fill(in.data(), block);
    narrow.pack_half(in.data(), half.data(), block);
    wide.pack_half(in.data(), same_half.data(), block);
    ASSERT_EQ(half, same_half) << "block " << done / block;
    narrow.unpack_half(half.data(), out.data(), block);
    wide.unpack_half(half.data(), other.data(), block);
    ASSERT_TRUE(same(out, other)) << "block " << done / block;
    narrow.downsample({in.data(), 64, 16, out.data()});
    wide.downsample({in.data(), 64, 16, other.data()});
    ASSERT_TRUE(same(out, other)) << "block " << done / block;
  }
}

TEST(ArraysFuzz, AnyRayOfTheBackgroundIsFiniteAndTheSame) {
  const Kernels &narrow = *runnable_kernels().front(), &wide = *runnable_kernels().back();
  const Environment environment = Environment::constant(2);
  RandomBits random(33);
  std::vector<float> out[4], other[4], remaining(tile_pixels);
  for (std::uint64_t done = 0, round = 0; done < fuzz_count(); done += tile_pixels, ++round) {
    BackgroundArgs args{{-1, 1, -1},
                        {0.07f, 0, 0},
                        {0, -0.07f, 0},
                        environment.view().background,
                        1.5f,
                        {},
                        0,
                        0,
                        tile_size,
                        tile_size,
                        nullptr,
                        {}};
    if (round % 4 != 0) random.fill(&args.lod, 1);
    if (round % 2 != 0) random.fill(args.dx, 3);
    if (round % 4 >= 2) random.fill(args.dy, 3);
    if (round % 8 == 7) random.fill(args.corner, 3);
    args.x = int(random.next() % (1u << 24)) - (1 << 23);
    args.y = int(random.next() % (1u << 24)) - (1 << 23);
    if (round % 16 >= 8) {
      for (float& x : remaining) x = float(random.next() % 9) / 8;
      args.remaining = remaining.data();
    }
    for (int c = 0; c < 4; ++c) {
      out[c].assign(tile_pixels, 0.25f);
      other[c] = out[c];
      args.rgba[c] = out[c].data();
    }
    narrow.background(args);
    for (int c = 0; c < 4; ++c) args.rgba[c] = other[c].data();
    wide.background(args);
    for (int c = 0; c < 4; ++c) {
      ASSERT_TRUE(same(out[c], other[c])) << "round " << round;
      bool good = true;
      for (const float r : out[c]) good &= r >= 0 && r <= 3.4e38f;
      ASSERT_TRUE(good) << "round " << round;
    }
  }
}

TEST(ArraysFuzz, AnyCoordinateSamplesTheTextureAndTheSameEverywhere) {
  constexpr int size = 16, levels = 2;
  RandomBits random(34);
  // Any bits as texels, but as whole floats finite and not negative. In the smaller formats infinities and NaNs become
  // large numbers.
  alignas(64) static std::uint32_t texels[4 * 6 * (16 * 16 + 8 * 8) + 16];
  for (std::uint32_t& word : texels) word = std::uint32_t(random.next()) & 0x7f7fffffu;
  const std::size_t widest = runnable_kernels().size() - 1;
  const SamplingKernels &narrow = *sampling_tables[0], &wide = *sampling_tables[widest];
  ASSERT_STREQ(wide.isa, runnable_kernels()[widest]->isa);
  std::vector<float> in[4], out[3], other[3];
  for (auto& plane : in) plane.resize(block);
  for (int c = 0; c < 3; ++c) out[c].resize(block), other[c].resize(block);
  for (std::uint64_t done = 0; done < fuzz_count(); done += 4 * block) {
    for (auto& plane : in) random.fill(plane.data(), block);
    for (std::size_t i = 0; i < block; i += 2)  // every second one near the texture
      for (auto& plane : in) plane[i] = float(double(std::bit_cast<std::int32_t>(plane[i])) * 0x1p-29);
    for (int k = 0; k < wide.count; ++k) {
      SamplingArgs args{{texels, size, levels}, {in[0].data(), in[1].data(), in[2].data(), in[3].data()}, {}, block};
      for (int c = 0; c < 3; ++c) args.out[c] = out[c].data();
      narrow.first[k].run(args);
      for (int c = 0; c < 3; ++c) args.out[c] = other[c].data();
      wide.first[k].run(args);
      for (int c = 0; c < 3; ++c) {
        ASSERT_TRUE(same(out[c], other[c])) << "kernel " << k << ", block " << done / block;
        ASSERT_TRUE(all_finite(out[c])) << "kernel " << k << ", block " << done / block;
      }
    }
  }
}

}  // namespace
}  // namespace tessera::test

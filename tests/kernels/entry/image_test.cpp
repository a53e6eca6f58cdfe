// encode, downsample, pack_half and unpack_half, against plain double code.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "kernels/runnable_kernels.hpp"

namespace tessera {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

struct Image : testing::TestWithParam<const Kernels*> {
  std::vector<int> encode(const std::vector<float>& rgba, ToneCurve curve = ToneCurve::none, float exposure = 1) {
    std::vector<std::uint8_t> out(rgba.size());
    GetParam()->encode({rgba.data(), rgba.size() / 4, exposure, curve, out.data()});
    return {out.begin(), out.end()};
  }
  std::vector<float> downsample(const std::vector<float>& in, int width, int height) {
    std::vector<float> out(std::size_t{4} * std::max(1, width / 2) * std::max(1, height / 2) + 16, -7.0f);
    GetParam()->downsample({in.data(), width, height, out.data()});
    for (std::size_t i = out.size() - 16; i < out.size(); ++i) EXPECT_EQ(out[i], -7) << "written beyond the end";
    out.resize(out.size() - 16);
    return out;
  }
};

using Pixel = std::vector<int>;

TEST_P(Image, EncodesWhatADisplayShows) {
  EXPECT_EQ(encode({0, 0.5f, 1, 1}), (Pixel{0, 188, 255, 255}));
  EXPECT_EQ(encode({0.21404114f, 2, 1e30f, 1}), (Pixel{128, 255, 255, 255}));  // 0.5 * 255 = 127.5 rounds up
  EXPECT_EQ(encode({0.25f, 0.25f, 0.25f, 1}, ToneCurve::none, 2), (Pixel{188, 188, 188, 255}));
  EXPECT_EQ(encode({1, 1, 1, 1}, ToneCurve::reinhard), (Pixel{188, 188, 188, 255}));
}

TEST_P(Image, TakesTheAlphaOutBeforeTheCurve) {
  EXPECT_EQ(encode({0.25f, 0.25f, 0.25f, 0.5f}), (Pixel{188, 188, 188, 128}));
  EXPECT_EQ(encode({0.25f, 0.25f, 0.25f, 0.25f}, ToneCurve::reinhard), (Pixel{188, 188, 188, 64}));
  EXPECT_EQ(encode({1, 1, 1, 0}), (Pixel{0, 0, 0, 0}));
}

TEST_P(Image, EncodesAnyBits) {
  EXPECT_EQ(encode({nan, -1, -0.0f, 1}), (Pixel{0, 0, 0, 255}));
  EXPECT_EQ(encode({1, 1, 1, nan}), (Pixel{0, 0, 0, 0}));
  EXPECT_EQ(encode({1, 1, 1, -1}), (Pixel{0, 0, 0, 0}));
  for (const ToneCurve curve : {ToneCurve::none, ToneCurve::reinhard, ToneCurve::aces, ToneCurve::khronos_neutral})
    EXPECT_EQ(encode({inf, inf, inf, 1}, curve), (Pixel{255, 255, 255, 255}));
  EXPECT_EQ(encode({1e-3f, 1e-3f, 1e-3f, 1e-42f}), (Pixel{255, 255, 255, 0}));
}

TEST_P(Image, LeavesTheAlphaOutIfAsked) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1.2f);
  for (const std::size_t count : {1, 2, 15, 16, 17, 64, 101}) {
    std::vector<float> rgba(4 * count);
    for (float& x : rgba) x = uniform(random);
    const std::vector<int> four = encode(rgba);
    std::vector<std::uint8_t> three(3 * count + 1, 77);
    GetParam()->encode({rgba.data(), count, 1, ToneCurve::none, three.data(), 3});
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(three[3 * i + c], four[4 * i + c]) << count << " pixels, " << i;
    ASSERT_EQ(three.back(), 77) << "written beyond the end";
  }
}

double curve_reference(ToneCurve curve, double x) {  // of a grey
  if (curve == ToneCurve::reinhard) return x / (1 + x);
  if (curve == ToneCurve::aces) return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  if (curve == ToneCurve::khronos_neutral) {
    const double base = x - (x < 0.08 ? x - 6.25 * x * x : 0.04);
    return base < 0.76 ? base : 1 - 0.24 * 0.24 / (base + 0.24 - 0.76);
  }
  return x;
}

TEST_P(Image, GreysFollowTheCurveAndTheTransferFunction) {
  constexpr int count = 4099;  // not a multiple of any vector
  for (const ToneCurve curve : {ToneCurve::none, ToneCurve::reinhard, ToneCurve::aces, ToneCurve::khronos_neutral}) {
    std::vector<float> rgba;
    for (int i = 0; i < count; ++i)
      for (int c = 0; c < 4; ++c) rgba.push_back(c == 3 ? 1.0f : std::exp2(static_cast<float>(i) / 256 - 12));
    const std::vector<int> bytes = encode(rgba, curve, 1.5f);
    for (int i = 0; i < count; ++i) {
      const double linear = std::min(1.0, std::max(0.0, curve_reference(curve, rgba[4 * i] * 1.5)));
      const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(bytes[4 * i + c], encoded * 255, 0.5 + 2e-4);
      ASSERT_EQ(bytes[4 * i + 3], 255);
    }
  }
}

TEST_P(Image, EncodeAgreesWithTheFirstInstructionSetOnAnyBits) {
  std::mt19937 random(4);
  std::vector<float> rgba(4 * 20011);
  for (float& x : rgba)
    x = std::bit_cast<float>(static_cast<std::uint32_t>(random()) & (random() % 4 ? 0xbfffffffu : ~0u));
  for (const ToneCurve curve : {ToneCurve::none, ToneCurve::reinhard, ToneCurve::aces, ToneCurve::khronos_neutral}) {
    std::vector<std::uint8_t> expected(rgba.size());
    kernel_tables[0]->encode({rgba.data(), rgba.size() / 4, 0.7f, curve, expected.data()});
    EXPECT_EQ(encode(rgba, curve, 0.7f), std::vector<int>(expected.begin(), expected.end()));
  }
}

TEST_P(Image, DownsampleOfEvenSizesIsTheMeanOfFour) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> value(0, 1);
  for (const int width : {2, 4, 6, 10, 34, 64}) {
    const int height = 6;
    std::vector<float> in(std::size_t{4} * width * height);
    for (float& x : in) x = value(random);
    const std::vector<float> out = downsample(in, width, height);
    for (int y = 0; y < height / 2; ++y)
      for (int x = 0; x < width / 2; ++x)
        for (int c = 0; c < 4; ++c) {
          const auto at = [&](int u, int v) { return double{in[4 * ((2 * y + v) * width + 2 * x + u) + c]}; };
          ASSERT_NEAR(out[4 * (y * (width / 2) + x) + c], (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4, 1e-7);
        }
  }
}

// Each output is the integral of the input, a step function, over its share of the image.
TEST_P(Image, DownsampleOfAnySizeIsTheBoxIntegral) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(0, 1);
  for (const auto& [width, height] : {std::pair{5, 3}, {3, 1}, {1, 7}, {1, 1}, {2, 1}, {9, 4}, {37, 11}}) {
    std::vector<float> in(std::size_t{4} * width * height);
    for (float& x : in) x = value(random);
    const std::vector<float> out = downsample(in, width, height);
    const int w = std::max(1, width / 2), h = std::max(1, height / 2);
    const auto overlap = [](int i, int n, int outputs, int inputs) {  // of input n and output i, in inputs
      const double step = double(inputs) / outputs;
      return std::max(0.0, std::min((i + 1) * step, n + 1.0) - std::max(i * step, double(n))) / step;
    };
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        for (int c = 0; c < 4; ++c) {
          double expected = 0;
          for (int v = 0; v < height; ++v)
            for (int u = 0; u < width; ++u)
              expected += overlap(x, u, w, width) * overlap(y, v, h, height) * in[4 * (v * width + u) + c];
          ASSERT_NEAR(out[4 * (y * w + x) + c], expected, 3e-7) << width << "x" << height;
        }
  }
}

TEST_P(Image, ConstantStaysConstant) {
  const std::vector<float> in(std::size_t{4} * 16 * 8, 0.7f);
  for (const float x : downsample(in, 16, 8)) EXPECT_EQ(x, 0.7f);
}

TEST_P(Image, HalvesRoundTripAndTailsStayInside) {
  std::vector<std::uint16_t> in(65536), out(65536);
  std::vector<float> wide(65536);
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = static_cast<std::uint16_t>(i);
  GetParam()->unpack_half(in.data(), wide.data(), in.size());
  GetParam()->pack_half(wide.data(), out.data(), out.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    const bool is_nan = (i & 0x7fff) > 0x7c00;
    ASSERT_EQ(out[i], is_nan ? i | 0x200 : i);  // a signalling NaN turns quiet
  }
  for (std::size_t count = 0; count < 40; ++count) {
    std::vector<float> f(48, -7);
    std::vector<std::uint16_t> h(48, 9);
    GetParam()->unpack_half(in.data() + 0x3c00, f.data(), count);
    GetParam()->pack_half(wide.data() + 0x3c00, h.data(), count);
    for (std::size_t i = 0; i < 48; ++i) {
      ASSERT_EQ(f[i], i < count ? wide[0x3c00 + i] : -7);
      ASSERT_EQ(h[i], i < count ? in[0x3c00 + i] : 9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllInstructionSets, Image, testing::ValuesIn(runnable_kernels()),
                         [](const auto& info) { return std::string(info.param->isa); });

}  // namespace
}  // namespace tessera

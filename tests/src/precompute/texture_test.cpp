#include "precompute/texture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "base/error.hpp"
#include "frame/dispatch.hpp"

namespace tessera {
namespace {

template <class T>
SourceImage image_of(int width, int height, int channels, PixelType type, const std::vector<T>& values) {
  SourceImage image{"test", width, height, channels, type, {}};
  image.pixels.resize(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(image.pixels.data(), values.data(), image.pixels.size());
  return image;
}

double half_value(std::uint16_t h) {
  const int exponent = h >> 10 & 31, mantissa = h & 1023;
  return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
}

// Number i of the texels, whatever their format.
double value(const TextureData& data, std::size_t i) {
  if (data.format == TexelFormat::rgba8_unorm) return std::to_integer<int>(data.texels[i]) / 255.0;
  std::uint16_t half;
  std::memcpy(&half, data.texels.data() + 2 * i, 2);
  return half_value(half);
}

double srgb(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

const Kernels& kernels() { return select_kernels(); }

TEST(Texture, EveryChannelCountBecomesRgba) {
  const std::vector<std::uint8_t> bytes = {10, 20, 30, 40};
  const int expected[4][4] = {{10, 10, 10, 255}, {10, 10, 10, 20}, {10, 20, 30, 255}, {10, 20, 30, 40}};
  for (int channels = 1; channels <= 4; ++channels) {
    const auto image = image_of<std::uint8_t>(1, 1, channels, PixelType::u8, {bytes.begin(), bytes.begin() + channels});
    const TextureData data = build_texture(image, Encoding::linear, true, kernels());
    EXPECT_EQ(data.format, TexelFormat::rgba8_unorm);
    EXPECT_EQ(data.levels, 1);
    ASSERT_EQ(data.texels.size(), 4u);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(std::to_integer<int>(data.texels[c]), expected[channels - 1][c]) << channels;
  }
}

TEST(Texture, SrgbIsDecodedAndAlphaIsNot) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 256; ++i) bytes.insert(bytes.end(), {std::uint8_t(i), std::uint8_t(255 - i), 7, std::uint8_t(i)});
  const TextureData data = build_texture(image_of(256, 1, 4, PixelType::u8, bytes), Encoding::srgb, false, kernels());
  ASSERT_EQ(data.format, TexelFormat::rgba16_float);
  for (int i = 0; i < 256; ++i) {
    EXPECT_NEAR(value(data, 4 * i), srgb(i / 255.0), srgb(i / 255.0) / 2048 + 1e-7) << i;  // half: 11 bits
    EXPECT_NEAR(value(data, 4 * i + 1), srgb((255 - i) / 255.0), srgb((255 - i) / 255.0) / 2048 + 1e-7) << i;
    EXPECT_NEAR(value(data, 4 * i + 3), i / 255.0, i / 255.0 / 2048 + 1e-7) << i;
  }
}

double display(double x) { return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055); }

TEST(Texture, ColorsInEightBitsAreWithinADisplayStep) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 256; ++i) bytes.insert(bytes.end(), {std::uint8_t(i), std::uint8_t(255 - i), 7, std::uint8_t(i)});
  const SourceImage image = image_of(256, 1, 4, PixelType::u8, bytes);
  const TextureData data = build_texture(image, Encoding::srgb, true, kernels(), ColorTexels::bytes);
  ASSERT_EQ(data.format, TexelFormat::rgba8_squares);
  ASSERT_EQ(data.levels, 9);
  ASSERT_EQ(data.texels.size(), 4u * 511);
  const auto stored = [&](int i) { return std::to_integer<int>(data.texels[std::size_t(i)]) / 255.0; };
  for (int i = 0; i < 256; ++i) {
    EXPECT_NEAR(display(stored(4 * i) * stored(4 * i)), i, 0.75);
    EXPECT_NEAR(display(stored(4 * i + 1) * stored(4 * i + 1)), 255 - i, 0.75);
    EXPECT_EQ(stored(4 * i + 3), i / 255.0);
  }
  // Mips are means of light: of the first two texels, 0 and srgb(1/255), nearly nothing; of the last two, nearly 1.
  EXPECT_EQ(stored(4 * 256), 3 / 255.0);  // sqrt(srgb(1/255) / 2) = 0.0123
  EXPECT_NEAR(stored(4 * 383), std::sqrt((1 + srgb(254 / 255.0)) / 2), 0.5 / 255);
  // What is no sRGB picture of integers is as it was.
  EXPECT_EQ(build_texture(image, Encoding::linear, true, kernels(), ColorTexels::bytes).format,
            TexelFormat::rgba8_unorm);
  const std::vector<float> light = {5, 6, 7};
  EXPECT_EQ(build_texture(image_of(1, 1, 3, PixelType::f32, light), Encoding::srgb, true, kernels(), ColorTexels::bytes)
                .format,
            TexelFormat::rgba16_float);
}

TEST(Texture, DeeperPixels) {
  const std::vector<std::uint16_t> deep = {0, 6553, 65535, 32768};
  TextureData data = build_texture(image_of(2, 1, 2, PixelType::u16, deep), Encoding::srgb, false, kernels());
  EXPECT_EQ(value(data, 0), 0);
  EXPECT_NEAR(value(data, 3), 6553 / 65535.0, 1e-4);
  EXPECT_EQ(value(data, 4), 1);
  EXPECT_NEAR(value(data, 7), 0.5, 1e-3);
  data = build_texture(image_of(2, 1, 2, PixelType::u16, deep), Encoding::linear, false, kernels());
  EXPECT_EQ(data.format, TexelFormat::rgba16_float);
  EXPECT_NEAR(value(data, 3), 6553 / 65535.0, 1e-4);

  // Floats are linear as they are; what a half cannot hold is clamped, NaN is 0.
  const std::vector<float> floats = {0.25f, -1, 1e9f, NAN, 3, INFINITY};
  data = build_texture(image_of(2, 1, 3, PixelType::f32, floats), Encoding::srgb, false, kernels());
  const double expected[8] = {0.25, 0, 65504, 1, 0, 3, 65504, 1};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(value(data, i), expected[i]) << i;

  const std::vector<std::uint16_t> halves = {0x3800, 0xbc00, 0x7c00, 0x7e00};  // 0.5 -1 inf nan
  data = build_texture(image_of(1, 1, 4, PixelType::half, halves), Encoding::linear, false, kernels());
  const double expected_halves[4] = {0.5, 0, 65504, 0};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(value(data, i), expected_halves[i]) << i;
}

// sRGB mips average light, not codes: black and white make 0.5, which as a code would be 188, not 128.
TEST(Texture, MipsAverageInLinearLight) {
  const std::vector<std::uint8_t> checker = {0, 255, 255, 0};
  TextureData data = build_texture(image_of(2, 2, 1, PixelType::u8, checker), Encoding::srgb, true, kernels());
  EXPECT_EQ(data.levels, 2);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(value(data, 16 + c), 0.5);
  EXPECT_EQ(value(data, 19), 1);
  data = build_texture(image_of(2, 2, 1, PixelType::u8, checker), Encoding::linear, true, kernels());
  EXPECT_EQ(std::to_integer<int>(data.texels[16]), 128);  // 127.5 rounds up
}

// What a texel of a smaller axis covers of a larger one.
double overlap(int small, int small_size, int large, int large_size) {
  const double scale = double(large_size) / small_size;
  const double begin = std::max(small * scale, double(large)), end = std::min((small + 1) * scale, large + 1.0);
  return std::max(end - begin, 0.0) / scale;
}

TEST(Texture, EveryLevelIsTheAreaMeanOfTheOneAbove) {
  std::mt19937 random(4);
  for (const auto& [width, height] : {std::pair{70, 66}, {33, 67}, {64, 130}, {5, 96}, {96, 1}, {1, 40}, {34, 33}}) {
    std::vector<std::uint8_t> bytes(std::size_t(width * height));
    for (std::uint8_t& b : bytes) b = std::uint8_t(random());
    const TextureData data =
        build_texture(image_of(width, height, 1, PixelType::u8, bytes), Encoding::srgb, true, kernels());
    std::vector<double> level;
    for (const std::uint8_t b : bytes) level.push_back(srgb(b / 255.0));
    std::size_t texel = 0;
    for (int k = 0, w = width, h = height; k < data.levels; ++k) {
      for (const double expected : level) ASSERT_NEAR(value(data, 4 * texel++), expected, expected / 2000 + 1e-6) << k;
      const int half_w = std::max(w / 2, 1), half_h = std::max(h / 2, 1);
      std::vector<double> next(std::size_t(half_w * half_h));
      for (int j = 0; j < half_h; ++j)
        for (int i = 0; i < half_w; ++i)
          for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
              next[std::size_t(j * half_w + i)] +=
                  overlap(i, half_w, x, w) * overlap(j, half_h, y, h) * level[std::size_t(y * w + x)];
      level = next;
      w = half_w;
      h = half_h;
    }
    EXPECT_EQ(8 * texel, data.texels.size());
  }
}

TEST(Texture, LevelsReachOneTexelAndKeepTheMean) {
  std::mt19937 random(1);
  std::vector<float> values(16 * 4);
  double sum = 0;
  for (float& v : values) sum += v = float(random() % 1000) / 1000;
  const TextureData data = build_texture(image_of(16, 4, 1, PixelType::f32, values), Encoding::linear, true, kernels());
  EXPECT_EQ(data.levels, 5);  // 16x4 8x2 4x1 2x1 1x1
  ASSERT_EQ(data.texels.size(), 8u * (64 + 16 + 4 + 2 + 1));
  EXPECT_NEAR(value(data, 4 * (64 + 16 + 4 + 2)), sum / 64, 1e-3);
  const auto odd = build_texture(image_of(5, 3, 1, PixelType::u8, std::vector<std::uint8_t>(15, 200)), Encoding::linear,
                                 true, kernels());
  EXPECT_EQ(odd.levels, 3);  // 5x3 2x1 1x1
  for (std::size_t i = 0; i < odd.texels.size(); i += 4) EXPECT_EQ(std::to_integer<int>(odd.texels[i]), 200);
}

TEST(Texture, TheSameBitsOnEveryInstructionSet) {
  std::mt19937 random(2);
  std::vector<std::uint8_t> bytes(37 * 23 * 4);
  for (std::uint8_t& b : bytes) b = std::uint8_t(random());
  std::vector<std::uint16_t> deep(37 * 23 * 2);
  for (std::uint16_t& d : deep) d = std::uint16_t(random());
  for (const Encoding encoding : {Encoding::linear, Encoding::srgb})
    for (const SourceImage& image :
         {image_of(37, 23, 4, PixelType::u8, bytes), image_of(37, 23, 2, PixelType::u16, deep)}) {
      const TextureData first = build_texture(image, encoding, true, *built_kernels()[0]);
      for (const Kernels* table : built_kernels()) {
        if (!cpu_runs(*table)) continue;
        EXPECT_TRUE(build_texture(image, encoding, true, *table).texels == first.texels) << table->isa;
      }
    }
}

std::string error_of(const SourceImage& image) {
  try {
    build_texture(image, Encoding::linear, true, kernels());
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), ExitStatus::input);
    return e.what();
  }
  return "no error";
}

TEST(Texture, BrokenImagesAreNamed) {
  const std::vector<std::uint8_t> one = {1};
  EXPECT_EQ(error_of(image_of<std::uint8_t>(0, 1, 1, PixelType::u8, {})),
            "image 'test': 0 x 1 pixels; expected at least 1 x 1");
  EXPECT_EQ(error_of(image_of(2, 1, 1, PixelType::u8, one)), "image 'test': 1 bytes of pixels; expected 2");
  EXPECT_EQ(error_of(image_of(1, 1, 5, PixelType::u8, one)), "image 'test': 5 channels; expected 1 to 4");
  EXPECT_EQ(error_of(image_of(16385, 1, 1, PixelType::u8, one)),
            "image 'test': 16385 x 1 pixels; at most 16384 along a side are supported");
  EXPECT_NE(error_of(image_of(16384, 16384, 1, PixelType::u8, one)).find("texels with all mip levels"),
            std::string::npos);
}

TEST(TextureSet, SharesTexelsAndBuildsOnlyWhatIsUsed) {
  Scene scene;
  scene.images.push_back(image_of(4, 4, 1, PixelType::u8, std::vector<std::uint8_t>(16, 9)));
  scene.images.push_back({"broken and unused", 9, 9, 1, PixelType::u8, {}});
  scene.textures.resize(4);
  scene.textures[0].image = scene.textures[1].image = 0;
  scene.textures[1].sampler = {WrapMode::clamp_to_edge, WrapMode::mirrored_repeat, FilterMode::nearest,
                               FilterMode::nearest,     FilterMode::linear,        false};
  scene.textures[2].image = 1;
  TextureSet set;
  const TextureSet::Use uses[] = {
      {0, Encoding::linear}, {1, Encoding::linear}, {1, Encoding::srgb}, {3, Encoding::srgb}, {9, Encoding::srgb}};
  set.build(scene, uses, kernels());
  const TextureView* a = set.find({0, Encoding::linear});
  const TextureView* b = set.find({1, Encoding::linear});
  const TextureView* c = set.find({1, Encoding::srgb});
  ASSERT_TRUE(a != nullptr && b != nullptr && c != nullptr);
  EXPECT_EQ(a->texels, b->texels);
  EXPECT_NE(b->texels, c->texels);
  EXPECT_EQ(a->format, TexelFormat::rgba8_unorm);
  EXPECT_EQ(c->format, TexelFormat::rgba16_float);
  EXPECT_EQ(b->wrap_u, WrapMode::clamp_to_edge);
  EXPECT_EQ(b->wrap_v, WrapMode::mirrored_repeat);
  EXPECT_EQ(b->magnify, FilterMode::nearest);
  EXPECT_FALSE(b->mipmapped);
  EXPECT_TRUE(a->mipmapped);
  EXPECT_EQ(a->levels, 3);
  EXPECT_EQ(set.find({0, Encoding::srgb}), nullptr);
  EXPECT_EQ(set.find({2, Encoding::linear}), nullptr);
  EXPECT_EQ(set.find({3, Encoding::srgb}), nullptr);  // a texture without an image
  EXPECT_EQ(set.bytes(), 4u * 21 + 8u * 16);
}

}  // namespace
}  // namespace tessera

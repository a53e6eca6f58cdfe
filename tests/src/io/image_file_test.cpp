#include "io/image_file.hpp"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/error.hpp"
#include "io/file_bytes.hpp"
#include "src/io/shared_assets.hpp"
#include "src/io/temporary_folder.hpp"

namespace tessera {
namespace {

// Writes an image of ramp values through OpenImageIO alone.
template <class T>
std::string write_reference(const TemporaryFolder& folder, const std::string& name, int width, int height,
                            const std::vector<std::string>& channels, OIIO::TypeDesc type, const std::vector<T>& values,
                            const std::string& compression = "") {
  const std::string path = folder.file(name);
  auto output = OIIO::ImageOutput::create(path);
  OIIO::ImageSpec spec(width, height, int(channels.size()), type);
  spec.channelnames = channels;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (!compression.empty()) spec.attribute("compression", compression);
  EXPECT_TRUE(output->open(path, spec)) << output->geterror();
  EXPECT_TRUE(output->write_image(OIIO::BaseTypeFromC<T>::value, values.data()));
  EXPECT_TRUE(output->close());
  return path;
}

std::string message_of(const std::function<void()>& body, ExitStatus status) {
  try {
    body();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), status);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    return e.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(ImageFile, PngKeepsStraightAlphaInEveryChannelCountAndDepth) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> layouts{{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  for (const auto& names : layouts) {
    const std::size_t count = names.size() * 6;
    std::vector<std::uint8_t> bytes(count);
    std::vector<std::uint16_t> words(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = std::uint8_t(255 - i * 10), words[i] = std::uint16_t(i * 2731);
    const std::string p8 = write_reference(folder, "8.png", 3, 2, names, OIIO::TypeDesc::UINT8, bytes);
    const std::string p16 = write_reference(folder, "16.png", 3, 2, names, OIIO::TypeDesc::UINT16, words);

    const SourceImage image = decode_image(read_file(p8), "p8");
    ASSERT_EQ(image.width, 3);
    ASSERT_EQ(image.height, 2);
    ASSERT_EQ(image.channels, int(names.size()));
    ASSERT_EQ(image.type, PixelType::u8);
    EXPECT_EQ(std::memcmp(image.pixels.data(), bytes.data(), count), 0);
    const SourceImage image16 = decode_image(read_file(p16), "p16");
    ASSERT_EQ(image16.type, PixelType::u16);
    ASSERT_EQ(image16.pixels.size(), count * 2);
    EXPECT_EQ(std::memcmp(image16.pixels.data(), words.data(), count * 2), 0);

    const Image f8 = read_image(p8);
    const Image f16 = read_image(p16);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(f8.pixels[i], float(bytes[i]) / 255.0f);
      EXPECT_EQ(f16.pixels[i], float(words[i]) / 65535.0f);
    }
  }
}

TEST(ImageFile, JpegIsThreeOrOneChannels) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> grey(64, 128);
  const std::vector<std::uint8_t> colour(192, 200);
  const auto one = write_reference(folder, "1.jpg", 8, 8, {"Y"}, OIIO::TypeDesc::UINT8, grey);
  const auto three = write_reference(folder, "3.jpg", 8, 8, {"R", "G", "B"}, OIIO::TypeDesc::UINT8, colour);
  EXPECT_EQ(decode_image(read_file(one), "1").channels, 1);
  const SourceImage image = decode_image(read_file(three), "3");
  EXPECT_EQ(image.channels, 3);
  EXPECT_NEAR(int(image.pixels[5]), 200, 2);
}

TEST(ImageFile, ExrHalfAndFloatWithOtherLayers) {
  const TemporaryFolder folder;
  std::vector<float> values(4 * 2 * 5);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(i) * 0.25f - 2;
  for (const char* compression : {"none", "zip", "piz"}) {
    for (const auto type : {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT}) {
      const auto path =
          write_reference(folder, "a.exr", 4, 2, {"R", "G", "B", "A", "Z"}, OIIO::TypeDesc(type), values, compression);
      const Image image = read_image(path);
      ASSERT_EQ(image.channels, 4);
      for (int i = 0; i < 8; ++i)
        for (int c = 0; c < 4; ++c)
          EXPECT_EQ(image.pixels[std::size_t(i * 4 + c)], values[std::size_t(i * 5 + c)]) << compression;
    }
  }
}

TEST(ImageFile, HdrIsExactRgbe) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.hdr");
  std::ofstream out(path, std::ios::binary);
  out << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  out.write("\x80\x40\x20\x81\xff\x00\x01\x88", 8);
  out.close();
  const Image image = read_image(path);
  ASSERT_EQ(image.channels, 3);
  const float expected[6] = {1, 0.5f, 0.25f, 255, 0, 1};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(image.pixels[std::size_t(i)], expected[i]);
}

TEST(ImageFile, WrittenPngComesBack) {
  const TemporaryFolder folder;
  std::vector<unsigned char> pixels(5 * 3 * 4);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<unsigned char>(i * 37);
  write_png(folder.file("a.png"), 5, 3, 4, pixels.data());
  const SourceImage image = decode_image(read_file(folder.file("a.png")), "a");
  ASSERT_EQ(image.pixels.size(), pixels.size());
  EXPECT_EQ(std::memcmp(image.pixels.data(), pixels.data(), pixels.size()), 0);
  EXPECT_EQ(folder.count(), 1u) << "temporary files are left behind";
}

TEST(ImageFile, FlatExrComesBackBitForBit) {
  const TemporaryFolder folder;
  const int width = 7;
  const int height = 70;  // more than a band
  const std::size_t count = std::size_t(width) * height;
  std::vector<float> rgb(count * 3);
  std::vector<std::uint32_t> id(count);
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = std::ldexp(float(i % 97) - 40, int(i % 60) - 30);
  rgb[3] = NAN, rgb[4] = INFINITY, rgb[5] = 1e-42f;
  for (std::size_t i = 0; i < count; ++i) id[i] = 0xffffffffu - std::uint32_t(i) * 77777u;
  write_exr(folder.file("a.exr"), width, height,
            {{"normal.Y", rgb.data() + 1, nullptr, 3}, {"R", rgb.data(), nullptr, 3}, {"id", nullptr, id.data(), 1}},
            {{"tessera:note", "hello"}, {"tessera:empty", ""}});
  const ExrLayers layers = read_exr_layers(folder.file("a.exr"));
  EXPECT_EQ(layers.width, width);
  EXPECT_EQ(layers.height, height);
  EXPECT_FALSE(layers.deep);
  EXPECT_EQ(layers.counts, std::vector<std::uint32_t>(count, 1));
  ASSERT_EQ(layers.f32.size(), 2u);
  ASSERT_EQ(layers.u32.size(), 1u);
  EXPECT_EQ(layers.u32.at("id"), id);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(std::memcmp(&layers.f32.at("R")[i], &rgb[i * 3], 4), 0);
    EXPECT_EQ(std::memcmp(&layers.f32.at("normal.Y")[i], &rgb[i * 3 + 1], 4), 0);
  }
  EXPECT_EQ(layers.attributes.at("tessera:note"), "hello");
}

TEST(ImageFile, TiledExrIsReadToo) {
  const TemporaryFolder folder;
  const std::string path = folder.file("t.exr");
  auto output = OIIO::ImageOutput::create(path);
  OIIO::ImageSpec spec(40, 20, 2, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"u", "v"};
  spec.tile_width = spec.tile_height = 16;
  std::vector<float> values(1600);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(i);
  ASSERT_TRUE(output->open(path, spec) && output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
  output->close();
  const ExrLayers layers = read_exr_layers(path);
  for (std::size_t i = 0; i < 800; ++i) ASSERT_EQ(layers.f32.at("v")[i], float(2 * i + 1));
}

TEST(ImageFile, DeepExrComesBackBitForBit) {
  const TemporaryFolder folder;
  const std::vector<std::uint32_t> counts{0, 3, 1, 0, 2, 7};
  std::vector<float> depth(13);
  std::vector<std::uint32_t> id(13);
  for (std::size_t i = 0; i < 13; ++i) depth[i] = 1.0f / float(i + 1), id[i] = std::uint32_t(i) * 0x10101010u;
  write_deep_exr(folder.file("d.exr"), 3, 2, counts,
                 {{"position.X", depth.data(), nullptr, 1}, {"id", nullptr, id.data(), 1}}, {{"a", "b"}});
  const ExrLayers layers = read_exr_layers(folder.file("d.exr"));
  EXPECT_TRUE(layers.deep);
  EXPECT_EQ(layers.counts, counts);
  ASSERT_EQ(layers.f32.at("position.X").size(), 13u);
  for (std::size_t i = 0; i < 13; ++i) EXPECT_EQ(layers.f32.at("position.X")[i], depth[i]);
  EXPECT_EQ(layers.u32.at("id"), id);
  EXPECT_EQ(layers.attributes.at("a"), "b");
}

TEST(ImageFile, UnwritableTargetsAreOutputErrorsAndLeaveNothing) {
  const TemporaryFolder folder;
  const unsigned char pixel[3] = {1, 2, 3};
  const std::string missing = folder.file("no/such/folder.png");
  EXPECT_NE(message_of([&] { write_png(missing, 1, 1, 3, pixel); }, ExitStatus::output).find(missing),
            std::string::npos);
  message_of([&] { write_png(folder.path(), 1, 1, 3, pixel); }, ExitStatus::output);
  message_of([&] { write_png("", 1, 1, 3, pixel); }, ExitStatus::output);
  if (std::filesystem::exists("/dev/full")) {
    const std::string full = message_of([&] { write_png("/dev/full", 1, 1, 3, pixel); }, ExitStatus::output);
    EXPECT_NE(full.find("No space left"), std::string::npos) << full;
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  }
  EXPECT_EQ(folder.count(), 0u);
}

TEST(ImageFile, SymbolicLinksStayLinks) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("real.png")) << "old";
  std::filesystem::create_symlink("real.png", folder.file("link.png"));
  const unsigned char pixel[3] = {1, 2, 3};
  write_png(folder.file("link.png"), 1, 1, 3, pixel);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.png")));
  EXPECT_EQ(decode_image(read_file(folder.file("real.png")), "real").width, 1);
}

std::string write_text(const TemporaryFolder& folder, const std::string& content) {
  std::ofstream(folder.file("bad"), std::ios::binary) << content;
  return folder.file("bad");
}

TEST(ImageFile, HostileHeadersAreInputErrorsThatNameTheFile) {
  const TemporaryFolder folder;
  const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  const std::string png = "\x89PNG\r\n\x1a\n";
  const std::vector<std::string> cases{
      "",
      "hello",
      "\xabKTX 20\xbb",
      hdr,
      hdr + "-Y 1 +X\n",
      hdr + "-Y 0 +X 4\n",
      hdr + "-Y -5 +X 4\n",
      hdr + "-Y 99999999999999999999 +X 4\n",
      hdr + "-Y 32768 +X 32768\n",
      hdr + "+Y 4 +X 4\n",
      hdr + "-Y 2000000000 +X 2000000000\n",
      hdr + "-Y 64 +X 64\n\x02\x02",
      "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd",
      "#?RADIANCE\nno end",
      png,
      png + std::string("\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x08\x06\0\0\0\0\0\0\0", 25),
      png + std::string("\0\0\0\rIHDR\0\0\x40\0\0\0\x40\0\x08\x06\0\0\0\0\0\0\0", 25),
      png + std::string("\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x06\0\0\0\0\0\0\0", 25),
      "\xff\xd8\xff\xe0",
      std::string("\xff\xd8\xff\xe0\0\x04\0\0\xff\xc0\0\x11\x08\0\0\0\0\x03", 18),
      std::string("\xff\xd8\xff\xe0\0\x04\0\0\xff\xc0\0\x11\x08\x01\0\x01\0\x03", 18),
      "\x76\x2f\x31\x01",
      std::string("\x76\x2f\x31\x01\x03\0\0\0", 8),
      std::string("\x76\x2f\x31\x01\x02\0\0\0a\0string\0\xff\xff\xff\x7f", 21),
      std::string("\x76\x2f\x31\x01\x02\0\0\0\0", 9),
      std::string("II*\0\x08\0\0\0", 8),
      "RIFF1234WEBPVP8 ",
  };
  for (const std::string& content : cases) {
    const std::string path = write_text(folder, content);
    const std::string message = message_of([&] { read_image(path); }, ExitStatus::input);
    EXPECT_NE(message.find(path), std::string::npos) << message;
    message_of([&] { read_exr_layers(path); }, ExitStatus::input);
    message_of([&] { decode_image(read_file(path), "x"); }, ExitStatus::input);
  }
  message_of([&] { read_image(folder.path()); }, ExitStatus::input);
  message_of([&] { read_image(folder.file("absent.png")); }, ExitStatus::input);
}

// Every truncation of valid files, and thousands of damaged ones: a picture or an Error, nothing else.
TEST(ImageFile, DamagedFilesNeverCrash) {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> bytes(12 * 9 * 4, 90);
  std::vector<float> floats(12 * 9 * 4);
  for (std::size_t i = 0; i < floats.size(); ++i) floats[i] = float(i % 13), bytes[i] = std::uint8_t(i * i);
  std::vector<std::string> files;
  files.push_back(write_reference(folder, "a.png", 12, 9, {"R", "G", "B", "A"}, OIIO::TypeDesc::UINT8, bytes));
  bytes.resize(12 * 9 * 3);
  floats.resize(12 * 9 * 3);
  files.push_back(write_reference(folder, "a.jpg", 12, 9, {"R", "G", "B"}, OIIO::TypeDesc::UINT8, bytes));
  files.push_back(write_reference(folder, "a.hdr", 12, 9, {"R", "G", "B"}, OIIO::TypeDesc::FLOAT, floats));
  int number = 0;
  for (const char* compression : {"none", "rle", "zip", "piz", "pxr24", "dwaa"}) {
    files.push_back(write_reference(folder, fmt::format("{}.exr", number++), 12, 9, {"R", "G", "B"},
                                    OIIO::TypeDesc::HALF, floats, compression));
  }
  std::uint64_t state = 1;
  const auto next = [&state](std::uint64_t limit) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (state >> 33) % limit;
  };
  int decoded = 0;
  int refused = 0;
  const auto attempt = [&](const std::vector<std::byte>& damaged) {
    try {
      decode_image(damaged, "damaged");
      ++decoded;
    } catch (const Error&) {
      ++refused;
    }
  };
  for (const std::string& path : files) {
    const std::vector<std::byte> original = read_file(path);
    for (std::size_t length = 0; length < original.size(); length += 1 + original.size() / 64) {
      attempt({original.begin(), original.begin() + std::ptrdiff_t(length)});
    }
    for (int i = 0; i < 150; ++i) {
      std::vector<std::byte> damaged = original;
      for (std::uint64_t k = 0; k <= next(4); ++k) damaged[next(damaged.size())] = std::byte(next(256));
      attempt(damaged);
    }
  }
  EXPECT_GT(decoded, 100);
  EXPECT_GT(refused, 100);
}

TEST(ImageFile, TheSharedEnvironmentsAreRead) {
  const std::filesystem::path folder = shared_assets() / "environments";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared assets here";
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const Image image = read_image(entry.path().string());
    EXPECT_EQ(image.width, 1024) << entry.path();
    EXPECT_EQ(image.height, 512);
    EXPECT_GE(image.channels, 3);
    ++seen;
  }
  EXPECT_GE(seen, 1);
}

}  // namespace
}  // namespace tessera

#include "frame/environment_file.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>

#include "base/error.hpp"
#include "frame/dispatch.hpp"
#include "io/file_bytes.hpp"
#include "src/io/temporary_folder.hpp"

namespace tessera {
namespace {

EnvironmentData small_environment() {
  Image picture(32, 16, 3);
  std::mt19937 random(3);
  for (float& value : picture.pixels) value = float(random() % 100) / 50;
  std::fill_n(picture.at(9, 4), 3, 5000.0f);
  picture.at(1, 1)[0] = -1;
  EnvironmentSettings settings;
  settings.background_size = 16;
  settings.specular_size = 8;
  settings.extract_light = true;
  settings.keep_cube = true;
  return build_environment(picture, settings, select_kernels()).data();
}

std::string message_of(std::span<const std::byte> bytes) {
  try {
    parse_environment(bytes, "file");
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::input);
    return error.what();
  }
  return {};
}

class EnvironmentFile : public testing::Test {
 protected:
  EnvironmentFile() : data_(small_environment()) {
    write_environment(path_, data_);
    bytes_ = read_file(path_);
  }
  TemporaryFolder folder_;
  std::string path_ = folder_.file("a.tsra");
  EnvironmentData data_;
  std::vector<std::byte> bytes_;
};

TEST_F(EnvironmentFile, ComesBackAsItWas) {
  EXPECT_TRUE(is_baked_environment(path_));
  EXPECT_FALSE(is_baked_environment(folder_.file("missing")));
  const EnvironmentData back = read_environment(path_);
  EXPECT_EQ(back.background.texels(), data_.background.texels());
  EXPECT_EQ(back.specular.texels(), data_.specular.texels());
  EXPECT_EQ(back.irradiance.texels(), data_.irradiance.texels());
  EXPECT_EQ(back.specular.levels(), data_.specular.levels());
  EXPECT_EQ(back.uses_cube, data_.uses_cube);
  EXPECT_EQ(back.lod_curve, data_.lod_curve);
  EXPECT_EQ(std::memcmp(&back.sh, &data_.sh, sizeof back.sh), 0);
  EXPECT_EQ(back.report.negative, 1u);
  EXPECT_EQ(back.statistics.brightest, data_.statistics.brightest);
  ASSERT_TRUE(data_.light && back.light);
  EXPECT_EQ(std::memcmp(&*back.light, &*data_.light, sizeof *back.light), 0);
}

TEST_F(EnvironmentFile, TruncatedAnywhere) {
  for (std::size_t size = 0; size < bytes_.size(); size += size < 300 ? 1 : 997)
    EXPECT_NE(message_of(std::span(bytes_).first(size)).find("file: "), std::string::npos) << size;
  bytes_.push_back(std::byte{0});
  EXPECT_NE(message_of(bytes_).find("expected"), std::string::npos);
}

// Header words replaced by whatever: never a crash, never a huge allocation, one line.
TEST_F(EnvironmentFile, DamagedAnywhere) {
  std::mt19937 random(1);
  for (int round = 0; round < 3000; ++round) {
    std::vector<std::byte> damaged = bytes_;
    const std::size_t at = round % 2 ? random() % 300 : random() % damaged.size();
    const std::byte before = damaged[at];
    damaged[at] = std::byte(random());
    if (damaged[at] == before) continue;
    const std::string message = message_of(damaged);
    EXPECT_FALSE(message.empty()) << "byte " << at;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST_F(EnvironmentFile, SizesAreCheckedBeforeMemoryIsAskedFor) {
  const std::uint32_t huge = 4096, levels = 13;
  std::memcpy(bytes_.data() + 8, &huge, 4);
  std::memcpy(bytes_.data() + 12, &levels, 4);
  EXPECT_NE(message_of(bytes_).find("bytes of texels, expected"), std::string::npos);
  const std::uint32_t odd = 100;
  std::memcpy(bytes_.data() + 8, &odd, 4);
  EXPECT_NE(message_of(bytes_).find("power of two"), std::string::npos);
  const std::uint32_t newer = 3;
  std::memcpy(bytes_.data() + 4, &newer, 4);
  EXPECT_NE(message_of(bytes_).find("version 3"), std::string::npos);
}

}  // namespace
}  // namespace tessera

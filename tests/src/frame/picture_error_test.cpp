#include "frame/picture_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace tessera {
namespace {

using Bytes = std::vector<unsigned char>;

TEST(PictureError, CountsOnlyWhatCounts) {
  const Bytes exact = {10, 20, 30, 0, 0, 0, 5, 5, 5}, rgb = {13, 20, 24, 255, 255, 255, 5, 5, 5};
  const std::vector<std::uint8_t> counts = {1, 0, 1};
  const PictureError error = picture_error(rgb, exact, counts);
  EXPECT_DOUBLE_EQ(error.mean, (3 + 0 + 6) / 6.0);
  EXPECT_EQ(error.percentile99, 6);
  EXPECT_EQ(picture_error(exact, exact, counts).mean, 0);
  EXPECT_EQ(picture_error(exact, exact, counts).percentile99, 0);
  EXPECT_EQ(picture_error(rgb, exact, std::vector<std::uint8_t>(3, 0)).mean, 0);
}

TEST(PictureError, OneInAHundredMayBeWorseButNotTwo) {
  Bytes exact(300, 100), rgb = exact;
  const std::vector<std::uint8_t> counts(100, 1);
  rgb[7] = 200;
  EXPECT_EQ(picture_error(rgb, exact, counts).percentile99, 0);
  rgb[100] = 90;
  EXPECT_EQ(picture_error(rgb, exact, counts).percentile99, 10);
}

// Against sorting, on random pictures.
TEST(PictureError, AgreesWithSorting) {
  std::mt19937 random(3);
  for (const std::size_t pixels : {1u, 99u, 100u, 101u, 5000u}) {
    Bytes exact(pixels * 3), rgb(pixels * 3);
    for (unsigned char& b : exact) b = static_cast<unsigned char>(random());
    for (unsigned char& b : rgb) b = static_cast<unsigned char>(random() >> 9);
    std::vector<std::uint8_t> counts(pixels);
    for (std::uint8_t& c : counts) c = random() % 3 != 0;
    counts[0] = 1;
    std::vector<double> largest;
    double sum = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      if (counts[i] == 0) continue;
      double most = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double d = std::abs(double(rgb[i * 3 + c]) - double(exact[i * 3 + c]));
        sum += d;
        most = std::max(most, d);
      }
      largest.push_back(most);
    }
    std::sort(largest.begin(), largest.end());
    const auto rank = static_cast<std::size_t>(std::ceil(0.99 * double(largest.size()) - 1e-9));
    const PictureError error = picture_error(rgb, exact, counts);
    EXPECT_NEAR(error.mean, sum / (3.0 * double(largest.size())), 1e-9);
    EXPECT_EQ(error.percentile99, largest[rank - 1]) << pixels;
  }
}

}  // namespace
}  // namespace tessera

#include "precompute/dominant_light.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "frame/dispatch.hpp"

namespace tessera {
namespace {

const double pi = std::acos(-1.0);

struct Disc {
  double x, y, z, radius, radiance;
};

// A sky that darkens downwards, and a disc of even radiance.
EnvironmentPicture sky_with(const Disc& disc, int width) {
  EnvironmentPicture picture{Image(width, width / 2, 3), false};
  for (int j = 0; j < width / 2; ++j)
    for (int i = 0; i < width; ++i) {
      const double theta = pi * (j + 0.5) / (width / 2), phi = 2 * pi * ((i + 0.5) / width - 0.5);
      const double x = std::sin(theta) * std::cos(phi), y = std::cos(theta), z = std::sin(theta) * std::sin(phi);
      const bool inside = x * disc.x + y * disc.y + z * disc.z > std::cos(disc.radius);
      float* rgb = picture.image.at(i, j);
      for (int c = 0; c < 3; ++c) rgb[c] = inside ? float(disc.radiance * (1 - 0.2 * c)) : float(1 + 0.3 * y);
    }
  return picture;
}

double energy(const EnvironmentPicture& picture, int channel) {
  double sum = 0;
  const int w = picture.image.width, h = picture.image.height;
  for (int j = 0; j < h; ++j)
    for (int i = 0; i < w; ++i)
      sum += double(picture.image.at(i, j)[channel]) * (std::cos(pi * j / h) - std::cos(pi * (j + 1) / h)) * 2 * pi / w;
  return sum;
}

TEST(DominantLight, FindsTheSunAndKeepsTheEnergy) {
  const Disc sun{0.48, 0.6, 0.64, 0.02, 20000};
  EnvironmentPicture picture = sky_with(sun, 1024);
  const double before[3] = {energy(picture, 0), energy(picture, 1), energy(picture, 2)};
  const auto light = extract_dominant_light(picture, select_kernels());
  ASSERT_TRUE(light.has_value());
  EXPECT_GT(
      double(light->direction[0]) * sun.x + double(light->direction[1]) * sun.y + double(light->direction[2]) * sun.z,
      std::cos(0.002));
  EXPECT_NEAR(double(light->angular_radius), sun.radius, 0.002);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR((energy(picture, c) + double(light->illuminance[c])) / before[c], 1, 1e-3);
    // Radiance above the sky around it, times the disc's solid angle (as texels draw it: to 3 %).
    const double expected = (sun.radiance * (1 - 0.2 * c) - 1.18) * 2 * pi * (1 - std::cos(sun.radius));
    EXPECT_NEAR(double(light->illuminance[c]) / expected, 1, 0.03);
  }
  // What is left has no sun: nothing stands out any more.
  EXPECT_FALSE(extract_dominant_light(picture, select_kernels()).has_value());
  for (const float value : picture.image.pixels) ASSERT_LT(value, 1.5f);
}

TEST(DominantLight, LeavesWhatIsNoCompactSource) {
  // Even light; a bright half of the sky; a spot too faint to count.
  for (const Disc& disc : {Disc{0, 1, 0, 0.1, 1.0}, Disc{0, 1, 0, 1.0, 100}, Disc{0, 0, 1, 0.01, 15}}) {
    EnvironmentPicture picture = sky_with(disc, 256);
    const AlignedVector<float> before = picture.image.pixels;
    EXPECT_FALSE(extract_dominant_light(picture, select_kernels()).has_value()) << disc.radius;
    EXPECT_EQ(picture.image.pixels, before);
  }
  EnvironmentPicture black{Image(8, 4, 3), false};
  EXPECT_FALSE(extract_dominant_light(black, select_kernels()).has_value());
}

TEST(DominantLight, OfFacesToo) {
  EnvironmentPicture picture{Image(64, 384, 3), true};
  std::fill(picture.image.pixels.begin(), picture.image.pixels.end(), 1.0f);
  for (int k = 0; k < 4; ++k) std::fill_n(picture.image.at(31 + k % 2, 2 * 64 + 31 + k / 2), 3, 5000.0f);  // +Y
  const auto light = extract_dominant_light(picture, select_kernels());
  ASSERT_TRUE(light.has_value());
  EXPECT_GT(light->direction[1], 0.9999f);
  EXPECT_NEAR(double(light->illuminance[0]), 4999 * 4 * 4.0 / (64 * 64), 0.05);
}

}  // namespace
}  // namespace tessera

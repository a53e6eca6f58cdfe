#include "precompute/environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "frame/dispatch.hpp"
#include "src/precompute/cube_texels.hpp"

namespace tessera::test {
namespace {

const double pi = std::acos(-1.0);

Image filled(int width, int height, int channels, float value) {
  Image image(width, height, channels);
  std::fill(image.pixels.begin(), image.pixels.end(), value);
  return image;
}

// A gradient, some noise, and a sun of 2 x 2 texels: 10^4 times the rest.
Image sunny(int width, int height) {
  Image image(width, height, 3);
  std::mt19937 random(11);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = 0.4f + 0.5f * float(y) / float(height) + float(random() % 100) / 400;
    }
  }
  for (int k = 0; k < 4; ++k) std::fill_n(image.at(width / 5 + k % 2, height / 4 + k / 2), 3, 6000.0f);
  return image;
}

std::vector<std::uint16_t> texels_of(const CubeView& cube) {
  return {cube.texels, cube.texels + cube_texel_count(cube.size, cube.levels) * 4};
}

void expect_white(const EnvironmentView& view) {
  for (const CubeView& cube : {view.specular, view.background}) {
    for (int level = 0; level < cube.levels; ++level) {
      const int n = cube.size >> level;
      for (int face = 0; face < 6; ++face)
        for (int j = -1; j <= n; ++j)
          for (int i = -1; i <= n; ++i)
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(texel_value(cube, level, face, i, j, c), 1, 1e-3) << level;
    }
  }
  if (view.irradiance.texels != nullptr) {
    for_each_texel(view.irradiance.size, [&](int face, int i, int j) {
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(texel_value(view.irradiance, 0, face, i, j, c), 1, 1e-3);
    });
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(view.irradiance_sh[0][c], 1, 1e-6);
    for (int k = 1; k < 9; ++k) EXPECT_NEAR(view.irradiance_sh[k][c], 0, 1e-6);
  }
}

TEST(Environment, WhiteStaysWhite) {
  const Kernels& kernels = select_kernels();
  expect_white(constant_environment(1, 1, 1, kernels).view());
  expect_white(build_environment(filled(130, 33, 3, 1), {}, kernels).view());
  EnvironmentSettings settings;
  settings.background_size = 16;
  settings.specular_size = 16;
  settings.intensity = 4;
  settings.rotation = 1;
  settings.irradiance = IrradianceForm::cube;
  expect_white(build_environment(filled(300, 150, 1, 0.25f), settings, kernels).view());
}

TEST(Environment, SizesFollowThePicture) {
  const Kernels& kernels = select_kernels();
  const Environment environment = build_environment(filled(1024, 512, 3, 1), {0, 1, 0, 0, 4}, kernels);
  const EnvironmentView view = environment.view();
  EXPECT_EQ(view.background.size, 256);
  EXPECT_EQ(view.background.levels, 9);
  EXPECT_EQ(view.specular.size, 256);
  EXPECT_EQ(view.specular.levels, 7);  // down to 4 x 4
  const Environment small_one = build_environment(filled(8, 4, 3, 1), {}, kernels);
  const EnvironmentView small = small_one.view();
  EXPECT_EQ(small.background.size, 64);
}

// The texel at column u, row v is seen along atan2(z, x) = 2 pi (u - 1/2), y = cos(pi v); rotating the environment by
// an angle about +Y moves what was along +X to cos(angle) X - sin(angle) Z.
TEST(Environment, ThingsAreWhereThePictureSays) {
  constexpr int width = 64, height = 32;
  for (const auto& [column, row] : {std::pair{32, 16}, {0, 16}, {48, 16}, {10, 5}, {63, 30}, {20, 1}}) {
    for (const float rotation : {0.0f, 0.6f, -2.5f}) {
      Image picture = filled(width, height, 3, 0);
      picture.at(column, row)[1] = 100;
      EnvironmentSettings settings;
      settings.rotation = rotation;
      settings.samples = 4;
      const Environment environment = build_environment(picture, settings, select_kernels());
      const EnvironmentView view = environment.view();

      const double theta = pi * (row + 0.5) / height, phi = 2 * pi * ((column + 0.5) / width - 0.5);
      const double px = std::sin(theta) * std::cos(phi), pz = std::sin(theta) * std::sin(phi);
      const double c = std::cos(double(rotation)), s = std::sin(double(rotation));
      const Unit expected{px * c + pz * s, std::cos(theta), pz * c - px * s};

      double sum = 0;
      Unit centre{0, 0, 0};
      for_each_texel(view.background.size, [&](int face, int i, int j) {
        const double weight =
            texel_value(view.background, 0, face, i, j, 1) * texel_solid_angle(i, j, view.background.size);
        const Unit d = texel_centre(face, i, j, view.background.size);
        centre = {centre.x + weight * d.x, centre.y + weight * d.y, centre.z + weight * d.z};
        sum += weight;
        ASSERT_EQ(texel_value(view.background, 0, face, i, j, 0), 0);
      });
      const double length = std::sqrt(dot(centre, centre));
      // Within a third of a texel of the picture.
      EXPECT_GT(dot(centre, expected) / length, std::cos(pi / height / 3)) << column << " " << row << " " << rotation;
      // As much light as the picture holds; bilinear lookups spread a texel, towards larger ones near a pole.
      const double solid_angle = 2 * pi / width * (std::cos(pi * row / height) - std::cos(pi * (row + 1) / height));
      EXPECT_NEAR(sum / (100 * solid_angle), 1, row > 2 && row < height - 2 ? 0.02 : 0.3);
      // Irradiance is brightest on the same side.
      const float(&sh)[9][3] = view.irradiance_sh;
      const Unit linear{double(sh[3][1]), double(sh[1][1]), double(sh[2][1])};
      EXPECT_GT(dot(linear, expected) / std::sqrt(dot(linear, linear)), 0.9999);
    }
  }
}

// Windows of a dark room, each some texels wide, 10 to 300 times as bright as the walls.
Image windows(int width, int height) {
  Image image = filled(width, height, 3, 0.02f);
  std::mt19937 random(5);
  for (int k = 0; k < 24; ++k) {
    const int x0 = int(random() % unsigned(width - 12)), y0 = int(random() % unsigned(height - 8));
    const float value = 0.2f * float(1 + random() % 30);
    for (int y = 0; y < 3 + k % 5; ++y)
      for (int x = 0; x < 4 + k % 7; ++x) std::fill_n(image.at(x0 + x, y0 + y), 3, value);
  }
  return image;
}

// Stripes and a horizon.
Image stripes(int width, int height) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      std::fill_n(image.at(x, y), 3, y > height / 2 ? 0.1f : x / 8 % 3 == 0 ? 4.0f : 0.8f);
  return image;
}

// The roughness that a lookup finds at a level: lod = (levels - 1) r (1 + c (1 - r)), by bisection.
double roughness_at(double level, int levels, double c) {
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double r = (low + high) / 2;
    ((levels - 1) * r * (1 + c * (1 - r)) < level ? low : high) = r;
  }
  return low;
}

// Root mean square error of a level against the sum over all texels of level 0, n = v = r: D(h) n.l, weights n.l;
// relative to the level's own RMS.
double prefilter_error(const EnvironmentView& view, int level, int count) {
  const CubeView& cube = view.specular;
  const double r = roughness_at(level, cube.levels, double(view.lod_curve)), alpha2 = r * r * r * r;
  const int n = cube.size >> level;
  std::mt19937 random(unsigned(level) + 3);
  double squares = 0, errors = 0;
  for (int k = 0; k < count; ++k) {
    const int face = int(random() % 6), i = int(random() % unsigned(n)), j = int(random() % unsigned(n));
    const Unit normal = texel_centre(face, i, j, n);
    double sum = 0, weights = 0;
    for_each_texel(cube.size, [&](int f, int a, int b) {
      const double NoL = dot(normal, texel_centre(f, a, b, cube.size));
      if (NoL <= 0) return;
      const double NoH2 = (1 + NoL) / 2, t = NoH2 * (alpha2 - 1) + 1;
      const double weight = texel_solid_angle(a, b, cube.size) * NoL / (t * t);
      sum += weight * texel_value(cube, 0, f, a, b, 0);
      weights += weight;
    });
    const double expected = sum / weights, error = texel_value(cube, level, face, i, j, 0) - expected;
    squares += expected * expected;
    errors += error * error;
  }
  return std::sqrt(errors / squares);
}

TEST(Environment, PrefilteredLevelsMatchBruteForce) {
  for (const Image& picture : {sunny(256, 128), windows(256, 128), stripes(256, 128)}) {
    EnvironmentSettings settings;
    settings.levels = 7;  // of 64 x 64: down to one texel
    const Environment environment = build_environment(picture, settings, select_kernels());
    const EnvironmentView view = environment.view();
    ASSERT_EQ(view.specular.size, 64);
    for (int level = 1; level < view.specular.levels; ++level)
      EXPECT_LT(prefilter_error(view, level, 40), 1e-3) << "level " << level;
  }
}

// Filtered importance sampling is an estimate: it gets there slowly.
TEST(Environment, SampledLevelsComeNear) {
  EnvironmentSettings settings;
  settings.samples = 1024;
  const Environment environment = build_environment(sunny(128, 64), settings, select_kernels());
  const EnvironmentView view = environment.view();
  for (int level = 1; level < view.specular.levels; ++level)
    EXPECT_LT(prefilter_error(view, level, 20), 5e-3) << "level " << level;
}

TEST(Environment, IrradianceCubeMatchesTheCosineIntegral) {
  EnvironmentSettings settings;
  settings.irradiance = IrradianceForm::cube;
  const Environment environment = build_environment(sunny(256, 128), settings, select_kernels());
  const EnvironmentView view = environment.view();
  ASSERT_NE(view.irradiance.texels, nullptr);
  const int n = view.irradiance.size;
  for (int k = 0; k < 30; ++k) {
    const int face = k % 6, i = k * 7 % n, j = k * 11 % n;
    const Unit normal = texel_centre(face, i, j, n);
    double sum = 0;
    for_each_texel(64, [&](int f, int a, int b) {
      sum += std::max(dot(normal, texel_centre(f, a, b, 64)), 0.0) * texel_solid_angle(a, b, 64) *
             texel_value(view.specular, 0, f, a, b, 1) / pi;
    });
    EXPECT_NEAR(texel_value(view.irradiance, 0, face, i, j, 1) / sum, 1, 2e-3);
  }
}

TEST(Environment, HarmonicsGiveWayToTheCubeWhereTheyRing) {
  Image picture = filled(64, 32, 3, 0.001f);
  std::fill_n(picture.at(20, 10), 3, 1000.0f);  // all light from one side: the other side rings below 0
  const auto uses_cube = [](const Image& image, const EnvironmentSettings& settings) {
    return build_environment(image, settings, select_kernels()).data().uses_cube;
  };
  EnvironmentSettings settings;
  EXPECT_TRUE(uses_cube(picture, settings));
  EXPECT_FALSE(uses_cube(filled(64, 32, 3, 1), settings));
  settings.irradiance = IrradianceForm::harmonics;
  EXPECT_FALSE(uses_cube(picture, settings));
  settings.irradiance = IrradianceForm::automatic;
  settings.sh_window = 0.2f;  // damped until nothing is negative
  EXPECT_FALSE(uses_cube(picture, settings));
}

TEST(Environment, FirefliesAreDimmedOnlyIfAsked) {
  Image picture = filled(32, 16, 3, 1);
  picture.at(3, 4)[0] = 500;
  EnvironmentSettings settings;
  EXPECT_EQ(build_environment(picture, settings, select_kernels()).report().fireflies, 0u);
  settings.firefly_limit = 10;
  const Environment dimmed = build_environment(picture, settings, select_kernels());
  EXPECT_EQ(dimmed.report().fireflies, 1u);
  EXPECT_NEAR(dimmed.data().statistics.brightest, 0.2126 * 10 + (0.7152 + 0.0722) / 50, 1e-4);
}

// Between neighbours across an edge of the cube, no larger steps than inside faces.
TEST(Environment, EdgesDoNotShow) {
  Image picture(256, 128, 3);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      std::fill_n(picture.at(x, y), 3, float(2 + std::sin(2 * pi * x / picture.width * 2) * std::sin(pi * y / 128.0)));
  const Environment environment = build_environment(picture, {}, select_kernels());
  const EnvironmentView view = environment.view();
  for (const CubeView& cube : {view.specular, view.background}) {
    for (int level = 0; level < cube.levels && cube.size >> level >= 4; ++level) {
      const int n = cube.size >> level;
      double inside = 0, across = 0;
      for_each_texel(n, [&](int face, int i, int j) {
        const double here = texel_value(cube, level, face, i, j, 0);
        for (const auto& [di, dj] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          const bool leaves = i + di < 0 || i + di >= n || j + dj < 0 || j + dj >= n;
          double& largest = leaves ? across : inside;
          largest = std::max(largest, std::abs(texel_value(cube, level, face, i + di, j + dj, 0) - here));
        }
      });
      EXPECT_LE(across, inside * 1.05 + 2e-3) << "level " << level << " of " << cube.levels;
    }
  }
}

void expect_same_bits(EnvironmentSettings settings) {
  const Image picture = sunny(64, 32);
  settings.rotation = 0.4f;
  settings.irradiance = IrradianceForm::cube;
  std::vector<std::uint16_t> specular, background, cube;
  std::array<float, 27> sh{};
  for (const Kernels* kernels : built_kernels()) {
    if (!cpu_runs(*kernels)) continue;
    for (const int threads : {1, 2, 7}) {
      run_with_threads(threads, [&] {
        const Environment environment = build_environment(picture, settings, *kernels);
        const EnvironmentView view = environment.view();
        if (specular.empty()) {
          specular = texels_of(view.specular);
          background = texels_of(view.background);
          cube = texels_of(view.irradiance);
          std::copy_n(&view.irradiance_sh[0][0], 27, sh.begin());
        }
        EXPECT_EQ(texels_of(view.specular), specular) << kernels->isa << " " << threads;
        EXPECT_EQ(texels_of(view.background), background) << kernels->isa << " " << threads;
        EXPECT_EQ(texels_of(view.irradiance), cube) << kernels->isa << " " << threads;
        EXPECT_TRUE(std::equal(sh.begin(), sh.end(), &view.irradiance_sh[0][0])) << kernels->isa << " " << threads;
      });
    }
  }
}

TEST(Environment, SameBitsForAnyInstructionSetAndThreadCount) {
  expect_same_bits({});
  EnvironmentSettings sampled;
  sampled.samples = 64;
  expect_same_bits(sampled);
}

void expect_sound(const EnvironmentView& view) {
  for (const CubeView& cube : {view.specular, view.background}) {
    for (const std::uint16_t half : texels_of(cube)) ASSERT_LE(half, 0x7bff);  // finite, not negative
  }
  for (const auto& row : view.irradiance_sh)
    for (const float value : row) ASSERT_TRUE(std::isfinite(value));
}

TEST(Environment, HostilePictures) {
  const Kernels& kernels = select_kernels();
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  EnvironmentSettings quick;
  quick.samples = 8;
  for (const float value : {nan, inf, -inf, -1.0f, 3e38f, 1e-44f, 70000.0f}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {7, 1}, {16, 8}}) {
      const Environment environment = build_environment(filled(width, height, 3, value), quick, kernels);
      expect_sound(environment.view());
      const std::size_t texels = std::size_t(width * height);
      EXPECT_EQ(environment.report().non_finite, std::isfinite(value) ? 0 : texels);
      EXPECT_EQ(environment.report().negative, value < 0 ? texels : 0);
      const bool bright = std::isfinite(value) && value > 65504;
      EXPECT_EQ(environment.report().clamped, bright ? 6u * 64 * 64 : 0u);
    }
  }
  for (const int channels : {1, 2, 3, 4}) {
    const Environment environment = build_environment(filled(4, 2, channels, 0.5f), quick, kernels);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(texel_value(environment.view().background, 0, 3, 5, 5, c), 0.5);
  }
  EXPECT_THROW(build_environment(Image(), quick, kernels), Error);
  Image huge;
  huge.width = huge.height = 1 << 15;
  huge.channels = 3;
  EXPECT_THROW(build_environment(huge, quick, kernels), Error);
}

}  // namespace
}  // namespace tessera::test

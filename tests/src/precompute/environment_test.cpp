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
  return {cube.texels, cube.texels + cube_level_offset(cube.size, cube.levels) * 4};
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

// Every level against the sum over all texels of level 0, n = v = r: D(h) n.l, weights n.l. The cube is the default for
// this picture; RMS errors are relative to the level's own RMS.
TEST(Environment, PrefilteredLevelsMatchBruteForce) {
  const Environment environment = build_environment(sunny(256, 128), {}, select_kernels());
  const EnvironmentView view = environment.view();
  const CubeView& cube = view.specular;
  ASSERT_EQ(cube.size, 64);
  struct Source {
    Unit d;
    double solid_angle, radiance;
  };
  std::vector<Source> sources;
  for_each_texel(cube.size, [&](int face, int i, int j) {
    sources.push_back(
        {texel_centre(face, i, j, cube.size), texel_solid_angle(i, j, cube.size), texel_value(cube, 0, face, i, j, 0)});
  });
  for (int level = 1; level < cube.levels; ++level) {
    const double r = double(level) / (cube.levels - 1), alpha2 = r * r * r * r;
    const int n = cube.size >> level, step = std::max(n / 8, 1);
    double squares = 0, errors = 0, count = 0;
    for (int face = 0; face < 6; ++face) {
      for (int j = step / 2; j < n; j += step) {
        for (int i = step / 2; i < n; i += step) {
          const Unit normal = texel_centre(face, i, j, n);
          double sum = 0, weights = 0;
          for (const Source& source : sources) {
            const double NoL = dot(normal, source.d);
            if (NoL <= 0) continue;
            const double NoH2 = (1 + NoL) / 2, t = NoH2 * (alpha2 - 1) + 1;
            const double weight = source.solid_angle * NoL / (t * t);
            sum += weight * source.radiance;
            weights += weight;
          }
          const double expected = sum / weights, error = texel_value(cube, level, face, i, j, 0) - expected;
          squares += expected * expected;
          errors += error * error;
          ++count;
        }
      }
    }
    EXPECT_LT(std::sqrt(errors / squares), 5e-3) << "level " << level;
  }
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

TEST(Environment, SameBitsForAnyInstructionSetAndThreadCount) {
  const Image picture = sunny(64, 32);
  EnvironmentSettings settings;
  settings.rotation = 0.4f;
  settings.samples = 64;
  std::vector<std::uint16_t> specular, background;
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
          std::copy_n(&view.irradiance_sh[0][0], 27, sh.begin());
        }
        EXPECT_EQ(texels_of(view.specular), specular) << kernels->isa << " " << threads;
        EXPECT_EQ(texels_of(view.background), background) << kernels->isa << " " << threads;
        EXPECT_TRUE(std::equal(sh.begin(), sh.end(), &view.irradiance_sh[0][0])) << kernels->isa << " " << threads;
      });
    }
  }
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

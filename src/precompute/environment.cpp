#include "precompute/environment.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "precompute/prefilter.hpp"

namespace tessera {
namespace {

constexpr float brightest = 1e30f;  // sums of a few million of these stay finite

// RGB, finite, non-negative, times intensity.
Image sanitised(const Image& picture, float intensity, EnvironmentReport& report) {
  Image out(picture.width, picture.height, 3);
  struct Counts {
    std::size_t negative = 0, non_finite = 0;
  };
  std::vector<Counts> counts(std::size_t(picture.height));
  parallel_for(counts.size(), [&](std::size_t row) {
    for (int x = 0; x < picture.width; ++x) {
      const float* in = picture.at(x, int(row));
      float* texel = out.at(x, int(row));
      bool negative = false, non_finite = false;
      for (int c = 0; c < 3; ++c) {
        const float value = in[picture.channels < 3 ? 0 : c];
        non_finite |= !std::isfinite(value);
        negative |= value < 0;
        texel[c] = std::isfinite(value) && value > 0 ? std::min(value * intensity, brightest) : 0.0f;
      }
      counts[row].negative += negative;
      counts[row].non_finite += non_finite;
    }
  });
  for (const Counts& row : counts) {
    report.negative += row.negative;
    report.non_finite += row.non_finite;
  }
  return out;
}

CubeLevel resample(const Image& picture, int size, float rotation, const Kernels& kernels) {
  CubeLevel level(size);
  float cosine = 1, sine = 0;
  kernels.evaluate(MathFunction::cos, &rotation, &rotation, &cosine, 1);
  kernels.evaluate(MathFunction::sin, &rotation, &rotation, &sine, 1);
  // At least four points per texel each way, and two per texel of the picture, so that no texel falls between points.
  const int samples = std::clamp((picture.width / 2 + size - 1) / size, 4, 64);
  for_cube_rows(size, [&](CubeRows rows) {
    rows.out = level.face(rows.face);
    kernels.equirect_to_cube({{picture.pixels.data(), picture.width, picture.height}, {cosine, sine}, samples, rows});
  });
  return level;
}

}  // namespace

EnvironmentView Environment::view() const {
  EnvironmentView view{specular_.view(), background_.view(), {}};
  std::copy_n(&irradiance_.coefficients[0][0], 27, &view.irradiance_sh[0][0]);
  return view;
}

Environment build_environment(const Image& equirect, const EnvironmentSettings& settings, const Kernels& kernels) {
  if (equirect.width < 1 || equirect.height < 1 || equirect.channels < 1) {
    throw input_error("environment: the picture has no pixels");
  }
  if (std::size_t(equirect.width) * std::size_t(equirect.height) >= std::size_t{1} << 29) {
    throw input_error("environment: the picture has {} x {} pixels; fewer than 2^29 are possible", equirect.width,
                      equirect.height);
  }
  Environment environment;
  const Image picture = sanitised(equirect, settings.intensity, environment.report_);
  environment.irradiance_ =
      project_irradiance({picture.pixels.data(), picture.width, picture.height}, settings.rotation, kernels);

  // A face spans a quarter of the horizon and half of the height.
  const int finest = std::max((picture.width + 3) / 4, (picture.height + 1) / 2);
  const int natural = std::clamp(int(std::bit_ceil(unsigned(finest))), 64, 1024);
  const int background_size = settings.background_size > 0 ? settings.background_size : natural;
  const int specular_size = std::min(settings.specular_size > 0 ? settings.specular_size : 256, background_size);

  CubeLevel level = resample(picture, std::max(background_size, natural), settings.rotation, kernels);
  while (level.size > background_size) level = halved(level);
  environment.background_ = Cube(background_size, log2_of(background_size) + 1);
  for (int k = 0; k < environment.background_.levels(); ++k) {
    if (k > 0) level = halved(level);
    const std::size_t clamped = environment.background_.store(k, level, kernels);
    if (k == 0) environment.report_.clamped = clamped;
    if (level.size != specular_size) continue;
    // The last level has 4 x 4 texels.
    const int levels = std::max(log2_of(specular_size) - 1, 1);
    environment.specular_ = prefiltered(level, levels, settings.samples, kernels);
  }
  return environment;
}

Environment constant_environment(float red, float green, float blue, const Kernels& kernels) {
  Image texel(1, 1, 3);
  texel.pixels = {red, green, blue};
  return build_environment(texel, {}, kernels);
}

}  // namespace tessera

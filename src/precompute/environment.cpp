#include "precompute/environment.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "precompute/angles.hpp"
#include "precompute/prefilter.hpp"
#include "precompute/texel_geometry.hpp"

namespace tessera {
namespace {

constexpr float brightest = 1e30f;  // sums of a few million of these stay finite

// RGB, finite, non-negative, times intensity, within the firefly limit.
EnvironmentPicture sanitised(const EnvironmentPicture& picture, const EnvironmentSettings& settings,
                             EnvironmentReport& report) {
  const Image& image = picture.image;
  EnvironmentPicture out{Image(image.width, image.height, 3), picture.faces};
  std::vector<EnvironmentReport> counts(std::size_t(image.height));
  parallel_for(counts.size(), [&](std::size_t row) {
    for (int x = 0; x < image.width; ++x) {
      const float* in = image.at(x, int(row));
      float* texel = out.image.at(x, int(row));
      bool negative = false, non_finite = false;
      for (int c = 0; c < 3; ++c) {
        const float value = in[image.channels < 3 ? 0 : c];
        non_finite |= !std::isfinite(value);
        negative |= value < 0;
        texel[c] = std::isfinite(value) && value > 0 ? std::min(value * settings.intensity, brightest) : 0.0f;
      }
      counts[row].negative += negative;
      counts[row].non_finite += non_finite;
      const float peak = std::max({texel[0], texel[1], texel[2]});
      if (!(settings.firefly_limit > 0) || peak <= settings.firefly_limit) continue;
      ++counts[row].fireflies;
      for (int c = 0; c < 3; ++c) texel[c] *= settings.firefly_limit / peak;  // keeps its hue
    }
  });
  for (const EnvironmentReport& row : counts) {
    report.negative += row.negative;
    report.non_finite += row.non_finite;
    report.fireflies += row.fireflies;
  }
  return out;
}

EnvironmentStatistics statistics_of(const EnvironmentPicture& picture, const Kernels& kernels) {
  const TexelGeometry geometry(picture, kernels);
  struct Row {
    double sum[3] = {0, 0, 0}, solid_angle = 0, brightest = 0;
  };
  std::vector<Row> rows(std::size_t(picture.image.height));
  parallel_for(rows.size(), [&](std::size_t y) {
    Row& row = rows[y];
    for (int x = 0; x < picture.image.width; ++x) {
      const float* rgb = picture.image.at(x, int(y));
      const double w = geometry.at(x, int(y)).solid_angle;
      for (int c = 0; c < 3; ++c) row.sum[c] += double(rgb[c]) * w;
      row.solid_angle += w;
      row.brightest =
          std::max(row.brightest, 0.2126 * double(rgb[0]) + 0.7152 * double(rgb[1]) + 0.0722 * double(rgb[2]));
    }
  });
  EnvironmentStatistics statistics;
  double solid_angle = 0;
  for (const Row& row : rows) {
    for (int c = 0; c < 3; ++c) statistics.mean[c] += row.sum[c];
    solid_angle += row.solid_angle;
    statistics.brightest = std::max(statistics.brightest, row.brightest);
  }
  for (double& mean : statistics.mean) mean /= solid_angle;
  return statistics;
}

CubeLevel resample(const EnvironmentPicture& picture, int size, float rotation, const Kernels& kernels) {
  CubeLevel level(size);
  const Turn turn = turn_by(rotation, kernels);
  const Image& image = picture.image;
  const int across = picture.faces ? 2 * picture.face_size() : image.width / 2;
  // At least four points per texel each way, and two per texel of the picture, so that no texel falls between points;
  // faces that lie texel on texel are copied.
  const bool aligned = picture.faces && picture.face_size() == size && rotation == 0;
  const int samples = aligned ? 1 : std::clamp((across + size - 1) / size, 4, 64);
  for_cube_rows(size, [&](CubeRows rows) {
    rows.out = level.face(rows.face);
    if (picture.faces)
      kernels.faces_to_cube({{image.pixels.data(), image.width}, {turn.cosine, turn.sine}, samples, rows});
    else
      kernels.equirect_to_cube(
          {{image.pixels.data(), image.width, image.height}, {turn.cosine, turn.sine}, samples, rows});
  });
  return level;
}

IrradianceSh project(const EnvironmentPicture& picture, float rotation, const Kernels& kernels) {
  const Image& image = picture.image;
  if (picture.faces) return project_irradiance(CubeFacesView{image.pixels.data(), image.width}, rotation, kernels);
  return project_irradiance(EquirectView{image.pixels.data(), image.width, image.height}, rotation, kernels);
}

// As fine as the picture: a face spans a quarter of the horizon and half of the height.
int natural_size(const EnvironmentPicture& picture) {
  const Image& image = picture.image;
  const int finest = picture.faces ? image.width : std::max((image.width + 3) / 4, (image.height + 1) / 2);
  return std::clamp(int(std::bit_ceil(unsigned(finest))), 64, 1024);
}

bool wants_cube(const EnvironmentSettings& settings, const IrradianceSh& sh) {
  if (settings.irradiance != IrradianceForm::automatic) return settings.irradiance == IrradianceForm::cube;
  return least_irradiance(sh) < 0;
}

// Turns a light with the environment.
void rotate(DominantLight& light, float rotation, const Kernels& kernels) {
  const auto [cosine, sine] = turn_by(rotation, kernels);
  const float x = light.direction[0], z = light.direction[2];
  light.direction[0] = x * cosine + z * sine;
  light.direction[2] = z * cosine - x * sine;
}

}  // namespace

EnvironmentView Environment::view() const {
  EnvironmentView view{data_.specular.view(), data_.background.view(), {}, data_.lod_curve, {}};
  std::copy_n(&data_.sh.coefficients[0][0], 27, &view.irradiance_sh[0][0]);
  if (data_.uses_cube) view.irradiance = data_.irradiance.view();
  return view;
}

Environment build_environment(const EnvironmentPicture& given, const EnvironmentSettings& settings,
                              const Kernels& kernels) {
  EnvironmentData data;
  EnvironmentPicture picture = sanitised(given, settings, data.report);
  data.statistics = statistics_of(picture, kernels);
  if (settings.extract_light) data.light = extract_dominant_light(picture, kernels);
  if (data.light) rotate(*data.light, settings.rotation, kernels);
  data.sh = windowed(project(picture, settings.rotation, kernels), settings.sh_window);

  const int natural = natural_size(picture);
  const int background_size = settings.background_size > 0 ? settings.background_size : natural;
  const int specular_size = std::min(settings.specular_size > 0 ? settings.specular_size : 256, background_size);
  CubeLevel level = resample(picture, std::max(background_size, natural), settings.rotation, kernels);
  while (level.size > background_size) level = halved(level);
  data.background = Cube(background_size, log2_of(background_size) + 1);
  for (int k = 0; k < data.background.levels(); ++k) {
    if (k > 0) level = halved(level);
    const std::size_t clamped = data.background.store(k, level, kernels);
    if (k == 0) data.report.clamped = clamped;
    if (level.size != specular_size) continue;
    const int levels = settings.levels > 0 ? std::min(settings.levels, log2_of(specular_size) + 1)
                                           : std::max(log2_of(specular_size) - 1, 1);
    data.lod_curve = prefilter_curve;
    data.specular = prefiltered(level, levels, settings.samples, kernels);
    data.uses_cube = wants_cube(settings, data.sh);
    if (data.uses_cube || settings.keep_cube) data.irradiance = irradiance_cube(level, kernels);
  }
  return Environment(std::move(data));
}

Environment build_environment(const Image& equirect, const EnvironmentSettings& settings, const Kernels& kernels) {
  return build_environment(arrange(equirect, EnvironmentLayout::equirect, "environment"), settings, kernels);
}

Environment constant_environment(float red, float green, float blue, const Kernels& kernels) {
  Image texel(1, 1, 3);
  texel.pixels = {red, green, blue};
  return build_environment(texel, {}, kernels);
}

}  // namespace tessera

// Image-based lighting: how levels are filtered, and in which format they are kept.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/parallel.hpp"
#include "bench/chart/ibl_world.hpp"
#include "bench/chart/measure.hpp"
#include "bench/chart/samplers.hpp"
#include "cli/prefilter_check.hpp"
#include "precompute/prefilter.hpp"
#include "precompute/sampling_texture.hpp"
#include "reference/convolution.hpp"

namespace tessera::chart {
namespace {

using reference::Vec3;

// The world on faces of this size, rounded to halves as a cube's sharpest level is.
CubeLevel level_of(const World& world, int size, const Kernels& kernels) {
  EnvironmentSettings settings;
  settings.specular_size = settings.background_size = size;
  settings.levels = 1;
  return build_environment(world.picture, settings, kernels).data().specular.load(0, kernels);
}

Error prefilter_error(const Cube& cube, bool quick, const Kernels& kernels) {
  Error error;
  for (const cli::LevelError& level : cli::check_prefilter(cube, prefilter_curve, quick ? 30 : 120, kernels)) {
    error.max = std::max(error.max, level.rms);
    error.mean += level.rms / (cube.levels() - 1);
  }
  error.rms = error.max;
  return error;
}

}  // namespace

Plot prefilter_plot(Session& session, const World& world) {
  Plot plot;
  plot.id = "ibl-prefilter";
  plot.title = "Prefiltering: sums over a tree against sampled points";
  plot.error_name = "largest RMS error of a level, of its RMS";
  plot.domain = "GGX, n = v = r, all levels down to 4 x 4, in " + world.title;
  plot.truth = "the sum over all texels of level 0";
  const auto add = [&](int size, int samples) {
    const std::string name = samples == 0 ? "sums" : fmt::format("{} points", samples);
    session.progress(fmt::format("{}: {}, {}", plot.id, name, size));
    const Kernels& widest = *session.kernels.back();
    const CubeLevel level = level_of(world, size, widest);
    const int levels = log2_of(size) - 1;
    Point point = describe(catalogue::lookup_of(samples == 0 ? "ibl-prefilter-sums" : "ibl-prefilter-points"), "");
    point.id = fmt::format("ibl-prefilter-{}-{}", samples, size);
    point.title = fmt::format("{}, {} x {}", name, size, size);
    const std::size_t texels = 6 * std::size_t(size) * std::size_t(size) / 3;
    for (const Kernels* kernels : session.kernels)
      run_with_threads(1, [&] {
        point.cost[kernels->isa] = session.time(texels, [&] { (void)prefiltered(level, levels, samples, *kernels); });
      });
    point.method = prefilter_error(prefiltered(level, levels, samples, widest), session.quick, widest);
    plot.points.push_back(point);
  };
  for (const int size : session.quick ? std::vector{64} : std::vector{64, 128, 256}) add(size, 0);
  for (const int samples : session.quick ? std::vector{64, 512} : std::vector{32, 128, 512, 2048}) add(64, samples);
  return plot;
}

Plot level_plot(Session& session, const World& world) {
  Plot plot;
  plot.id = "ibl-levels";
  plot.title = "How many levels, and which roughness they hold";
  plot.error_name = "mean over r of the RMS error of lookups, of their RMS";
  plot.domain = "r 0.1 to 1, trilinear lookups all over the sphere, 128 x 128, in " + world.title;
  plot.truth = "the lobe's integral at that roughness";
  plot.measure = Measure::mean;
  const Kernels& kernels = *session.kernels.back();
  const CubeLevel level = level_of(world, 128, kernels);
  const int steps = session.quick ? 9 : 18, count = session.quick ? 24 : 96;
  std::mt19937 random(6);
  std::normal_distribution<double> gauss;
  std::vector<Vec3> axes;
  for (int k = 0; k < steps * count; ++k) {
    const double x = gauss(random), y = gauss(random), z = gauss(random);
    axes.push_back(normalize(Vec3{x, y, z}));
  }
  const std::vector<double> roughness = spread(0.1, 1, steps);
  const reference::CubeSum sum(cli::as_sphere(level));
  std::vector<double> truth(axes.size());
  parallel_for(std::size_t(steps), [&](std::size_t step) {
    const std::size_t first = step * std::size_t(count);
    const std::vector<Vec3> means = sum.convolved({&axes[first], std::size_t(count)}, roughness[step]);
    for (std::size_t k = 0; k < means.size(); ++k) truth[first + k] = means[k].y;
  });
  for (const int levels : {5, 6, 7, 8})
    for (const float curve : {0.0f, 0.5f, 1.0f}) {
      Point point;
      point.id = fmt::format("ibl-levels-{}-{}", levels, int(curve * 100));
      point.title = fmt::format("{} levels, curve {}", levels, curve);
      point.formula = "level = (levels - 1) r (1 + c (1 - r))";
      point.paper = curve == 1 ? "Filament: r (2 - r)" : curve == 0 ? "even steps" : "";
      point.file = "src/precompute/prefilter.cpp";
      session.progress(plot.id + ": " + point.title);
      const Cube cube = prefiltered(level, levels, 0, kernels, curve);
      const std::size_t texels = cube.texels().size() / 4;
      run_with_threads(1, [&] {
        point.cost[kernels.isa] = session.time(texels, [&] { (void)prefiltered(level, levels, 0, kernels, curve); });
      });
      for (int step = 0; step < steps; ++step) {
        const double r = roughness[std::size_t(step)];
        double squares = 0, errors = 0;
        for (int k = 0; k < count; ++k) {
          const std::size_t i = std::size_t(step * count + k);
          alignas(64) float out[4][tile_pixels];
          BackgroundArgs args{};
          args.corner[0] = float(axes[i].x);
          args.corner[1] = float(axes[i].y);
          args.corner[2] = float(axes[i].z);
          args.cube = cube.view();
          args.lod = float((levels - 1) * r * (1 + double(curve) * (1 - r)));
          args.width = args.height = 1;
          for (int c = 0; c < 4; ++c) args.rgba[c] = out[c];
          kernels.background(args);
          errors += (double(out[1][0]) - truth[i]) * (double(out[1][0]) - truth[i]);
          squares += truth[i] * truth[i];
        }
        const double rms = std::sqrt(errors / squares);
        point.method.mean += rms / steps;
        point.method.max = std::max(point.method.max, rms);
      }
      point.method.rms = point.method.mean;
      plot.points.push_back(point);
    }
  return plot;
}

Plot format_plot(Session& session, const World& world) {
  Plot plot;
  plot.id = "ibl-formats";
  plot.title = "Formats of an environment's texels";
  plot.error_name = "largest error of a lookup, of the mean radiance";
  plot.domain = "trilinear lookups in a cube of 128 x 128, directions all over the sphere, in " + world.title;
  plot.truth = "the same lookup in RGBA32F";
  constexpr int size = 128, levels = 5;
  constexpr std::size_t count = 1 << 15;
  std::mt19937 random(2);
  std::normal_distribution<float> gauss;
  std::vector<float> in[4], out[3];
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t c = 0; c < 3; ++c) in[c].push_back(gauss(random));
    in[3].push_back(float(k % 400) / 100);
  }
  for (auto& channel : out) channel.resize(count);
  std::vector<CubeLevel> mips = {level_of(world, size, *session.kernels.back())};
  while (int(mips.size()) < levels) mips.push_back(halved(mips.back()));
  std::vector<double> truth;
  const std::pair<SamplingFormat, const char*> formats[] = {{SamplingFormat::rgba32_float, "rgba32f"},
                                                            {SamplingFormat::rgba16_float, "rgba16f"},
                                                            {SamplingFormat::rgb9_e5, "rgb9e5"}};
  for (const auto& [format, id] : formats) {
    const SamplingTexture texture = build_sampling_texture(
        format, SamplingLayout::linear, true, size, levels, [&](int level, int face, int x, int y) {
          const CubeLevel& mip = mips[std::size_t(level)];
          const float* texel = mip.face(face) + (y * mip.size + x) * 4;
          return SamplingColor{texel[0], texel[1], texel[2]};
        });
    const SamplingArgs args{texture.view,
                            {in[0].data(), in[1].data(), in[2].data(), in[3].data()},
                            {out[0].data(), out[1].data(), out[2].data()},
                            count};
    Point point = describe(catalogue::lookup_of(id), "");
    point.id = std::string("ibl-format-") + id;
    point.extra["bytes"] = double(texture.bytes);
    add_sampler_counts(session, point, format, SamplingLayout::linear, SamplingFilter::trilinear, true);
    session.progress(plot.id + ": " + point.title);
    for (const Kernels* kernels : session.kernels)
      if (const SamplingKernel* kernel =
              sampler_of(kernels->isa, format, SamplingLayout::linear, SamplingFilter::trilinear, true))
        point.cost[kernels->isa] = session.time(count, [&] { kernel->run(args); });
    std::vector<double> found;
    for (const float value : out[1]) found.push_back(double(value) / world.mean);
    if (truth.empty()) truth = found;
    point.method = absolute_error(found, truth);
    plot.points.push_back(point);
  }
  return plot;
}

}  // namespace tessera::chart

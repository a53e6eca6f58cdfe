// Texture and cubemap sampling: formats, layouts and filters, by how much memory the samples roam over.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "bench/chart/measure.hpp"
#include "bench/chart/samplers.hpp"
#include "kernels/sampling.hpp"
#include "precompute/sampling_texture.hpp"

namespace tessera::chart {
namespace {

template <class Value>
struct Named {
  Value value;
  const char* id;  // among catalogue::lookups()
  [[nodiscard]] const catalogue::Lookup& text() const { return catalogue::lookup_of(id); }
};

constexpr std::array<Named<SamplingFormat>, 4> formats = {{{SamplingFormat::rgba32_float, "rgba32f"},
                                                           {SamplingFormat::rgba16_float, "rgba16f"},
                                                           {SamplingFormat::rgb9_e5, "rgb9e5"},
                                                           {SamplingFormat::r11_g11_b10, "r11g11b10f"}}};
constexpr std::array<Named<SamplingLayout>, 4> layouts = {{{SamplingLayout::linear, "linear"},
                                                           {SamplingLayout::tiled_4, "tiled4"},
                                                           {SamplingLayout::tiled_8, "tiled8"},
                                                           {SamplingLayout::morton, "morton"}}};
constexpr std::array<Named<SamplingFilter>, 3> filters = {{{SamplingFilter::nearest, "nearest"},
                                                           {SamplingFilter::bilinear, "bilinear"},
                                                           {SamplingFilter::trilinear, "trilinear"}}};

// Where samples lie. Scattered: anywhere, each on its own. Turned: along lines across the texture, one texel apart, at
// 60 degrees to its rows, as a surface that is turned on the screen reads it.
enum class Pattern { scattered, turned };

struct Samples {
  std::vector<float> in[4], out[3];
};

Samples make_samples(Pattern pattern, bool cube, int size, int levels, std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, 1);
  std::normal_distribution<float> gauss;
  Samples samples;
  for (std::size_t k = 0; k < count; ++k) {
    if (cube) {
      for (std::size_t c = 0; c < 3; ++c) samples.in[c].push_back(gauss(random));
    } else if (pattern == Pattern::scattered) {
      for (std::size_t c = 0; c < 2; ++c) samples.in[c].push_back(unit(random));
    } else {
      // Squares of 32 pixels, as a tile of the renderer is shaded, one after another over the texture.
      const double tile = double(k / 1024), px = double(k % 32), py = double(k / 32 % 32), across = size / 32.0;
      const double x = 32 * std::fmod(tile, across) + px, y = 32 * std::fmod(std::floor(tile / across), across) + py;
      samples.in[0].push_back(float((0.5 * x - 0.866 * y) / size));
      samples.in[1].push_back(float((0.866 * x + 0.5 * y) / size));
    }
    samples.in[cube ? 3 : 2].push_back(unit(random) * float(levels - 1));
  }
  for (auto& plane : samples.in) plane.resize(count);
  for (auto& plane : samples.out) plane.resize(count);
  return samples;
}

SamplingColor smooth_colour(int, int face, int x, int y) {
  const float a = float(x % 61) / 61, b = float(y % 53) / 53;
  return {0.1f + a, 0.1f + b, 0.2f + 0.1f * float(face)};
}

SamplingTexture texture_of(SamplingFormat format, SamplingLayout layout, bool cube, int size) {
  const int levels = std::countr_zero(unsigned(size)) - std::countr_zero(unsigned(smallest_sampling_level)) + 1;
  return build_sampling_texture(format, layout, cube, size, levels, smooth_colour);
}

std::map<std::string, Cost> time_sampling(Session& session, const SamplingTexture& texture, SamplingFormat format,
                                          SamplingLayout layout, SamplingFilter filter, bool cube, Pattern pattern) {
  // As many samples as touch all of it, within reason.
  const std::size_t texels = std::size_t(texture.view.size) * std::size_t(texture.view.size) * (cube ? 6 : 1);
  const std::size_t count = std::clamp<std::size_t>(texels, 4096, session.quick ? 1u << 18 : 1u << 21);
  Samples samples = make_samples(pattern, cube, texture.view.size, texture.view.levels, count);
  SamplingArgs args{};
  args.texture = texture.view;
  for (std::size_t k = 0; k < 4; ++k) args.in[k] = samples.in[k].data();
  for (std::size_t k = 0; k < 3; ++k) args.out[k] = samples.out[k].data();
  args.count = count;
  std::map<std::string, Cost> cost;
  for (const Kernels* kernels : session.kernels)
    if (const SamplingKernel* kernel = sampler_of(kernels->isa, format, layout, filter, cube))
      cost[kernels->isa] = session.time(count, [&] { kernel->run(args); });
  return cost;
}

// What a format loses of a colour, as a part of its brightest channel: radiances from 2^-6 to 2^12, channels between
// none and all of the brightest. Through the kernel: one texel, read back.
Error format_error(const Session& session, SamplingFormat format) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-6, 12), part(0, 1);
  constexpr int size = 256;
  std::vector<SamplingColor> colours;
  for (int k = 0; k < size * size; ++k) {
    const double brightest = std::exp2(exponent(random));
    SamplingColor c = {float(brightest), float(brightest * part(random)), float(brightest * part(random))};
    std::rotate(c.begin(), c.begin() + k % 3, c.end());
    colours.push_back(c);
  }
  const SamplingTexture texture =
      build_sampling_texture(format, SamplingLayout::linear, false, size, 1,
                             [&](int, int, int x, int y) { return colours[std::size_t(y) * size + std::size_t(x)]; });
  Samples samples;
  for (int k = 0; k < size * size; ++k) {
    samples.in[0].push_back((float(k % size) + 0.5f) / size);
    samples.in[1].push_back((float(k / size) + 0.5f) / size);
  }
  SamplingArgs args{texture.view, {samples.in[0].data(), samples.in[1].data()}, {}, colours.size()};
  for (std::size_t c = 0; c < 3; ++c) {
    samples.out[c].resize(colours.size());
    args.out[c] = samples.out[c].data();
  }
  sampler_of(session.kernels.back()->isa, format, SamplingLayout::linear, SamplingFilter::nearest, false)->run(args);
  std::vector<double> found, truth;
  for (std::size_t k = 0; k < colours.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      const double brightest = double(*std::max_element(colours[k].begin(), colours[k].end()));
      found.push_back(double(samples.out[c][k]) / brightest);
      truth.push_back(double(colours[k][c]) / brightest);
    }
  return absolute_error(found, truth);
}

std::string size_text(double bytes) {
  return bytes < 1 << 20 ? fmt::format("{:.0f} KB", bytes / 1024) : fmt::format("{:.0f} MB", bytes / (1 << 20));
}

struct Case {
  Named<SamplingFormat> format;
  Named<SamplingLayout> layout;
  Named<SamplingFilter> filter;
  bool cube;
  int size;
  Pattern pattern;
};

Point measure(Session& session, const Case& c, const Error& error) {
  const SamplingTexture texture = texture_of(c.format.value, c.layout.value, c.cube, c.size);
  Point point = describe(c.format.text(), "");
  const char* pattern = c.cube || c.pattern == Pattern::scattered ? "scattered" : "turned";
  point.id = fmt::format("sampling-{}-{}-{}-{}-{}-{}", c.cube ? "cube" : "2d", c.format.id, c.layout.id, c.filter.id,
                         c.size, pattern);
  session.progress(point.id);
  point.title = fmt::format("{}, {}, {}, {}, {}", c.format.text().title, c.layout.text().title, c.filter.text().title,
                            size_text(double(texture.bytes)), pattern);
  point.formula = fmt::format("{} of {} x {}{}, {} samples", c.cube ? "cube" : "texture", c.size, c.size,
                              c.cube ? " x 6" : "", pattern);
  for (const std::string& paper : {c.layout.text().paper, c.filter.text().paper})
    if (!paper.empty()) point.paper += "; " + paper;
  point.method = error;
  point.extra["bytes"] = double(texture.bytes);
  add_sampler_counts(session, point, c.format.value, c.layout.value, c.filter.value, c.cube);
  point.cost = time_sampling(session, texture, c.format.value, c.layout.value, c.filter.value, c.cube, c.pattern);
  return point;
}

Plot plot_of(std::string id, std::string title, std::string domain) {
  Plot plot;
  plot.id = std::move(id);
  plot.title = std::move(title);
  plot.error_name = "largest error of a channel, as a part of the brightest";
  plot.domain = std::move(domain);
  plot.truth = "the colour before it was stored";
  return plot;
}

}  // namespace

Family measure_sampling(Session& session) {
  std::array<Error, 4> errors;
  for (std::size_t k = 0; k < 4; ++k) errors[k] = format_error(session, formats[k].value);
  // The level-1 cache, level 2, level 3; and memory, where there is time for it.
  const std::vector<int> sizes = session.quick ? std::vector{32, 1024} : std::vector{32, 256, 1024, 4096};

  Plot flat = plot_of("sampling-formats", "2D textures: formats and filters", "rows; in the first-level cache");
  Plot cubes = plot_of("sampling-cubes", "Cubemaps: formats and filters", "directions all over the sphere");
  Plot memory = plot_of("sampling-memory", "Formats by working set", "bilinear, rows; samples scattered all over");
  Plot order = plot_of("sampling-layouts", "Layouts by working set", "bilinear, RGBA16F");
  for (std::size_t k = 0; k < 4; ++k) {
    for (const auto& filter : filters)
      flat.points.push_back(
          measure(session, {formats[k], layouts[0], filter, false, 32, Pattern::scattered}, errors[k]));
    for (const auto& layout : {layouts[0], layouts[3]})
      for (const auto& filter : filters)
        if (!session.quick || layout.value == SamplingLayout::linear)
          cubes.points.push_back(
              measure(session, {formats[k], layout, filter, true, 128, Pattern::scattered}, errors[k]));
    for (const int size : sizes)
      memory.points.push_back(
          measure(session, {formats[k], layouts[0], filters[1], false, size, Pattern::scattered}, errors[k]));
  }
  for (const auto& layout : layouts)
    for (const int size : sizes)
      for (const Pattern pattern : {Pattern::turned, Pattern::scattered})
        order.points.push_back(measure(session, {formats[1], layout, filters[1], false, size, pattern}, errors[1]));

  Family family;
  family.id = "sampling";
  family.title = "Texture and cubemap sampling";
  family.about =
      "One filtered colour from a texture or a cubemap, by texel format, by the order of texels in memory and by "
      "filter. "
      "Scattered samples lie anywhere; turned ones follow squares of pixels at 60 degrees to the texture's rows. Costs "
      "are given by working set: the bytes of the whole texture with its mips. Errors are the format's: radiances from "
      "2^-6 to 2^12.";
  const std::string isa = session.kernels.back()->isa;
  const auto ns = [&](const Plot& plot, std::size_t k) { return plot.points[k].cost.at(isa).ns; };
  // Of four points, one per format.
  const auto cheapest = [&](const Plot& plot, const std::array<std::size_t, 4>& points) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < 4; ++k)
      if (ns(plot, points[k]) < ns(plot, points[best])) best = k;
    return formats[best].text().title;
  };
  const std::size_t step = sizes.size(), last = step - 1, row = 2 * step;
  family.findings = {
      fmt::format(
          "In the first-level cache a bilinear sample on {} takes {:.1f} ns of RGBA32F, {:.1f} of RGBA16F, {:.1f} "
          "of RGB9E5 and {:.1f} of R11G11B10F; cheapest is {}.",
          isa, ns(flat, 1), ns(flat, 4), ns(flat, 7), ns(flat, 10), cheapest(flat, {1, 4, 7, 10})),
      fmt::format(
          "Scattered over a texture of {} x {}, it takes {:.1f} ns of RGBA32F ({}), {:.1f} of RGBA16F, {:.1f} of "
          "RGB9E5 and {:.1f} of R11G11B10F ({}); cheapest is {}.",
          sizes.back(), sizes.back(), ns(memory, last), size_text(memory.points[last].extra.at("bytes")),
          ns(memory, step + last), ns(memory, 2 * step + last), ns(memory, 3 * step + last),
          size_text(memory.points[3 * step + last].extra.at("bytes")),
          cheapest(memory, {last, step + last, 2 * step + last, 3 * step + last})),
      fmt::format("RGBA16F loses up to {} of the brightest channel, RGB9E5 {}, R11G11B10F {}.", number(errors[1].max),
                  number(errors[2].max), number(errors[3].max)),
      fmt::format(
          "Layouts, bilinear over {}: turned samples take {:.1f} ns in rows, {:.1f} in 4 x 4 tiles, {:.1f} in 8 x 8 "
          "tiles, {:.1f} in Morton order; scattered ones {:.1f}, {:.1f}, {:.1f} and {:.1f} ns.",
          size_text(order.points[2 * last].extra.at("bytes")), ns(order, 2 * last), ns(order, row + 2 * last),
          ns(order, 2 * row + 2 * last), ns(order, 3 * row + 2 * last), ns(order, 2 * last + 1),
          ns(order, row + 2 * last + 1), ns(order, 2 * row + 2 * last + 1), ns(order, 3 * row + 2 * last + 1)),
  };
  family.plots = {flat, cubes, memory, order};
  return family;
}

}  // namespace tessera::chart

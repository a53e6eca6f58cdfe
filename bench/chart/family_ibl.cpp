// Image-based lighting: how the specular lobe is looked up.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.hpp"
#include "bench/chart/ibl_world.hpp"
#include "bench/chart/measure.hpp"
#include "precompute/dfg.hpp"
#include "reference/albedo.hpp"

namespace tessera::chart {
namespace {

using reference::Vec3;

struct LobeMethod {
  EnvironmentShading shading;
  const char* id;  // among catalogue::lookups()
};
constexpr std::array<LobeMethod, 6> methods = {{
    {{}, "ibl-mirror"},
    {{EnvironmentLobe::shifted}, "ibl-shifted"},
    {{EnvironmentLobe::taps2}, "ibl-taps2"},
    {{EnvironmentLobe::taps4}, "ibl-taps4"},
    {{EnvironmentLobe::points8}, "ibl-fis8"},
    {{EnvironmentLobe::taps4, EnvironmentFresnel::f0, false}, "ibl-taps4-f0"},
}};

// Pixels of a G-buffer, and what the kernels make of them.
class Pixels {
 public:
  explicit Pixels(std::size_t count)
      : stride_((count + max_lanes - 1) / max_lanes * max_lanes), count_(count), values_(stride_ * 21, 0.0f) {}

  void set(std::size_t i, const Vec3& n, double base, double metallic, double roughness) {
    const double values[] = {n.x, n.y, n.z, base, base, base, metallic, roughness, 1};
    for (std::size_t k = 0; k < 9; ++k) plane(3 + k)[i] = float(values[k]);
  }
  [[nodiscard]] ShadeArgs args(const EnvironmentView& environment, const DfgView& dfg,
                               const EnvironmentShading& shading) {
    ShadeArgs a{};
    float** const pointers = reinterpret_cast<float**>(&a.gbuffer);
    for (std::size_t k = 0; k < gbuffer_planes; ++k) pointers[k] = plane(k);
    a.count = std::uint32_t(count_);
    a.features = feature_environment;
    a.eye[2] = 1;  // orthographic: v = +Z
    a.environment = environment;
    a.dfg = dfg;
    for (std::size_t c = 0; c < 3; ++c) a.radiance[c] = plane(gbuffer_planes + c);
    a.environment_shading = shading;
    return a;
  }
  [[nodiscard]] double radiance(std::size_t i) { return double(plane(gbuffer_planes + 1)[i]); }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  float* plane(std::size_t k) { return values_.data() + k * stride_; }
  std::size_t stride_, count_;
  AlignedVector<float> values_;
};
static_assert(sizeof(GBufferView) == gbuffer_planes * sizeof(float*));

// White metal over roughness and angle, turned to several sides.
struct LobeGrid {
  std::vector<double> roughness, cosines;
  int sides;
  Pixels pixels;
  std::vector<double> truth;

  LobeGrid(const World& world, bool quick)
      : roughness(spread(0.1, 1, quick ? 7 : 10)),
        cosines({0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.65, 0.8, 0.95}),
        sides(quick ? 6 : 16),
        pixels(roughness.size() * cosines.size() * std::size_t(sides)),
        truth(pixels.count()) {
    parallel_for(truth.size(), [&](std::size_t i) {
      const double r = roughness[i / std::size_t(sides) / cosines.size()];
      const double mu = cosines[i / std::size_t(sides) % cosines.size()], phi = 0.4 + 2.399963 * double(i % 97);
      const Vec3 n{std::sqrt(1 - mu * mu) * std::cos(phi), std::sqrt(1 - mu * mu) * std::sin(phi), mu};
      pixels.set(i, n, 1, 1, r);
      const double lost = 1 - reference::directional_albedo(mu, r * r, 32).E();
      truth[i] = world.reflected(n, {0, 0, 1}, r * r) +
                 lost * std::max(irradiance(world.environment.data().sh, 1, n.x, n.y, n.z), 0.0);
    });
  }
};

// Errors at grazing angles, where the round lobe is furthest from the true one.
class Grazing {
 public:
  void add(double r, double mu, double error) {
    if (!(mu < 0.45 && r > 0.15 && r < 0.65)) return;
    sum_ += error;
    largest_ = std::max(largest_, error);
    ++count_;
  }
  void put_into(Point& point) const {
    point.extra["grazing mean"] = sum_ / count_;
    point.extra["grazing largest"] = largest_;
  }

 private:
  double sum_ = 0, largest_ = 0, count_ = 0;
};

Plot lobes_in(Session& session, const World& world, const DfgView& dfg,
              std::array<std::map<std::string, Cost>, 6>& costs) {
  Plot plot;
  plot.id = "ibl-lobe-" + world.id;
  plot.title = "The lobe's shape, in " + world.title;
  plot.error_name = "mean error, of the mean radiance";
  plot.domain = "white metal, r 0.1 to 1, n.v 0.05 to 0.95";
  plot.truth = "the lobe's integral over the environment";
  plot.measure = Measure::mean;
  LobeGrid grid(world, session.quick);
  EnvironmentView environment = world.environment.view();
  environment.irradiance = {};  // harmonics, as in the truth
  for (std::size_t m = 0; m < 5; ++m) {
    const LobeMethod& method = methods[m];
    Point point = describe(catalogue::lookup_of(method.id), world.id);
    session.progress(plot.id + ": " + point.title);
    const ShadeArgs args = grid.pixels.args(environment, dfg, method.shading);
    if (costs[m].empty())
      for (const Kernels* kernels : session.kernels)
        costs[m][kernels->isa] = session.time(args.count, [&] { kernels->shade(args); });
    point.cost = costs[m];
    session.kernels.back()->shade(args);
    std::vector<double> found, truth;
    Grazing grazing;
    ErrorMap map{"error, of the mean radiance", "NoV", "roughness", grid.cosines, grid.roughness, {}};
    for (std::size_t i = 0; i < grid.truth.size(); ++i) {
      found.push_back(grid.pixels.radiance(i) / world.mean);
      truth.push_back(grid.truth[i] / world.mean);
      const double error = std::abs(found[i] - truth[i]);
      const std::size_t cell = i / std::size_t(grid.sides);
      if (i % std::size_t(grid.sides) == 0) map.values.push_back(0);
      map.values.back() += error / grid.sides;
      grazing.add(grid.roughness[cell / grid.cosines.size()], grid.cosines[cell % grid.cosines.size()], error);
    }
    point.method = absolute_error(found, truth);
    point.maps.push_back(map);
    grazing.put_into(point);
    plot.points.push_back(point);
  }
  return plot;
}

// A grid of spheres: roughness across, white metal, coloured metal and plastic below each other; Monte Carlo of the
// whole BRDF as truth.
Plot spheres_in(Session& session, const World& world, const DfgView& dfg,
                const std::array<std::map<std::string, Cost>, 6>& costs) {
  Plot plot;
  plot.id = "ibl-spheres-" + world.id;
  plot.title = "Spheres, metals and plastic, in " + world.title;
  plot.error_name = "mean error, of the mean radiance";
  plot.domain = "r 0.1 to 1; metal of base colour 1 and 0.5, dielectric of 0.5";
  plot.truth = "Monte Carlo of BRDF times environment (tessera reference)";
  plot.measure = Measure::mean;
  const int side = session.quick ? 10 : 24, rounds = session.quick ? 192 : 1024;
  const std::vector<double> roughness = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0};
  struct Dot {
    Vec3 n;
    double base, metallic, roughness;
  };
  std::vector<Dot> dots;
  for (const auto& [base, metallic] : {std::pair{1.0, 1.0}, {0.5, 1.0}, {0.5, 0.0}})
    for (const double r : roughness)
      for (int k = 0; k < side * side; ++k) {
        const double x = (k % side + 0.5) * 2 / side - 1, y = (k / side + 0.5) * 2 / side - 1, z2 = 1 - x * x - y * y;
        if (z2 > 2.5e-3) dots.push_back({{x, y, std::sqrt(z2)}, base, metallic, r});
      }
  session.progress(plot.id + ": truth");
  const reference::EnergyTable table;
  Pixels pixels(dots.size());
  std::vector<double> truth(dots.size()), noise(dots.size());
  parallel_for(dots.size(), [&](std::size_t i) {
    reference::ShadeSurface s;
    s.normal = dots[i].n;
    s.base_color = {dots[i].base, dots[i].base, dots[i].base};
    s.metallic = dots[i].metallic;
    s.roughness = dots[i].roughness;
    pixels.set(i, s.normal, dots[i].base, s.metallic, s.roughness);
    auto e = integrate_environment(s, {0, 0, 1}, world.map, table, rounds, i);
    // Where a hundredth of the mean radiance is not reached yet: as many rounds as that takes, within reason.
    const double missing = e.error.y / (0.01 * world.mean);
    if (!session.quick && missing > 1)
      e = integrate_environment(s, {0, 0, 1}, world.map, table, int(rounds * std::min(missing * missing, 24.0)),
                                i + dots.size());
    truth[i] = e.mean.y / world.mean;
    noise[i] = e.error.y / world.mean;
  });
  double mean_noise = 0;
  for (const double e : noise) mean_noise += e / double(noise.size());
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const LobeMethod& method = methods[m];
    session.kernels.back()->shade(pixels.args(world.environment.view(), dfg, method.shading));
    Point point = describe(catalogue::lookup_of(method.id), "spheres-" + world.id);
    point.cost = m < 5 ? costs[m] : costs[3];
    std::vector<double> found;
    Grazing grazing;
    for (std::size_t i = 0; i < dots.size(); ++i) {
      found.push_back(pixels.radiance(i) / world.mean);
      grazing.add(dots[i].roughness, dots[i].n.z, std::abs(found[i] - truth[i]));
    }
    point.method = absolute_error(found, truth);
    grazing.put_into(point);
    point.extra["noise of the truth"] = mean_noise;
    plot.points.push_back(point);
  }
  return plot;
}

}  // namespace

Family measure_ibl(Session& session) {
  const Kernels& kernels = *session.kernels.back();
  const std::vector<World> worlds = make_worlds(session);
  const DfgTable dfg = build_warped_dfg_table(kernels);
  Family family;
  family.id = "ibl";
  family.title = "Image-based lighting";
  family.about =
      "Light from an environment, of which levels of increasing roughness hold convolutions with a round lobe (n = v = "
      "r). "
      "The true lobe is stretched at grazing angles: methods differ in how they make it of round ones. Costs are those "
      "of "
      "shading a pixel by the environment alone, all else included. Prefiltering: cost per texel of all levels, one "
      "thread.";
  std::array<std::map<std::string, Cost>, 6> costs;
  std::string lobes, spheres;
  for (const World& world : worlds) family.plots.push_back(lobes_in(session, world, dfg.view(), costs));
  const std::size_t first = family.plots.size();
  for (const World& world : worlds) family.plots.push_back(spheres_in(session, world, dfg.view(), costs));
  family.plots.push_back(prefilter_plot(session, worlds[0]));
  family.plots.push_back(level_plot(session, worlds[worlds.size() / 2]));
  family.plots.push_back(format_plot(session, worlds[0]));

  const std::string isa = kernels.isa;
  const auto grazed = [&](std::size_t plot, std::size_t method) {
    return family.plots[plot].points[method].extra.at("grazing mean");
  };
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    family.findings.push_back(fmt::format(
        "In {}, at grazing angles and r from 0.2 to 0.6, the mirror direction errs by {} of the mean radiance on "
        "average, "
        "the shifted one by {}, two taps {}, four taps {}, eight points {}; on spheres of metal and plastic {} and, "
        "with "
        "four taps, {} (with F0 in place of kS {}; the truth's own noise is {}).",
        worlds[w].title, number(grazed(w, 0)), number(grazed(w, 1)), number(grazed(w, 2)), number(grazed(w, 3)),
        number(grazed(w, 4)), number(grazed(first + w, 0)), number(grazed(first + w, 3)), number(grazed(first + w, 5)),
        number(family.plots[first + w].points[0].extra.at("noise of the truth"))));
  }
  const auto ns = [&](std::size_t method) { return costs[method].at(isa).ns; };
  family.findings.push_back(fmt::format(
      "A pixel costs {:.1f} ns on {} with one lookup along the mirror direction, {:.1f} along the shifted one, {:.1f} "
      "with two taps, {:.1f} with four, {:.1f} with eight points.",
      ns(0), isa, ns(1), ns(2), ns(3), ns(4)));
  const Plot& filter = family.plots[first + worlds.size()];
  const Point &sums = filter.points.front(), &points = filter.points.back();
  family.findings.push_back(fmt::format(
      "Prefiltering by sums over a tree errs by {} at {:.0f} ns a texel; {} by {} at {:.0f} ns.",
      number(sums.method.max), sums.cost.at(isa).ns, points.title, number(points.method.max), points.cost.at(isa).ns));
  const Plot& levels = family.plots[first + worlds.size() + 1];
  const auto between = [&](std::size_t k) { return number(levels.points[k].method.mean); };
  family.findings.push_back(fmt::format(
      "Between levels a lookup mixes two lobes: six levels err by {} on average over roughness with even steps of it, "
      "by {} with a curve of 0.5, by {} with r (2 - r); seven by {}, {} and {}.",
      between(3), between(4), between(5), between(6), between(7), between(8)));
  const std::vector<Point>& formats = family.plots[first + worlds.size() + 2].points;
  std::string counted;
  for (const Point& point : formats) {
    const auto gathers = point.extra.find("gathers " + isa);
    if (gathers == point.extra.end()) continue;
    counted += fmt::format("{}{} {:.0f} ({:.0f} loads a lookup, {:.1f} ns)", counted.empty() ? "" : ", ", point.title,
                           gathers->second, point.extra.at("loads a lookup"), point.cost.at(isa).ns);
  }
  if (!counted.empty())
    family.findings.push_back(
        fmt::format("Gathers that a trilinear lookup in a cube takes for a vector of lookups on {}, counted in the "
                    "generated code: {}.",
                    isa, counted));
  return family;
}

}  // namespace tessera::chart

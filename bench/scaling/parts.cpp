#include "bench/scaling/parts.hpp"

#include <list>
#include <memory>

#include "base/aligned.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "bench/peers/environment.hpp"
#include "bench/peers/scene.hpp"
#include "bench/scaling/sphere_mesh.hpp"
#include "bench/workload/full_frame.hpp"
#include "bench/workload/shade_blocks.hpp"
#include "precompute/dfg.hpp"

namespace tessera::scaling {
namespace {

using workload::BlockedGBuffer;
using workload::FullFrame;
using workload::LightSet;
using workload::Mesh;

struct Size {
  int width, height;
  const char* name;
};
constexpr Size sizes[] = {
    {1280, 720, "720p"}, {1920, 1080, "1080p"}, {2560, 1440, "1440p"}, {3840, 2160, "4K"}, {7680, 4320, "8K"}};

// What all parts shade by, and everything that cases refer to: it stays where it is.
class Bench {
 public:
  Bench(const Effort& effort, const Kernels& kernels)
      : effort_(effort),
        kernels_(kernels),
        painted_(peers::paint_environment(kernels)),
        surroundings_(std::move(painted_.reflections), painted_.irradiance, build_dfg_table(kernels), peers::eye),
        gbuffer_(peers::cast_gbuffer(workload::width, workload::height), workload::width, workload::height) {}

  const LightSet& lights(int count) {
    std::vector<float> records = peers::place_lights(count);
    for (std::size_t i = 3; i < records.size(); i += 8) records[i] = 60;  // all reach every pixel
    return lights_.emplace_back(records);
  }
  const Mesh& mesh(std::size_t triangles) { return meshes_.emplace_back(sphere_mesh(triangles)); }

  // Deferred shading of a G-buffer of that size.
  Case shading(double x, int threads, const Size& size, const LightSet& lights) {
    const BlockedGBuffer* gbuffer = &gbuffer_;
    if (size.width != gbuffer_.width()) gbuffer = &gbuffers_.emplace_back(gbuffer_, size.width, size.height);
    float* const film = film_of(size);
    return {x, threads, [this, gbuffer, film, &lights] {
              workload::shade_blocks(kernels_, *gbuffer, surroundings_, lights, film);
            }};
  }
  // A frame from triangles to pixels.
  Case frame(double x, int threads, const Size& size, const Mesh& mesh, const LightSet& lights) {
    FullFrame& frame =
        frames_.emplace_back(mesh, surroundings_, lights, sphere_view(size.width, size.height, kernels_));
    float* const film = film_of(size);
    return {x, threads, [this, &frame, film] { frame.render(kernels_, film); }};
  }
  void measure(Part& part) const {
    std::vector<Case*> cases;
    for (Series& series : part.series)
      for (Case& one : series.cases) cases.push_back(&one);
    measure_in_turns(cases, effort_.rounds, effort_.seconds);
  }
  [[nodiscard]] int threads() const { return effort_.threads; }

 private:
  float* film_of(const Size& size) {
    const std::size_t floats = std::size_t{4} * std::size_t(size.width) * std::size_t(size.height);
    if (film_floats_ < floats) film_ = &films_.emplace_back(floats);
    film_floats_ = std::max(film_floats_, floats);
    return film_->data();
  }

  const Effort effort_;
  const Kernels& kernels_;
  peers::PaintedEnvironment painted_;
  workload::Surroundings surroundings_;
  BlockedGBuffer gbuffer_;
  std::list<BlockedGBuffer> gbuffers_;
  std::list<LightSet> lights_;
  std::list<Mesh> meshes_;
  std::list<FullFrame> frames_;
  std::list<AlignedVector<float>> films_;
  AlignedVector<float>* film_ = nullptr;
  std::size_t film_floats_ = 0;
};

constexpr Size full_hd = sizes[1];

Part threads_part(Bench& bench) {
  Part part{"threads", "Frames against threads", "threads", "1920 × 1080, 4 lights and an environment", {}};
  const LightSet& lights = bench.lights(4);
  const auto add = [&](const char* name, const auto& make) {
    Series series{name, {}};
    for (int threads = 1; threads <= bench.threads(); ++threads) series.cases.push_back(make(threads));
    part.series.push_back(std::move(series));
  };
  add("deferred shading (W1)", [&](int n) { return bench.shading(n, n, full_hd, lights); });
  const Mesh& small = bench.mesh(200'000);
  add("whole frame, 200 thousand triangles (W2)", [&](int n) { return bench.frame(n, n, full_hd, small, lights); });
  const Mesh& large = bench.mesh(2'000'000);
  add("whole frame, 2 million triangles (W2)", [&](int n) { return bench.frame(n, n, full_hd, large, lights); });
  return part;
}

Part pixels_part(Bench& bench) {
  Part part{"pixels",
            "Frames against pixels",
            "million pixels",
            "720p, 1080p, 1440p, 4K, 8K; 4 lights and an environment",
            {{"deferred shading (W1)", {}}, {"whole frame, 200 thousand triangles (W2)", {}}}};
  const LightSet& lights = bench.lights(4);
  const Mesh& mesh = bench.mesh(200'000);
  // The largest first: they share its film.
  for (std::size_t i = std::size(sizes); i-- > 0;) {
    const Size& size = sizes[i];
    const double x = 1e-6 * size.width * size.height;
    const auto add = [&](Series& series, Case one) {
      one.name = size.name;
      series.cases.insert(series.cases.begin(), std::move(one));
    };
    add(part.series[0], bench.shading(x, bench.threads(), size, lights));
    add(part.series[1], bench.frame(x, bench.threads(), size, mesh, lights));
  }
  return part;
}

Part triangles_part(Bench& bench) {
  Part part{"triangles",
            "Frames against triangles",
            "thousand triangles",
            "1920 × 1080, 4 lights and an environment; about half of the triangles face away",
            {{"whole frame", {}}}};
  const LightSet& lights = bench.lights(4);
  for (const std::size_t thousands : {10, 30, 100, 300, 1000, 2000, 4000, 8000})
    part.series[0].cases.push_back(
        bench.frame(double(thousands), bench.threads(), full_hd, bench.mesh(thousands * 1000), lights));
  return part;
}

Part lights_part(Bench& bench) {
  Part part{"lights",
            "Frames against lights per tile",
            "lights that reach every pixel",
            "1920 × 1080, deferred shading under an environment",
            {{"deferred shading", {}}}};
  for (const int count : {0, 1, 2, 4, 8, 16, 32, 64})
    part.series[0].cases.push_back(bench.shading(count, bench.threads(), full_hd, bench.lights(count)));
  return part;
}

struct Entry {
  const char* name;
  Part (*make)(Bench&);
};
constexpr Entry entries[] = {
    {"threads", threads_part}, {"pixels", pixels_part}, {"triangles", triangles_part}, {"lights", lights_part}};

}  // namespace

const std::vector<std::string>& part_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Entry& entry : entries) all.emplace_back(entry.name);
    return all;
  }();
  return names;
}

Part measure_part(const std::string& name, const Effort& effort, const Kernels& kernels) {
  for (const Entry& entry : entries) {
    if (name != entry.name) continue;
    std::unique_ptr<Bench> bench;
    Part part;
    run_with_threads(effort.threads, [&] {
      bench = std::make_unique<Bench>(effort, kernels);
      part = entry.make(*bench);
    });
    bench->measure(part);
    for (Series& series : part.series)
      for (Case& one : series.cases) one.frame = nullptr;  // they refer to what ends here
    return part;
  }
  throw usage_error("--part '{}': expected some of {}", name, fmt::join(part_names(), ", "));
}

}  // namespace tessera::scaling

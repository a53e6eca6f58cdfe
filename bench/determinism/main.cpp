// What the determinism contract costs in time: the renderer's kernels against the same sources compiled with free
// contraction, by turns in one run.
//   tessera_determinism --data FOLDER [--variant L1,L4,L16] [--isa avx2,avx512] [--rounds 40] [--threads 1]
//                       [--scene FILE.glb --env FILE.exr]
// FOLDER as tessera_peer_inputs makes it: deferred shading of 1920 x 1080 pixels. A scene is drawn as `tessera render`
// does: vertices, coverage, attributes, shading.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <sstream>
#include <tuple>

#include "base/aligned.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "bench/determinism/contracted.hpp"
#include "bench/determinism/pairs.hpp"
#include "bench/workload/inputs.hpp"
#include "bench/workload/shade_blocks.hpp"
#include "frame/dispatch.hpp"
#include "frame/frame.hpp"
#include "io/gltf.hpp"
#include "io/image_file.hpp"
#include "precompute/environment.hpp"

namespace tessera::determinism {
namespace {

using Options = std::map<std::string, std::string>;

Options parse(int argc, char** argv) {
  Options options = {{"--data", ""},     {"--variant", "L1,L4,L16"}, {"--isa", ""},
                     {"--rounds", "40"}, {"--threads", "1"},         {"--scene", ""},
                     {"--env", ""}};
  for (int i = 1; i < argc; i += 2) {
    if (options.count(argv[i]) == 0 || i + 1 == argc) throw usage_error("'{}': unknown, or without a value", argv[i]);
    options[argv[i]] = argv[i + 1];
  }
  if (options["--data"].empty() && options["--scene"].empty()) throw usage_error("give --data FOLDER or --scene FILE");
  return options;
}

std::vector<std::string> parts(const std::string& text) {
  std::vector<std::string> list;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) list.push_back(part);
  return list;
}

std::string words(const Spread& s) { return fmt::format("{:.4f} ({:.4f} to {:.4f})", s.median, s.low, s.high); }

// The share of values whose bits differ: proof that the two builds are two.
double share_that_differs(const float* a, const float* b, std::size_t count) {
  std::size_t differ = 0;
  for (std::size_t i = 0; i < count; ++i) differ += a[i] != b[i];
  return double(differ) / double(count);
}

void tell(const Kernels& kernels, const std::string& what, const Comparison& c, double differing) {
  fmt::print("{:<7} {:<10} {:8.2f} {:8.2f}   {}   {}   {:4.1f} %\n", kernels.isa, what, c.first_ms, c.second_ms,
             words(c.ratio), words(c.control), 100 * differing);
  std::fflush(stdout);
}

void compare_deferred(const Options& options, const Kernels& kernels, int rounds) {
  using namespace workload;
  const std::string& folder = options.at("--data");
  const Kernels other = contracted(kernels);
  const Surroundings surroundings(folder, kernels);
  const BlockedGBuffer gbuffer(folder);
  constexpr std::size_t floats = std::size_t{4} * width * height;
  AlignedVector<float> films[2] = {AlignedVector<float>(floats), AlignedVector<float>(floats)};
  for (const std::string& variant : parts(options.at("--variant"))) {
    const LightSet lights(folder, variant);
    const Comparison c = compare([&] { shade_blocks(kernels, gbuffer, surroundings, lights, films[0].data()); },
                                 [&] { shade_blocks(other, gbuffer, surroundings, lights, films[1].data()); }, rounds);
    tell(kernels, "shade " + variant, c, share_that_differs(films[0].data(), films[1].data(), floats));
  }
}

void compare_scene(const Options& options, const Kernels& kernels, int rounds) {
  const Kernels other = contracted(kernels);
  const Scene scene = load_gltf(options.at("--scene"));
  std::unique_ptr<Environment> environment;
  if (!options.at("--env").empty())
    environment = std::make_unique<Environment>(build_environment(read_image(options.at("--env")), {}, kernels));
  RenderSettings settings;
  settings.threads = std::stoi(options.at("--threads"));
  settings.hash = false;
  const View view =
      make_view(orbit_camera(bounds_of(scene), 0.6, 0.35, 0, 0.7, double(settings.width) / settings.height, kernels),
                settings.width, settings.height, kernels);
  Renderer first(scene, environment.get(), kernels), second(scene, environment.get(), other);
  Frame frames[2];
  const Comparison c = compare([&] { first.render(view, settings, {}, frames[0]); },
                               [&] { second.render(view, settings, {}, frames[1]); }, rounds);
  const auto& [a, b] = std::tie(frames[0].rgba.pixels, frames[1].rgba.pixels);
  tell(kernels, "frame", c, share_that_differs(a.data(), b.data(), a.size()));
}

void run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const int rounds = std::max(std::stoi(options.at("--rounds")), 4);
  fmt::print(
      "isa     what        as is ms  contracted   ratio (middle half)   the same against itself   values that "
      "differ\n");
  for (const Kernels* kernels : built_kernels()) {
    const std::vector<std::string> chosen = parts(options.at("--isa"));
    const bool wanted = chosen.empty() || std::find(chosen.begin(), chosen.end(), kernels->isa) != chosen.end();
    if (!wanted || !cpu_runs(*kernels) || !can_contract(*kernels)) continue;
    run_with_threads(std::stoi(options.at("--threads")), [&] {
      if (!options.at("--data").empty()) compare_deferred(options, *kernels, rounds);
      if (!options.at("--scene").empty()) compare_scene(options, *kernels, rounds);
    });
  }
}

}  // namespace
}  // namespace tessera::determinism

int main(int argc, char** argv) {
  try {
    tessera::determinism::run(argc, argv);
    return 0;
  } catch (const tessera::Error& error) {
    fmt::print(stderr, "tessera_determinism: error: {}\n", error.what());
    return static_cast<int>(error.status());
  } catch (const std::exception& error) {
    fmt::print(stderr, "tessera_determinism: error: {}\n", error.what());
    return 2;
  }
}

// The whole frame, 1920 x 1080, on one and two threads: Debian's assimp-testmodels engine (or the glTF file that
// TESSERA_BENCH_SCENE names) under blender-data's courtyard (TESSERA_BENCH_ENV).
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "frame/dispatch.hpp"
#include "frame/frame.hpp"
#include "io/gltf.hpp"
#include "io/image_file.hpp"
#include "precompute/environment.hpp"

namespace tessera {
namespace {

std::string path_of(const char* variable, const char* standard) {
  const char* given = std::getenv(variable);
  return given != nullptr ? given : standard;
}

struct Subject {
  Scene scene;
  std::unique_ptr<Environment> environment;
};

// Loaded once; null if the files are not there.
const Subject* subject() {
  static const std::unique_ptr<Subject> loaded = []() -> std::unique_ptr<Subject> {
    const std::string scene = path_of("TESSERA_BENCH_SCENE",
                                      "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb");
    const std::string environment =
        path_of("TESSERA_BENCH_ENV", "/usr/share/blender/datafiles/studiolights/world/courtyard.exr");
    if (!std::filesystem::exists(scene) || !std::filesystem::exists(environment)) return nullptr;
    auto s = std::make_unique<Subject>();
    s->scene = load_gltf(scene);
    s->environment = std::make_unique<Environment>(build_environment(read_image(environment), {}, select_kernels()));
    return s;
  }();
  return loaded.get();
}

// Arguments: index of the instruction set, threads, samples.
void frame(benchmark::State& state) {
  const Kernels& kernels = *built_kernels()[state.range(0)];
  const Subject* s = subject();
  if (s == nullptr || !cpu_runs(kernels)) {
    state.SkipWithError(s == nullptr ? "no scene: install assimp-testmodels and blender-data"
                                     : "this CPU lacks the instruction set");
    return;
  }
  RenderSettings settings;
  settings.threads = static_cast<int>(state.range(1));
  settings.samples = static_cast<int>(state.range(2));
  Renderer renderer(s->scene, s->environment.get(), kernels);
  const double aspect = static_cast<double>(settings.width) / settings.height;
  const View view = make_view(orbit_camera(bounds_of(s->scene), 0.6, 0.35, 0, 0.7, aspect, kernels), settings.width,
                              settings.height, kernels);
  Frame picture;
  renderer.render(view, settings, {}, picture);
  for (auto _ : state) renderer.render(view, settings, {}, picture);
  const FrameStatistics& f = picture.statistics;
  state.SetLabel(kernels.isa);
  state.counters["geometry_ms"] = f.geometry_ms;
  state.counters["tiles_ms"] = f.tiles_ms;
  state.counters["fragments"] = static_cast<double>(f.fragments);
  for (std::size_t k = 0; k < stage_names.size(); ++k) state.counters[stage_names[k]] = f.stage_ms[k];
}

void arguments(benchmark::internal::Benchmark* b) {
  for (std::size_t isa = 0; isa < built_kernels().size(); ++isa)
    for (const int threads : {1, 2})
      for (const int samples : {1, 4}) b->Args({static_cast<long>(isa), threads, samples});
}
BENCHMARK(frame)
    ->Apply(arguments)
    ->ArgNames({"isa", "threads", "samples"})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace tessera

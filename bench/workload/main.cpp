// Runs the workloads that software GPU drivers are timed on, through the renderer's own kernels:
//   tessera_workload --workload w1 --data FOLDER --variant L1,L4,L256t [--threads 2] [--isa NAME] [--out PREFIX]
//                    [--seconds 6]
//   tessera_workload --workload w2 --mesh 200k|2m [--size 1920x1080] [--stages 1] ...   a full frame from triangles
//   tessera_workload --workload cold --mesh 200k --out FILE ...                         one frame, and out
// One JSON line per variant on standard output; the picture as raw RGBA float in PREFIX_VARIANT.f32 (w2:
// PREFIX_w2_MESH_VARIANT.f32). --stages prints to standard error where a frame's time went.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "base/aligned.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "bench/workload/full_frame.hpp"
#include "bench/workload/inputs.hpp"
#include "bench/workload/mesh.hpp"
#include "bench/workload/output_pixels.hpp"
#include "bench/workload/shade_blocks.hpp"
#include "bench/workload/timing.hpp"
#include "frame/dispatch.hpp"

namespace tessera::workload {
namespace {

std::map<std::string, std::string> parse(int argc, char** argv) {
  std::map<std::string, std::string> options = {
      {"--threads", "2"}, {"--seconds", "6"}, {"--variant", "L4"}, {"--workload", "w1"},    {"--data", "."},
      {"--out", ""},      {"--isa", ""},      {"--mesh", "200k"},  {"--size", "1920x1080"}, {"--stages", ""}};
  for (int i = 1; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
  return options;
}

using Options = std::map<std::string, std::string>;

void save(const std::string& path, const float* rgba, std::size_t pixels) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(rgba), std::streamsize(sizeof(float) * 4 * pixels));
  if (!file) throw output_error("{}: cannot be written", path);
}

void report(const Kernels& kernels, const char* workload, const std::string& variant, const char* pass,
            const Timing& timing, const std::string& path) {
  fmt::print(R"({{"impl":"tessera-{}","workload":"{}","variant":"{}","pass":"{}","median_ms":{:.3f},"min_ms":{:.3f},)"
             R"("p90_ms":{:.3f},"cpu_median_ms":{:.3f},"cpu_min_ms":{:.3f},"frames":{},"out":"{}"}})"
             "\n",
             kernels.isa, workload, variant, pass, timing.median, timing.min, timing.p90, timing.cpu_median,
             timing.cpu_min, timing.frames, path);
  std::fflush(stdout);
}

template <class Body>
void for_each_variant(const Options& options, const Body& body) {
  std::stringstream variants(options.at("--variant"));
  for (std::string variant; std::getline(variants, variant, ',');) body(variant);
}

void run_deferred(const Options& options, const Kernels& kernels) {
  const std::string folder = options.at("--data");
  const Surroundings surroundings(folder, kernels);
  const BlockedGBuffer gbuffer(folder);
  AlignedVector<float> film(std::size_t{4} * width * height);
  for_each_variant(options, [&](const std::string& variant) {
    const LightSet lights(folder, variant);
    Timing timing;
    run_with_threads(std::stoi(options.at("--threads")), [&] {
      timing = measure([&] { shade_blocks(kernels, gbuffer, surroundings, lights, film.data()); },
                       std::stod(options.at("--seconds")));
    });
    std::string path;
    if (!options.at("--out").empty())
      save(path = options.at("--out") + "_" + variant + ".f32", film.data(), std::size_t{width} * height);
    report(kernels, "w1", variant, "shade", timing, path);
  });
}

void tell_stages(const FrameStatistics& s) {
  fmt::print(stderr, "geometry {:.2f} ms, tiles {:.2f} ms; of all threads:", s.geometry_ms, s.tiles_ms);
  for (std::size_t k = 0; k < stage_names.size(); ++k) fmt::print(stderr, " {} {:.2f}", stage_names[k], s.stage_ms[k]);
  fmt::print(stderr, "\ntriangles: {} in, {} kept, {} binned; {} fragments; {} KiB of working memory\n", s.geometry.in,
             s.geometry.kept, s.binned, s.fragments, s.working_bytes / 1024);
}

void run_full_frame(const Options& options, const Kernels& kernels) {
  const std::string folder = options.at("--data"), mesh_name = options.at("--mesh"), size = options.at("--size");
  const int columns = std::stoi(size), rows = std::stoi(size.substr(size.find('x') + 1));
  run_with_threads(std::stoi(options.at("--threads")), [&] {
    const Surroundings surroundings(folder, kernels);
    const Mesh mesh(folder, mesh_name);
    const View view = read_view(folder, columns, rows);
    Image film(columns, rows, 4);
    for_each_variant(options, [&](const std::string& variant) {
      const LightSet lights(folder, variant);
      FullFrame frame(mesh, surroundings, lights, view);
      const Timing timing =
          measure([&] { frame.render(kernels, film.pixels.data()); }, std::stod(options.at("--seconds")));
      std::string path;
      if (!options.at("--out").empty())
        save(path = options.at("--out") + "_w2_" + mesh_name + "_" + variant + ".f32", film.pixels.data(),
             std::size_t(columns) * std::size_t(rows));
      report(kernels, "w2", mesh_name + "/" + variant, "total", timing, path);
      if (!options.at("--stages").empty()) tell_stages(frame.statistics());
    });
  });
}

// From nothing to a picture in a file, once.
void run_cold(const Options& options, const Kernels& kernels) {
  const std::string folder = options.at("--data");
  run_with_threads(std::stoi(options.at("--threads")), [&] {
    const Stopwatch watch;
    const Surroundings surroundings(folder, kernels);
    const double surroundings_ms = watch.ms();
    const Mesh mesh(folder, options.at("--mesh"));
    const LightSet lights(folder, options.at("--variant"));
    FullFrame frame(mesh, surroundings, lights, read_view(folder, width, height));
    const double loaded_ms = watch.ms();
    OutputPixels film(options.at("--out"), std::size_t{width} * height);
    const double film_ms = watch.ms();
    frame.render(kernels, film.rgba());
    const double rendered_ms = watch.ms();
    film.finish();
    if (!options.at("--stages").empty())
      fmt::print(stderr, "environment {:.2f} mesh {:.2f} film {:.2f} frame {:.2f} write {:.2f} ms\n", surroundings_ms,
                 loaded_ms - surroundings_ms, film_ms - loaded_ms, rendered_ms - film_ms, watch.ms() - rendered_ms);
  });
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const Kernels& kernels = select_kernels(options.at("--isa"));
  const std::string& workload = options.at("--workload");
  if (workload == "w1") {
    run_deferred(options, kernels);
  } else if (workload == "w2") {
    run_full_frame(options, kernels);
  } else if (workload == "cold") {
    run_cold(options, kernels);
  } else {
    throw usage_error("--workload '{}': expected w1, w2 or cold", workload);
  }
  return 0;
}

}  // namespace
}  // namespace tessera::workload

int main(int argc, char** argv) {
  try {
    return tessera::workload::run(argc, argv);
  } catch (const tessera::Error& error) {
    std::fprintf(stderr, "tessera_workload: error: %s\n", error.what());
    return static_cast<int>(error.status());
  }
}

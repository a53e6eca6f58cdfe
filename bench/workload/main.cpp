// Runs the workloads that software GPU drivers are timed on, through the renderer's own kernels:
//   tessera_workload --workload w1 --data FOLDER --variant L1,L4,L256t [--threads 2] [--isa NAME] [--out PREFIX]
//                    [--seconds 6]
// One JSON line per variant on standard output; the picture as raw RGBA float in PREFIX_VARIANT.f32.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "bench/workload/inputs.hpp"
#include "bench/workload/shade_blocks.hpp"
#include "bench/workload/timing.hpp"
#include "frame/dispatch.hpp"

namespace tessera::workload {
namespace {

std::map<std::string, std::string> parse(int argc, char** argv) {
  std::map<std::string, std::string> options = {{"--threads", "2"},   {"--seconds", "6"}, {"--variant", "L4"},
                                                {"--workload", "w1"}, {"--data", "."},    {"--out", ""},
                                                {"--isa", ""}};
  for (int i = 1; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
  return options;
}

void save(const std::string& path, const float* rgba) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(rgba), std::streamsize(sizeof(float)) * 4 * width * height);
  if (!file) throw output_error("{}: cannot be written", path);
}

int run(int argc, char** argv) {
  auto options = parse(argc, argv);
  const Kernels& kernels = select_kernels(options["--isa"]);
  const std::string folder = options["--data"];
  if (options["--workload"] != "w1") throw usage_error("--workload: only w1 is there");
  const Surroundings surroundings(folder, kernels);
  const BlockedGBuffer gbuffer(folder);
  const LargeBuffer film(std::size_t{4} * width * height);
  std::stringstream variants(options["--variant"]);
  for (std::string variant; std::getline(variants, variant, ',');) {
    const LightSet lights(folder, variant);
    Timing timing;
    run_with_threads(std::stoi(options["--threads"]), [&] {
      timing = measure([&] { shade_blocks(kernels, gbuffer, surroundings, lights, film.data()); },
                       std::stod(options["--seconds"]));
    });
    std::string path;
    if (!options["--out"].empty()) save(path = options["--out"] + "_" + variant + ".f32", film.data());
    fmt::print(
        R"({{"impl":"tessera-{}","workload":"w1","variant":"{}","pass":"shade","median_ms":{:.3f},"min_ms":{:.3f},)"
        R"("p90_ms":{:.3f},"cpu_median_ms":{:.3f},"cpu_min_ms":{:.3f},"frames":{},"out":"{}"}})"
        "\n",
        kernels.isa, variant, timing.median, timing.min, timing.p90, timing.cpu_median, timing.cpu_min, timing.frames,
        path);
    std::fflush(stdout);
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

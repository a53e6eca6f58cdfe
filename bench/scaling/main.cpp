// How the time of a frame grows with threads, pixels, triangles and lights:
//   tessera_scaling [--part threads,pixels,triangles,lights] [--threads 2] [--isa NAME] [--rounds 5] [--seconds 0.1]
//                   [--json FOLDER] [--charts FOLDER]
// Prints a table; writes FOLDER/scaling-PART.json and FOLDER/scaling-PART.svg. A round gives every case --seconds, and
// all cases of a part take turns. The scene is that of the comparison with Mesa (bench/peers/scene.hpp); nothing is
// read. 8K takes 5 GB of memory.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "base/error.hpp"
#include "bench/scaling/report.hpp"
#include "frame/dispatch.hpp"

namespace tessera::scaling {
namespace {

using Options = std::map<std::string, std::string>;

Options parse(int argc, char** argv) {
  Options options = {{"--part", fmt::format("{}", fmt::join(part_names(), ","))},
                     {"--threads", "2"},
                     {"--isa", ""},
                     {"--rounds", "5"},
                     {"--seconds", "0.1"},
                     {"--json", ""},
                     {"--charts", ""}};
  for (int i = 1; i < argc; i += 2) {
    const auto option = options.find(argv[i]);
    if (option == options.end() || i + 1 == argc) throw usage_error("{}: unknown, or without a value", argv[i]);
    option->second = argv[i + 1];
  }
  return options;
}

void write(const std::string& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
  if (!file) throw output_error("{}: cannot be written", path);
}

int number_of(const Options& options, const char* name) {
  const int value = std::atoi(options.at(name).c_str());
  if (value < 1) throw usage_error("{} '{}': expected a number from 1 on", name, options.at(name));
  return value;
}

void run(const Options& options) {
  const Kernels& kernels = select_kernels(options.at("--isa"));
  Effort effort;
  effort.threads = number_of(options, "--threads");
  effort.rounds = number_of(options, "--rounds");
  effort.seconds = std::atof(options.at("--seconds").c_str());
  std::stringstream names(options.at("--part"));
  for (std::string name; std::getline(names, name, ',');) {
    const Part part = measure_part(name, effort, kernels);
    std::fputs(table_of(part).c_str(), stdout);
    std::fflush(stdout);
    const std::string file = "/scaling-" + name;
    if (const std::string& folder = options.at("--json"); !folder.empty())
      write(folder + file + ".json", json_of(part, kernels.isa, effort.threads));
    const std::string chart = chart_of(part, kernels.isa, effort.threads);
    if (const std::string& folder = options.at("--charts"); !folder.empty() && !chart.empty())
      write(folder + file + ".svg", chart);
  }
}

}  // namespace
}  // namespace tessera::scaling

int main(int argc, char** argv) {
  try {
    tessera::scaling::run(tessera::scaling::parse(argc, argv));
    return 0;
  } catch (const tessera::Error& error) {
    std::fprintf(stderr, "tessera_scaling: error: %s\n", error.what());
    return static_cast<int>(error.status());
  }
}

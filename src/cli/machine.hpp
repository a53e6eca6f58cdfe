// How the work is done, which never shows in a pixel: the options that `render` and `shade` share.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "base/error.hpp"

namespace tessera::cli {

struct MachineOptions {
  int threads = 0;
  std::string isa, statistics, trace;
  bool profile = false, quiet = false;
};

/// What commands without a frame share: threads, instruction set, silence.
inline void add_running_options(CLI::App& command, MachineOptions& options) {
  const std::string group = "Running";
  command.add_option("--threads", options.threads, "Threads to use (0: all cores)")
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  command.add_option("--isa", options.isa, "Instruction set ('tessera isa' lists them; default: the widest)")
      ->type_name("NAME")
      ->group(group);
  command.add_flag("-q,--quiet", options.quiet, "Say nothing but errors")->group(group);
}

inline void add_machine_options(CLI::App& command, MachineOptions& options) {
  add_running_options(command, options);
  const std::string group = "Running";
  command.add_option("--stats", options.statistics, "Write times, counts, memory and the pixels' hash as JSON")
      ->type_name("FILE")
      ->group(group);
  command.add_flag("--profile", options.profile, "Print the cycles of each thread by stage")->group(group);
  command
      .add_option("--trace", options.trace,
                  "Write when each thread did what, tile by tile, for chrome://tracing or ui.perfetto.dev")
      ->type_name("FILE.json")
      ->group(group);
}

inline void validate(const MachineOptions& options) {
  if (options.threads < 0 || options.threads > 1024)
    throw usage_error("--threads {}: expected 0 (all cores) to 1024", options.threads);
}

}  // namespace tessera::cli

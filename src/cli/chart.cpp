// tessera chart: runs the program tessera-chart, which stands beside this one.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"
#include "cli/commands.hpp"

namespace tessera::cli {
namespace {

[[noreturn]] void run_chart(std::vector<std::string> arguments) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw usage_error("chart: where this program stands cannot be told: {}", error.message());
  const std::string sibling = self.parent_path() / "tessera-chart";
  if (!std::filesystem::exists(sibling, error))
    throw usage_error(
        "chart: the program {} is not there; build it with: cmake --build BUILD_FOLDER --target tessera_chart",
        sibling);
  arguments.insert(arguments.begin(), sibling);
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  ::execv(sibling.c_str(), pointers.data());
  throw usage_error("chart: {} cannot be run: {}", sibling, std::strerror(errno));
}

}  // namespace

void add_chart(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "chart", "Measures every shading method's cost and error on this machine, and writes a page that shows both");
  // Its options are the other program's, --help included.
  command->set_help_flag();
  command->prefix_command();
  command->callback([command] { run_chart(command->remaining()); });
}

}  // namespace tessera::cli

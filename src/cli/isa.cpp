// tessera isa: instruction sets built, those this CPU runs, the one chosen.
#include "base/error.hpp"
#include "cli/commands.hpp"
#include "cli/text.hpp"
#include "frame/dispatch.hpp"

namespace tessera::cli {
namespace {

void run_isa(const std::string& wish) {
  const Kernels& chosen = select_kernels(wish);
  std::string text;
  for (const Kernels* table : built_kernels())
    text += fmt::format("{:<8} {:>2} floats wide   {}{}\n", table->isa, table->lanes,
                        cpu_runs(*table) ? "runs here" : "not on this CPU", table == &chosen ? ", chosen" : "");
  print(text);
}

}  // namespace

void add_isa(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("isa", "Lists the instruction sets built, those this CPU runs, the chosen one");
  auto wish = std::make_shared<std::string>();
  command->add_option("--isa", *wish, "Choose one of them, as the other commands would")->type_name("NAME");
  command->footer(
      "The widest set that the CPU runs is chosen; --isa NAME or the environment variable TESSERA_ISA choose another.\n"
      "The pixels are the same with each.");
  command->callback([wish] { run_isa(*wish); });
}

}  // namespace tessera::cli

// tessera: the command line. Exit status: 0 fine, 2 usage, 3 input, 4 output (base/error.hpp).
#include <new>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/text.hpp"

namespace {

constexpr const char* footer = R"(Examples:
  tessera render scene.glb --env courtyard.exr -o out.png
  tessera render scene.glb --orbit 30,20 --light directional:-1,-2,-1:3 --background '#202830' -o out.png
  tessera render scene.glb --env courtyard.exr --aov id,depth,normal,albedo -o out.exr
  tessera tune scene.glb --env courtyard.exr --max-error 2 -o settings.json
  tessera info scene.glb
  tessera chart --quick

The same scene and options give the same pixels, bit for bit, on every CPU and for any number of threads.
'tessera COMMAND --help' tells about each command.

Exit status: 0 fine, 2 wrong usage, 3 an input cannot be read or is invalid, 4 an output cannot be written.)";

int complain(tessera::ExitStatus status, const std::string& message) {
  tessera::cli::note("error: " + message);
  return static_cast<int>(status);
}

int run(int argc, char** argv) {
  CLI::App program("Tessera renders glTF scenes with physically based shading on the CPU.", "tessera");
  program.footer(footer);
  program.set_version_flag("--version", std::string("tessera ") + TESSERA_VERSION);
  auto formatter = std::make_shared<tessera::cli::HelpFormatter>();
  formatter->column_width(34);
  program.formatter(formatter);      // its subcommands inherit it
  program.require_subcommand(0, 1);  // that there is one is checked below, with a better message
  tessera::cli::add_render(program);
  tessera::cli::add_shade(program);
  tessera::cli::add_bake(program);
  tessera::cli::add_reference(program);
  tessera::cli::add_tune(program);
  tessera::cli::add_info(program);
  tessera::cli::add_isa(program);
  tessera::cli::add_chart(program);
  tessera::cli::add_furnace(program);
  try {
    program.parse(argc, argv);
    if (program.get_subcommands().empty())
      throw tessera::usage_error(
          "a command is needed: render, shade, tune, bake, reference, info, isa, chart or furnace ('tessera --help')");
  } catch (const CLI::CallForHelp&) {
    // Help of the command that was being parsed, not of the whole program.
    const auto chosen = program.get_subcommands();
    tessera::cli::print(chosen.empty() ? tessera::cli::help_of(program, "")
                                       : tessera::cli::help_of(*chosen.front(), "tessera"));
  } catch (const CLI::CallForVersion& version) {
    tessera::cli::print(std::string(version.what()) + "\n");
  } catch (const CLI::ParseError& error) {
    return complain(tessera::ExitStatus::usage, error.what());
  }
  return static_cast<int>(tessera::ExitStatus::ok);
}

}  // namespace

int main(int argc, char** argv) {
  tessera::remove_guarded_files_on_signals();
  try {
    return run(argc, argv);
  } catch (const tessera::Error& error) {
    return complain(error.status(), error.what());
  } catch (const std::bad_alloc&) {
    return complain(tessera::ExitStatus::input, "not enough memory for this input and size");
  } catch (const std::exception& error) {
    return complain(tessera::ExitStatus::input, error.what());
  }
}

// The subcommands. Each adds itself to the program: its options, its help, and what it does when chosen.
#pragma once
#include <CLI/CLI.hpp>

namespace tessera::cli {

void add_render(CLI::App& program);
void add_shade(CLI::App& program);
void add_info(CLI::App& program);
void add_isa(CLI::App& program);
void add_furnace(CLI::App& program);
void add_tune(CLI::App& program);
void add_chart(CLI::App& program);
void add_bake(CLI::App& program);
void add_reference(CLI::App& program);

}  // namespace tessera::cli

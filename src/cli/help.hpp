// How --help looks.
#pragma once
#include <CLI/CLI.hpp>

namespace tessera::cli {

/// CLI11's layout, with descriptions wrapped and without remarks about which option excludes which.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
};

/// The help of a command ("tessera render"), or of the program if `parent` is empty.
std::string help_of(const CLI::App& command, const std::string& parent);

}  // namespace tessera::cli

// How a scene's textures are stored and filtered: the options that `render` and `tune` share.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "frame/settings.hpp"

namespace tessera::cli {

struct TextureOptions {
  std::string filter, colors;
};

void add_texture_options(CLI::App& command, TextureOptions& options);

/// Puts what the options say into settings; what they leave open stays. Throws Error(usage).
void apply_texture_options(const TextureOptions& options, RenderSettings& settings);

}  // namespace tessera::cli

#include "cli/texture_options.hpp"

#include "base/error.hpp"
#include "cli/parse.hpp"

namespace tessera::cli {

void add_texture_options(CLI::App& command, TextureOptions& options) {
  const std::string group = "Textures";
  command
      .add_option("--texture-filter", options.filter,
                  fmt::format("{} (default: file, as its samplers say)", fmt::join(texture_filter_names, ", ")))
      ->type_name("FILTER")
      ->group(group);
  command
      .add_option("--color-texels", options.colors,
                  "How sRGB pictures are stored: half, or 8bit in half the memory (default: half)")
      ->type_name("FORMAT")
      ->group(group);
}

void apply_texture_options(const TextureOptions& options, RenderSettings& settings) {
  choose_word(settings.texture_filter, texture_filter_names, "--texture-filter", options.filter);
  choose_word(settings.color_texels, color_texel_names, "--color-texels", options.colors);
}

}  // namespace tessera::cli

// What lights a scene besides the lights in its file: the options that `render` and `shade` share.
#pragma once
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "frame/settings.hpp"
#include "kernels/interface.hpp"
#include "precompute/environment.hpp"
#include "scene/light.hpp"

namespace tessera::cli {

struct LightingOptions {
  std::string environment, layout = "auto", lobe, fresnel;
  int specular_occlusion = 0;  // > 0: on, < 0: off (--specular-occlusion=false), 0: nothing said
  double rotation = 0;         // degrees
  double intensity = 1;        // factor
  std::vector<std::string> lights;
};

void add_lighting_options(CLI::App& command, LightingOptions& options);

/// The paragraph of a command's help that tells about orientation and units.
extern const char* const lighting_help;

/// How the options want the environment to be looked up; what they leave open is as in settings. Throws Error(usage).
EnvironmentShading parse_environment_shading(const LightingOptions& options, const RenderSettings& settings);

/// What an environment's report has to say to a person: negative texels only if asked for.
std::vector<std::string> environment_warnings(const std::string& name, const EnvironmentReport& report,
                                              bool negative_too);

/// A dominant light as the renderer knows lights.
Light directional_light(const DominantLight& light);

/// Those of --light.
std::vector<Light> parse_lights(const LightingOptions& options);

struct ChosenEnvironment {
  std::unique_ptr<Environment> environment;  // null: lights alone
  std::vector<std::string> warnings;
  std::vector<Light> lights;  // that were taken out of it when it was baked
  bool neutral = false;       // nobody asked for one, and nothing else would light the scene
};

/// has_lights: whether anything else lights the scene.
ChosenEnvironment make_environment(const LightingOptions& options, bool has_lights, const Kernels& kernels);

}  // namespace tessera::cli

// What lights a scene besides the lights in its file: the options that `render` and `shade` share.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame/settings.hpp"
#include "kernels/interface.hpp"
#include "precompute/environment.hpp"
#include "scene/light.hpp"

namespace tessera::cli {

struct LightingOptions {
  std::string environment, layout = "auto", lobe, fresnel, albedo, texels, irradiance;
  std::optional<int> size;
  std::optional<double> cutoff;  // lux
  int specular_occlusion = 0;    // > 0: on, < 0: off (--specular-occlusion=false), 0: nothing said
  double rotation = 0;           // degrees
  double intensity = 1;          // factor
  std::vector<std::string> lights;
};

void add_lighting_options(CLI::App& command, LightingOptions& options);

/// The paragraph of a command's help that tells about orientation and units.
extern const char* const lighting_help;

/// Puts what the options say into settings; what they leave open stays. Throws Error(usage).
void apply_lighting_options(const LightingOptions& options, RenderSettings& settings);

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
  /// The same with reflections of another size, and a cube of irradiance in any case. Null if the environment came
  /// baked, or nobody asked for it.
  std::function<std::unique_ptr<Environment>(int size)> bake;
};

/// has_lights: whether anything else lights the scene. settings: the environment's size and form of irradiance.
/// several: it will be baked again; the picture is kept.
ChosenEnvironment make_environment(const LightingOptions& options, const RenderSettings& settings, bool has_lights,
                                   const Kernels& kernels, bool several = false);

}  // namespace tessera::cli

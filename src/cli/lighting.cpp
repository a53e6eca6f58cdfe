#include "cli/lighting.hpp"

#include "base/error.hpp"
#include "cli/neutral_environment.hpp"
#include "cli/parse.hpp"
#include "io/image_file.hpp"

namespace tessera::cli {

const char* const lighting_help =
    R"(Environment maps are equirectangular, any format and size; their values are radiance. With --env-rotation 0, column u
(0 left, 1 right) and row v (0 top, 1 bottom) show the direction with u = 0.5 + atan2(z, x) / 2pi and v = acos(y) / pi: the
centre of the map is +X, as in three.js and Khronos' glTF viewer. OpenEXR's own definition of such maps is turned 90 degrees
against it. A positive rotation turns the environment counter-clockwise about +Y, seen from above.
Without --env the lights shine alone; without either, a neutral studio is put up.

Lights (--light, as often as needed; colours are linear, angles in degrees from the axis):
  point:x,y,z:candela[:r,g,b]                          E = I / d^2
  directional:dx,dy,dz:lux[:r,g,b]                     dx,dy,dz is where it shines to
  spot:x,y,z:dx,dy,dz:candela:inner,outer[:r,g,b]      full inside inner, none outside outer
A white diffuse surface that faces 1 lux has radiance 1/pi; an environment of radiance 1 gives it radiance 1.)";

void add_lighting_options(CLI::App& command, LightingOptions& options) {
  const std::string group = "Light";
  command.add_option("--env", options.environment, "Environment map: .exr, .hdr, .png ...")
      ->type_name("FILE")
      ->group(group);
  command.add_option("--env-rotation", options.rotation, "Turn the environment about +Y")
      ->type_name("DEGREES")
      ->capture_default_str()
      ->group(group);
  command.add_option("--env-intensity", options.intensity, "Multiply its radiance")
      ->type_name("FACTOR")
      ->capture_default_str()
      ->group(group);
  command.add_option("--light", options.lights, "Another light; may be repeated: see below")
      ->type_name("SPEC")
      ->allow_extra_args(false)
      ->group(group);
}

std::vector<Light> parse_lights(const LightingOptions& options) {
  std::vector<Light> lights;
  lights.reserve(options.lights.size());
  for (const std::string& text : options.lights) lights.push_back(parse_light(text));
  return lights;
}

ChosenEnvironment make_environment(const LightingOptions& options, bool has_lights, const Kernels& kernels) {
  if (!(options.intensity >= 0 && options.intensity <= 1e6))
    throw usage_error("--env-intensity {}: expected 0 to 1e6", options.intensity);
  if (!(options.rotation >= -36000 && options.rotation <= 36000))
    throw usage_error("--env-rotation {}: expected -36000 to 36000 degrees", options.rotation);
  ChosenEnvironment chosen;
  if (options.environment.empty() && has_lights) return chosen;
  chosen.neutral = options.environment.empty();
  const Image image = chosen.neutral ? neutral_environment() : read_image(options.environment);
  EnvironmentSettings settings;
  settings.rotation = static_cast<float>(options.rotation * radians_per_degree);
  settings.intensity = static_cast<float>(options.intensity);
  chosen.environment = std::make_unique<Environment>(build_environment(image, settings, kernels));
  // Slightly negative texels are ordinary ringing of a resize; they are taken as 0 and not worth a word.
  const EnvironmentReport& report = chosen.environment->report();
  if (report.non_finite != 0)
    chosen.warnings.push_back(
        fmt::format("{}: {} texels are infinite or not a number: taken as 0", options.environment, report.non_finite));
  if (report.clamped != 0)
    chosen.warnings.push_back(fmt::format("{}: {} texels of the cubemap are brighter than 65504: clamped to it",
                                          options.environment, report.clamped));
  return chosen;
}

}  // namespace tessera::cli

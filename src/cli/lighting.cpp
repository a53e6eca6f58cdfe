#include "cli/lighting.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "cli/neutral_environment.hpp"
#include "cli/parse.hpp"
#include "frame/environment_file.hpp"

namespace tessera::cli {

const char* const lighting_help =
    R"(Environment maps are equirectangular, any format and size; their values are radiance (pictures of 8 or 16 bits: sRGB,
decoded to it). With --env-rotation 0, column u
(0 left, 1 right) and row v (0 top, 1 bottom) show the direction with u = 0.5 + atan2(z, x) / 2pi and v = acos(y) / pi: the
centre of the map is +X, as in three.js and Khronos' glTF viewer. OpenEXR's own definition of such maps is turned 90 degrees
against it. A positive rotation turns the environment counter-clockwise about +Y, seen from above.
Faces of cubes are those of OpenGL and Vulkan: px nx py ny pz nz in a folder, a cross (4:3 or 3:4, +Z in the middle) or a
strip (+X -X +Y -Y +Z -Z). 'tessera bake' does the work once, into a .tsra.
Without --env the lights shine alone; without either, a neutral studio is put up.

Lights (--light, as often as needed; colours are linear, angles in degrees from the axis):
  point:x,y,z:candela[:r,g,b]                          E = I / d^2
  directional:dx,dy,dz:lux[:r,g,b]                     dx,dy,dz is where it shines to
  spot:x,y,z:dx,dy,dz:candela:inner,outer[:r,g,b]      full inside inner, none outside outer
--light-cutoff fades them towards there, as a glTF light's range does; directional lights have no end.
A white diffuse surface that faces 1 lux has radiance 1/pi; an environment of radiance 1 gives it radiance 1.)";

void add_lighting_options(CLI::App& command, LightingOptions& options) {
  const std::string group = "Light";
  command
      .add_option("--env", options.environment, "Environment: .exr .hdr .png .jpg, a folder of cube faces, or .tsra")
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
  command
      .add_option("--env-layout", options.layout, "auto, equirect, cross or strip (auto: by the picture's proportions)")
      ->type_name("LAYOUT")
      ->capture_default_str()
      ->group(group);
  command
      .add_option(
          "--env-lobe", options.lobe,
          fmt::format("How reflections are looked up: {} (default: {})", fmt::join(environment_lobe_names, ", "),
                      environment_lobe_names[std::size_t(RenderSettings{}.environment_shading.lobe)]))
      ->type_name("LOBE")
      ->group(group);
  command
      .add_option("--env-fresnel", options.fresnel,
                  fmt::format("Reflectance of the environment's single scattering: kS or f0 (default: {})",
                              environment_fresnel_names[std::size_t(RenderSettings{}.environment_shading.fresnel)]))
      ->type_name("FORM")
      ->group(group);
  command
      .add_flag("--specular-occlusion", options.specular_occlusion,
                "Occlude reflections by angle and roughness, not by the occlusion map alone (=false: not)")
      ->group(group);
  command
      .add_option("--env-albedo", options.albedo,
                  fmt::format("The environment BRDF: {} (default: table)", fmt::join(environment_albedo_names, ", ")))
      ->type_name("FORM")
      ->group(group);
  command
      .add_option("--env-size", options.size,
                  "Texels along a face of the sharpest reflections, a power of two (default: up to 256)")
      ->type_name("N")
      ->group(group);
  command
      .add_option("--env-texels", options.texels,
                  "How reflections are stored: half, or rgb9e5 in half the memory (default: half)")
      ->type_name("FORMAT")
      ->group(group);
  command
      .add_option("--env-irradiance", options.irradiance,
                  "Diffuse light from harmonics (sh), a cube, or auto: sh unless it would ring below 0 (default: auto)")
      ->type_name("FORM")
      ->group(group);
  command
      .add_option("--light-cutoff", options.cutoff,
                  "Let point and spot lights end where they fall to this illuminance (default: 0)")
      ->type_name("LUX")
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

ChosenEnvironment make_environment(const LightingOptions& options, const RenderSettings& settings, bool has_lights,
                                   const Kernels& kernels, bool several) {
  if (!(options.intensity >= 0 && options.intensity <= 1e6))
    throw usage_error("--env-intensity {}: expected 0 to 1e6", options.intensity);
  if (!(options.rotation >= -36000 && options.rotation <= 36000))
    throw usage_error("--env-rotation {}: expected -36000 to 36000 degrees", options.rotation);
  ChosenEnvironment chosen;
  if (options.environment.empty() && has_lights) return chosen;
  chosen.neutral = options.environment.empty();
  if (!chosen.neutral && is_baked_environment(options.environment)) {
    if (options.rotation != 0 || options.intensity != 1)
      throw usage_error("{}: a baked environment has its rotation and intensity: give them to 'tessera bake'",
                        options.environment);
    chosen.environment = std::make_unique<Environment>(read_environment(options.environment));
    const EnvironmentData& data = chosen.environment->data();
    if (settings.environment_size != 0 && settings.environment_size != data.specular.size())
      throw usage_error("{}: reflections of size {} are asked for, but it has {}: give the size to 'tessera bake'",
                        options.environment, settings.environment_size, data.specular.size());
    if (data.light) chosen.lights.push_back(directional_light(*data.light));
    return chosen;
  }
  EnvironmentSettings baking;
  baking.rotation = static_cast<float>(options.rotation * radians_per_degree);
  baking.intensity = static_cast<float>(options.intensity);
  baking.specular_size = settings.environment_size;
  baking.keep_cube = several || settings.environment_irradiance == IrradianceForm::cube;
  const auto picture = std::make_shared<const EnvironmentPicture>(
      chosen.neutral ? EnvironmentPicture{neutral_environment(), false}
                     : read_environment_picture({options.environment}, options.layout, kernels));
  chosen.environment = std::make_unique<Environment>(build_environment(*picture, baking, kernels));
  // Slightly negative texels are ordinary ringing of a resize; they are taken as 0 and not worth a word.
  chosen.warnings = environment_warnings(options.environment, chosen.environment->report(), false);
  if (!several) return chosen;
  chosen.bake = [picture, baking, &kernels](int size) {
    EnvironmentSettings other = baking;
    other.specular_size = size;
    return std::make_unique<Environment>(build_environment(*picture, other, kernels));
  };
  return chosen;
}

std::vector<std::string> environment_warnings(const std::string& name, const EnvironmentReport& report,
                                              bool negative_too) {
  std::vector<std::string> warnings;
  if (report.non_finite != 0)
    warnings.push_back(fmt::format("{}: {} texels are infinite or not a number: taken as 0", name, report.non_finite));
  if (report.negative != 0 && negative_too)
    warnings.push_back(fmt::format("{}: {} texels are negative: taken as 0", name, report.negative));
  if (report.clamped != 0)
    warnings.push_back(
        fmt::format("{}: {} texels of the cubemap are brighter than 65504: clamped to it", name, report.clamped));
  return warnings;
}

void apply_lighting_options(const LightingOptions& options, RenderSettings& settings) {
  EnvironmentShading& shading = settings.environment_shading;
  choose_word(shading.lobe, environment_lobe_names, "--env-lobe", options.lobe);
  choose_word(shading.fresnel, environment_fresnel_names, "--env-fresnel", options.fresnel);
  choose_word(shading.albedo, environment_albedo_names, "--env-albedo", options.albedo);
  choose_word(settings.environment_texels, environment_texel_names, "--env-texels", options.texels);
  choose_word(settings.environment_irradiance, irradiance_form_names, "--env-irradiance", options.irradiance);
  if (options.specular_occlusion != 0) shading.specular_occlusion = options.specular_occlusion > 0;
  if (options.size) {
    settings.environment_size = *options.size;
    if (*options.size < 1 || *options.size > max_cube_size || (*options.size & (*options.size - 1)) != 0)
      throw usage_error("--env-size {}: expected a power of two up to {}", *options.size, max_cube_size);
  }
  if (options.cutoff) {
    if (!(*options.cutoff >= 0 && *options.cutoff <= 1e6))
      throw usage_error("--light-cutoff {}: expected 0 to 1e6 lux", *options.cutoff);
    settings.light_cutoff = static_cast<float>(*options.cutoff);
  }
}

Light directional_light(const DominantLight& dominant) {
  Light light;
  light.name = "environment";
  light.type = LightType::directional;
  const float brightest = std::max({dominant.illuminance[0], dominant.illuminance[1], dominant.illuminance[2], 1e-30f});
  light.intensity = brightest;
  for (int c = 0; c < 3; ++c) {
    light.direction[c] = -dominant.direction[c];
    light.color[c] = dominant.illuminance[c] / brightest;
  }
  return light;
}

}  // namespace tessera::cli

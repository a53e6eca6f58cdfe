#include "frame/tables.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "frame/lights.hpp"

namespace tessera {
namespace {

// The table depends on nothing, not even on the instruction set that computes it: one for the whole process.
const DfgTable& shared_dfg_table(const Kernels& kernels) {
  static const DfgTable table = build_warped_dfg_table(kernels);
  return table;
}

bool reads_table(const RenderSettings& settings) {
  return settings.environment_shading.albedo == EnvironmentAlbedo::table;
}

std::size_t texels_of(const CubeView& cube) { return cube_texel_count(cube.size, cube.levels); }

}  // namespace

Lighting::Lighting(const std::vector<Light>& file_lights, const Environment* environment, const Kernels& kernels)
    : file_lights_(file_lights), environment_(environment), kernels_(kernels) {}

const Lighting::CompiledLights& Lighting::compiled(float cutoff) {
  for (const CompiledLights& c : lights_)
    if (c.cutoff == cutoff) return c;
  CompiledLights made{cutoff, compile_lights(file_lights_, kernels_, cutoff), {}};
  made.bounds = LightBounds(made.lights);
  return lights_.emplace_back(std::move(made));
}

LightingView Lighting::view(const RenderSettings& settings) {
  const CompiledLights& lights = compiled(settings.light_cutoff);
  LightingView view;
  view.lights = lights.lights;
  if (!lights.lights.empty()) view.features |= feature_lights;
  if (lights.bounds.worth_culling()) view.bounds = lights.bounds.view();
  if (environment_ == nullptr) return view;
  view.features |= feature_environment;
  view.environment = environment_->view();
  if (settings.environment_irradiance == IrradianceForm::harmonics) view.environment.irradiance = {};
  if (settings.environment_irradiance == IrradianceForm::cube) {
    if (environment_->data().irradiance.empty())
      throw usage_error("irradiance from a cube: this environment was built without one");
    view.environment.irradiance = environment_->data().irradiance.view();
  }
  if (settings.environment_texels == CubeFormat::rgb9_e5) {
    if (!packed_) packed_.emplace(environment_->data().specular, kernels_);
    view.environment.specular = packed_->view();
  }
  if (reads_table(settings)) view.dfg = shared_dfg_table(kernels_).view();
  return view;
}

std::size_t Lighting::table_bytes(const RenderSettings& settings) const {
  if (environment_ == nullptr) return 0;
  constexpr std::size_t texel_bytes = 4 * sizeof(std::uint16_t);
  const EnvironmentView view = environment_->view();
  const std::size_t specular = settings.environment_texels == CubeFormat::rgb9_e5 && packed_
                                   ? packed_->bytes()
                                   : texels_of(view.specular) * texel_bytes;
  const std::size_t dfg = reads_table(settings) ? shared_dfg_table(kernels_).nodes.size() * sizeof(std::int16_t) : 0;
  return specular + texels_of(view.background) * texel_bytes + dfg;
}

BackgroundSource Lighting::background(const RenderSettings& settings) const {
  BackgroundSource source;
  source.kind = settings.background;
  std::copy(std::begin(settings.background_color), std::end(settings.background_color), source.color);
  if (settings.background != Background::environment) return source;
  if (environment_ == nullptr) {
    source.kind = Background::color;  // nothing to see: the colour, black by default
    return source;
  }
  source.cube = environment_->view().background;
  source.lod = settings.background_blur * static_cast<float>(source.cube.levels - 1);
  return source;
}

}  // namespace tessera

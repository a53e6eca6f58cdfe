#include "frame/tables.hpp"

#include <algorithm>

#include "frame/lights.hpp"

namespace tessera {
namespace {

// The table depends on nothing, not even on the instruction set that computes it: one for the whole process.
const DfgTable& shared_dfg_table(const Kernels& kernels) {
  static const DfgTable table = build_warped_dfg_table(kernels);
  return table;
}

}  // namespace

Lighting::Lighting(const std::vector<Light>& file_lights, const Environment* env, const Kernels& kernels)
    : lights(compile_lights(file_lights, kernels)), bounds(lights), environment(env) {
  if (!lights.empty()) features |= feature_lights;
  if (environment != nullptr) {
    features |= feature_environment;
    dfg = &shared_dfg_table(kernels);
  }
}

LightingView Lighting::view() const {
  LightingView view;
  view.lights = lights;
  view.features = features;
  if (bounds.worth_culling()) view.bounds = bounds.view();
  if (environment == nullptr) return view;
  view.environment = environment->view();
  view.dfg = dfg->view();
  return view;
}

std::size_t Lighting::table_bytes() const {
  if (environment == nullptr) return 0;
  constexpr std::size_t texel_bytes = 4 * sizeof(std::uint16_t);
  const EnvironmentView view = environment->view();
  std::size_t texels = 0;
  for (const CubeView& cube : {view.specular, view.background}) texels += cube_level_offset(cube.size, cube.levels);
  return texels * texel_bytes + dfg->texels.size() * sizeof(float);
}

BackgroundSource Lighting::background(const RenderSettings& settings) const {
  BackgroundSource source;
  source.kind = settings.background;
  std::copy(std::begin(settings.background_color), std::end(settings.background_color), source.color);
  if (settings.background != Background::environment) return source;
  if (environment == nullptr) {
    source.kind = Background::color;  // nothing to see: the colour, black by default
    return source;
  }
  source.cube = environment->view().background;
  source.lod = settings.background_blur * static_cast<float>(source.cube.levels - 1);
  return source;
}

}  // namespace tessera

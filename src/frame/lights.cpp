#include "frame/lights.hpp"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

float cosine(const Kernels& kernels, float angle) {
  float out = 0;
  kernels.evaluate(MathFunction::cos, &angle, &angle, &out, 1);
  return out;
}

}  // namespace

std::vector<LightView> compile_lights(const std::vector<Light>& lights, const Kernels& kernels) {
  std::vector<LightView> views;
  for (const Light& light : lights) {
    LightView view{};
    view.type = light.type;
    view.falloff = Falloff::inverse_square;
    bool shines = false, finite = true;
    for (int k = 0; k < 3; ++k) {
      view.position[k] = light.position[k];
      view.direction[k] = light.direction[k];
      view.color[k] = light.color[k] * light.intensity;
      shines |= view.color[k] > 0;
      finite &= std::isfinite(view.color[k]) && std::isfinite(view.position[k]) && std::isfinite(view.direction[k]);
    }
    if (!shines || !finite) continue;
    view.inverse_range_squared = light.range > 0 ? 1 / (light.range * light.range) : 0;
    // KHR_lights_punctual, "Inner and Outer Cone Angles": 0.001 keeps the edge of a hard cone finite.
    const float inner = cosine(kernels, light.inner_cone_angle), outer = cosine(kernels, light.outer_cone_angle);
    view.spot_scale = 1 / std::max(0.001f, inner - outer);
    view.spot_offset = -outer * view.spot_scale;
    views.push_back(view);
  }
  return views;
}

}  // namespace tessera

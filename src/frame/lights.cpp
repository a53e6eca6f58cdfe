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

std::vector<LightView> compile_lights(const std::vector<Light>& lights, const Kernels& kernels, float cutoff) {
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
    if (cutoff > 0 && light.type != LightType::directional) {
      // E = I / d^2 = cutoff. A light too weak to reach it anywhere ends within 1e-18: no product of it overflows.
      const float strongest = std::max({view.color[0], view.color[1], view.color[2]});
      view.inverse_range_squared = std::max(view.inverse_range_squared, std::min(cutoff / strongest, 1e36f));
    }
    // KHR_lights_punctual, "Inner and Outer Cone Angles": 0.001 keeps the edge of a hard cone finite.
    const float inner = cosine(kernels, light.inner_cone_angle), outer = cosine(kernels, light.outer_cone_angle);
    view.spot_scale = 1 / std::max(0.001f, inner - outer);
    view.spot_offset = -outer * view.spot_scale;
    views.push_back(view);
  }
  return views;
}

LightBounds::LightBounds(const std::vector<LightView>& lights)
    : stride_((lights.size() + max_lanes - 1) / max_lanes * max_lanes),
      count_(static_cast<std::uint32_t>(lights.size())) {
  planes_.assign(4 * stride_, 0.0f);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i].type == LightType::directional) continue;  // a range of 0: everywhere
    for (std::size_t axis = 0; axis < 3; ++axis) planes_[axis * stride_ + i] = lights[i].position[axis];
    planes_[3 * stride_ + i] = lights[i].inverse_range_squared;
    limited_ |= lights[i].inverse_range_squared > 0;
  }
}

LightBoundsView LightBounds::view() const {
  const float* p = planes_.data();
  return {p, p + stride_, p + 2 * stride_, p + 3 * stride_, count_};
}

}  // namespace tessera

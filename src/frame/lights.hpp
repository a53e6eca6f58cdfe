// Lights as the kernels want them.
#pragma once
#include <vector>

#include "kernels/interface.hpp"
#include "scene/light.hpp"

namespace tessera {

/// Cone angles become KHR_lights_punctual's scale and offset; intensity is folded into the colour. Lights that give
/// nothing (zero or not finite intensity) are left out.
std::vector<LightView> compile_lights(const std::vector<Light>& lights, const Kernels& kernels);

}  // namespace tessera

// The brightest compact source of an environment, taken out of it as a directional light.
#pragma once
#include <optional>

#include "kernels/interface.hpp"
#include "precompute/environment_source.hpp"

namespace tessera {

struct DominantLight {
  float direction[3];    // towards it, unit
  float illuminance[3];  // of a surface that faces it, per channel: its radiance above the surroundings, times solid
                         // angle
  float angular_radius;  // radians: of a disc whose light is spread as widely
};

/// Finds the source: the texels around the brightest one, within ten degrees, that are brighter than a tenth of it. It
/// counts as one if it gives at least 1 % of all light and is at least 10 times as bright as the mean, and no wider
/// than 4 degrees from its centre. Its texels fall to the mean of the ring around them; what they lose is the light, so
/// that the two together have the energy of the picture. Nothing is changed if there is none. The picture: RGB, finite,
/// non-negative.
std::optional<DominantLight> extract_dominant_light(EnvironmentPicture& picture, const Kernels& kernels);

}  // namespace tessera

// Punctual lights (KHR_lights_punctual), in world space.
#pragma once
#include <string>

#include "kernels/interface.hpp"

namespace tessera {

struct Light {
  std::string name;
  LightType type = LightType::point;
  float position[3] = {0, 0, 0};
  float direction[3] = {0, 0, -1};                                     // in which it shines, unit
  float color[3] = {1, 1, 1};                                          // linear
  float intensity = 1;                                                 // lux (directional) or candela
  float range = 0;                                                     // metres; 0: unlimited
  float inner_cone_angle = 0, outer_cone_angle = 0.7853981633974483f;  // radians, from the axis
};

}  // namespace tessera

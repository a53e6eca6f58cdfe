// The painted sky of the peer comparison, made ready for shading.
#pragma once
#include "precompute/cube.hpp"
#include "precompute/irradiance.hpp"

namespace tessera::peers {

struct PaintedEnvironment {
  Cube reflections;  // 256 x 256, 9 levels; level k is for roughness k / 8
  IrradianceSh irradiance;
};
PaintedEnvironment paint_environment(const Kernels& kernels);

}  // namespace tessera::peers

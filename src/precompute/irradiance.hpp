// Irradiance as nine spherical-harmonic coefficients.
#pragma once
#include "kernels/interface.hpp"

namespace tessera {

/// EnvironmentView::irradiance_sh.
struct IrradianceSh {
  float coefficients[9][3] = {};
};

/// Of the picture taken as constant over each of its texels: every solid angle and every integral of a basis function
/// over a texel is exact. rotation: radians about +Y, as EnvironmentSettings::rotation. Works in double, rows apart and
/// then in order: the same for any number of threads.
IrradianceSh project_irradiance(const EquirectView& source, float rotation, const Kernels& kernels);

}  // namespace tessera

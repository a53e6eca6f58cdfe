// Irradiance as nine spherical-harmonic coefficients.
#pragma once
#include <cstddef>

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

/// The same of six faces, each size x size RGB, in the order of CubeView, one below the other.
IrradianceSh project_irradiance(const CubeFacesView& source, float rotation, const Kernels& kernels);

/// Damps the bands against ringing: band l by 1 / (1 + lambda l^2 (l + 1)^2). Sloan 2008, "Stupid spherical harmonics
/// tricks", windowing by the squared Laplacian. lambda = 0 changes nothing.
IrradianceSh windowed(const IrradianceSh& sh, float lambda);

/// The coefficients of the radiance itself, L_lm with real orthonormal Y_lm over the world's x, y, z, in the order (l,
/// m) = (0, 0), (1, -1), (1, 0), (1, 1), (2, -2) ... (2, 2); Y_1-1 ~ y, Y_10 ~ z, Y_11 ~ x.
IrradianceSh radiance_harmonics(const IrradianceSh& sh);

/// E / pi of a channel for the unit normal (x, y, z); negative where the series rings below zero.
double irradiance(const IrradianceSh& sh, std::size_t channel, double x, double y, double z);

/// The least value over the sphere, as a part of the mean: negative where a bright sun makes the series ring. The
/// smallest of the three channels'.
double least_irradiance(const IrradianceSh& sh);

}  // namespace tessera

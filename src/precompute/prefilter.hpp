// Radiance prefiltered for rough reflections.
#pragma once
#include "precompute/cube.hpp"

namespace tessera {

/// EnvironmentView::lod_curve of what prefiltered() makes. Between levels a lookup mixes two lobes; against the exact
/// convolution over r from 0.06 to 1 and three environments, seven levels err by 3.9 % on average with even steps of
/// roughness, by 2.7 % with this curve and by 3.5 % with a curve of 1 (r (2 - r)); at worst by 19, 10 and 7 %.
inline constexpr float prefilter_curve = 0.5f;

/// Roughness of a level of `levels`: what a lookup by EnvironmentView::lod_curve finds there.
float roughness_of_level(int level, int levels, float curve = prefilter_curve);

/// EnvironmentView::specular: level 0 is the radiance itself, level k its convolution with the GGX lobe of
/// roughness_of_level(k, levels), n = v = r, at half the size of level k - 1.
///
/// samples = 0: a sum over texels that are as fine as the lobe asks, the brightest ones one by one; against brute force
/// the RMS error of a level is at most 1e-3 of its RMS. samples > 0: filtered importance sampling with as many points
/// per texel (Krivanek and Colbert 2008), for comparison: with 512 of them 3e-4 to 2e-2, by environment.
Cube prefiltered(CubeLevel radiance, int levels, int samples, const Kernels& kernels, float curve = prefilter_curve);

/// E / pi: the lobe of roughness 1, which is the cosine, on faces of 32 x 32 texels; summed over all texels of the
/// radiance at that size.
Cube irradiance_cube(CubeLevel radiance, const Kernels& kernels);

}  // namespace tessera

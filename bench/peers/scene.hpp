// The scene of the peer comparison: spheres on a floor under a painted sky, ray cast into a G-buffer.
#pragma once
#include <cstdint>
#include <vector>

namespace tessera::peers {

inline constexpr float eye[4] = {0, 4, 5.5f, 1};

/// 12 planes of width x height, in the order of bench/workload/inputs.hpp; every pixel is covered. Each pixel's normal,
/// colour, roughness and occlusion are jittered by a hash of its index, so that neighbours differ in every attribute.
std::vector<float> cast_gbuffer(int width, int height);

/// Records of x y z radius r g b unused: one row of lights above another. Up to four reach every pixel; more of them
/// have a radius that leaves out the far ones.
std::vector<float> place_lights(int count);

/// Radiance of the sky, and of the ground below it, in the direction of a unit vector.
struct Radiance {
  float red, green, blue;
};
Radiance sky(float x, float y, float z);

}  // namespace tessera::peers

// Cameras at the origin that look along -Z, written out by hand.
#pragma once
#include "kernels/interface.hpp"

namespace tessera::raster_test {

/// s: pixels per unit of x / -z. Reversed depth near / distance, infinite far plane.
inline ViewTransform perspective(int width, int height, float s, float near_plane) {
  const float cx = static_cast<float>(width) / 2, cy = static_cast<float>(height) / 2;
  return {{s, 0, -cx, 0}, {0, -s, -cy, 0}, {0, 0, 0, near_plane}, {0, 0, -1, 0}, {0, 0, 0, 1}, width, height};
}

/// s: pixels per unit. Depth 1 at distance near_plane, 0 at far_plane.
inline ViewTransform orthographic(int width, int height, float s, float near_plane, float far_plane) {
  const float cx = static_cast<float>(width) / 2, cy = static_cast<float>(height) / 2;
  const float scale = 1 / (far_plane - near_plane);
  return {{s, 0, 0, cx}, {0, -s, 0, cy}, {0, 0, scale, far_plane * scale}, {0, 0, 0, 1}, {0, 0, 1, 0}, width, height};
}

}  // namespace tessera::raster_test

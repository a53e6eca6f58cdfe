#include "scene/scene.hpp"

#include <algorithm>
#include <cmath>

namespace tessera {

// Only vertices that a triangle uses count. The sphere is the one about the box's centre: within 2 of the smallest, and
// stable.
Bounds bounds_of(const Scene& scene) {
  Bounds b;
  if (scene.triangles.empty()) return b;
  for (int k = 0; k < 3; ++k) b.min[k] = INFINITY, b.max[k] = -INFINITY;
  for (const Triangle& t : scene.triangles)
    for (const std::uint32_t v : t.vertex)
      for (int k = 0; k < 3; ++k) {
        const double p = scene.positions[std::size_t{v} * 3 + k];
        b.min[k] = std::min(b.min[k], p);
        b.max[k] = std::max(b.max[k], p);
      }
  for (int k = 0; k < 3; ++k) b.center[k] = 0.5 * (b.min[k] + b.max[k]);
  double squared = 0;
  for (const Triangle& t : scene.triangles)
    for (const std::uint32_t v : t.vertex) {
      double d2 = 0;
      for (int k = 0; k < 3; ++k) {
        const double d = scene.positions[std::size_t{v} * 3 + k] - b.center[k];
        d2 += d * d;
      }
      squared = std::max(squared, d2);
    }
  b.radius = std::sqrt(squared);
  return b;
}

}  // namespace tessera

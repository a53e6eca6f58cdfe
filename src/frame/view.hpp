// From a camera and a picture size to what the kernels need.
#pragma once
#include "kernels/interface.hpp"
#include "scene/scene.hpp"

namespace tessera {

struct View {
  ViewTransform transform;
  float ray_corner[3], ray_dx[3], ray_dy[3];  // direction(x, y) = corner + x dx + y dy, pixel coordinates
};

/// The camera seen in a picture of this size. The vertical field of view is kept, the horizontal one follows the size.
/// Computed in double from + - * / sqrt and the kernels' own tangent: the same bits everywhere.
/// Throws Error(usage) for a camera without direction, with a field of view outside (0, 180) degrees, or not finite.
View make_view(const Camera& camera, int width, int height, const Kernels& kernels);

/// Looks at the bounding sphere from `yaw` (radians about +Y, 0 = from +Z) and `pitch` (above the horizon), from
/// `distance` (0: so that the sphere just fits into a picture of this aspect).
Camera orbit_camera(const Bounds& bounds, double yaw, double pitch, double distance, double vertical_fov, double aspect,
                    const Kernels& kernels);

/// Near and far planes that hold the whole sphere, for cameras that a person placed.
void fit_clip_planes(Camera& camera, const Bounds& bounds);

}  // namespace tessera

// Cameras as a file or a person describes them.
#pragma once
#include <string>

namespace tessera {

/// Looks along `target - eye`.
struct Camera {
  std::string name;
  double eye[3] = {0, 0, 1}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
  bool orthographic = false;
  double vertical_fov = 0.7853981633974483;  // radians (perspective)
  double vertical_extent = 1;                // half the height seen, world units (orthographic)
  double near_plane = 0.01, far_plane = 0;   // far 0: infinite (perspective)
  double aspect = 0;                         // width / height; 0: the picture's
};

}  // namespace tessera

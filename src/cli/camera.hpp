// Which camera looks at the scene: the options, and the choice.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "kernels/interface.hpp"
#include "scene/scene.hpp"

namespace tessera::cli {

struct CameraOptions {
  std::string camera;           // index or name
  std::string eye, target, up;  // x,y,z
  std::string orbit = "20,15";  // yaw,pitch[,distance]
  double fov = 45;              // degrees, vertical
};

void add_camera_options(CLI::App& command, CameraOptions& options);

/// Eye, target, up and field of view as given; target and up have defaults. Clip planes are not set.
Camera placed_camera(const CameraOptions& options, const Bounds& bounds);

/// The camera that the options ask for. Throws Error(usage) that lists the file's cameras if there is no such one.
Camera choose_camera(const CameraOptions& options, const Scene& scene, double aspect, const Kernels& kernels);

}  // namespace tessera::cli

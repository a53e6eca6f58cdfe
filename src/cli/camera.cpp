#include "cli/camera.hpp"

#include <charconv>

#include "base/error.hpp"
#include "cli/parse.hpp"
#include "cli/text.hpp"
#include "frame/view.hpp"

namespace tessera::cli {
namespace {

void set(double (&out)[3], const std::array<double, 3>& v) {
  for (std::size_t k = 0; k < 3; ++k) out[k] = v[k];
}

double field_of_view(const CameraOptions& options) {
  if (!(options.fov > 0 && options.fov < 180))
    throw usage_error("--fov {}: expected above 0 and below 180 degrees", options.fov);
  return options.fov * radians_per_degree;
}

// A name that matches wins over an index: a camera may be called "1".
const Camera& camera_of_file(const std::string& wish, const std::vector<Camera>& cameras) {
  for (const Camera& camera : cameras)
    if (camera.name == wish) return camera;
  std::size_t index = 0;
  const auto result = std::from_chars(wish.data(), wish.data() + wish.size(), index);
  if (result.ec == std::errc() && result.ptr == wish.data() + wish.size() && index < cameras.size())
    return cameras[index];
  std::string list;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    list += fmt::format("{}{}{}", i == 0 ? "" : ", ", i, cameras[i].name.empty() ? "" : " '" + cameras[i].name + "'");
  throw usage_error("--camera '{}': the file has {}", wish, list.empty() ? "no cameras" : "only " + list);
}

}  // namespace

void add_camera_options(CLI::App& command, CameraOptions& options) {
  const std::string group = "Camera";
  auto* camera = command.add_option("--camera", options.camera, "A camera of the file, by index (from 0) or name")
                     ->type_name("N|NAME")
                     ->group(group);
  auto* orbit =
      command
          .add_option("--orbit", options.orbit,
                      "Look at the scene's centre from this yaw (0: from +Z, 90: from +X) and pitch above the "
                      "horizon, degrees; without a distance, so far away that all is seen")
          ->type_name("YAW,PITCH[,DISTANCE]")
          ->capture_default_str()
          ->group(group);
  auto* eye = command.add_option("--eye", options.eye, "Look from this point")->type_name("X,Y,Z")->group(group);
  auto* target = command.add_option("--target", options.target, "... at this one (default: the scene's centre)")
                     ->type_name("X,Y,Z")
                     ->group(group);
  auto* up = command.add_option("--up", options.up, "... with this direction upwards (default: 0,1,0)")
                 ->type_name("X,Y,Z")
                 ->group(group);
  auto* fov = command.add_option("--fov", options.fov, "Vertical field of view, degrees")
                  ->type_name("DEGREES")
                  ->capture_default_str()
                  ->group(group);
  camera->excludes(orbit)->excludes(eye)->excludes(fov);
  orbit->excludes(eye);
  target->needs(eye);
  up->needs(eye);
}

Camera placed_camera(const CameraOptions& options, const Bounds& bounds) {
  Camera camera;
  camera.vertical_fov = field_of_view(options);
  set(camera.eye, parse_vector("--eye", options.eye));
  for (std::size_t k = 0; k < 3; ++k) camera.target[k] = bounds.center[k];
  if (!options.target.empty()) set(camera.target, parse_vector("--target", options.target));
  if (!options.up.empty()) set(camera.up, parse_vector("--up", options.up));
  return camera;
}

Camera choose_camera(const CameraOptions& options, const Scene& scene, double aspect, const Kernels& kernels) {
  if (!options.camera.empty()) return camera_of_file(options.camera, scene.cameras);
  const Bounds bounds = bounds_of(scene);
  if (!options.eye.empty()) {
    Camera camera = placed_camera(options, bounds);
    fit_clip_planes(camera, bounds);
    return camera;
  }
  const std::vector<double> orbit = parse_numbers("--orbit", options.orbit, 2, 3);
  if (orbit.size() == 3 && !(orbit[2] > 0))
    throw usage_error("--orbit '{}': the distance must be above 0", options.orbit);
  return orbit_camera(bounds, orbit[0] * radians_per_degree, orbit[1] * radians_per_degree,
                      orbit.size() == 3 ? orbit[2] : 0, field_of_view(options), aspect, kernels);
}

}  // namespace tessera::cli

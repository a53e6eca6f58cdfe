#include <cmath>
#include <glm/geometric.hpp>

#include "io/gltf_build.hpp"

namespace tessera {
namespace {

constexpr double half_pi = 1.5707963267948966;

// The node's -Z and +Y axes in the world, without its scale.
struct Axes {
  glm::dvec3 position, forward, up;
  bool valid;
};

Axes axes_of(const glm::dmat4& world) {
  const glm::dvec3 z(world[2]);
  const glm::dvec3 y(world[1]);
  const double z_length = glm::length(z);
  const double y_length = glm::length(y);
  const bool valid = z_length > 0 && y_length > 0 && std::isfinite(z_length) && std::isfinite(y_length) &&
                     std::isfinite(glm::dot(glm::dvec3(world[3]), glm::dvec3(1)));
  return {glm::dvec3(world[3]), -z / z_length, y / y_length, valid};
}

}  // namespace

void build_lights(GltfDocument& document, const std::vector<int>& order, const std::vector<glm::dmat4>& world,
                  Scene& scene) {
  for (const int node : order) {
    const tinygltf::Node& holder = document.model.nodes[std::size_t(node)];
    const auto* reference = extension_of(holder.extensions, "KHR_lights_punctual");
    if (reference == nullptr) continue;
    const int index = int(number_in(*reference, "light", 0));
    const tinygltf::Light& in = document.model.lights[std::size_t(index)];
    const std::string part = fmt::format("extensions.KHR_lights_punctual.lights[{}]", index);
    const auto checked = [&](const char* key, double value) {
      if (!(value >= 0) || !std::isfinite(float(value))) {
        throw document.wrong(part + "." + key, "is {}, expected a number that is not negative", value);
      }
      return float(value);
    };
    Light light;
    light.name = in.name.empty() ? holder.name : in.name;
    if (in.type == "directional") {
      light.type = LightType::directional;
    } else if (in.type == "spot") {
      light.type = LightType::spot;
    } else if (in.type != "point") {
      throw document.wrong(part + ".type", "is '{}', expected directional, point or spot", in.type);
    }
    for (std::size_t c = 0; c < in.color.size(); ++c) light.color[c] = checked("color", in.color[c]);
    light.intensity = checked("intensity", in.intensity);
    light.range = checked("range", in.range);
    if (light.type == LightType::spot) {
      const double inner = in.spot.innerConeAngle;
      const double outer = in.spot.outerConeAngle;
      // Angles written as floats may pass pi/2 by their rounding.
      if (!(inner >= 0 && inner < outer && outer <= half_pi + 1e-6)) {
        throw document.wrong(part + ".spot", "cone angles are {} and {}, expected 0 <= inner < outer <= pi/2", inner,
                             outer);
      }
      light.inner_cone_angle = float(inner);
      light.outer_cone_angle = float(std::min(outer, half_pi));
    }
    const Axes axes = axes_of(world[std::size_t(node)]);
    if (!axes.valid) {
      document.warn(node_name(node) + ": its light is left out: the node's scale is zero");
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      light.position[i] = float(axes.position[i]);
      light.direction[i] = float(axes.forward[i]);
    }
    scene.lights.push_back(std::move(light));
  }
}

void build_cameras(GltfDocument& document, const std::vector<int>& order, const std::vector<glm::dmat4>& world,
                   Scene& scene) {
  for (const int node : order) {
    const tinygltf::Node& holder = document.model.nodes[std::size_t(node)];
    if (holder.camera < 0) continue;
    const tinygltf::Camera& in = document.model.cameras[std::size_t(holder.camera)];
    const std::string part = fmt::format("cameras[{}]", holder.camera);
    const auto positive = [&](const char* key, double value) {
      if (!(value > 0)) throw document.wrong(part + "." + key, "is {}, expected a positive number", value);
      return value;
    };
    Camera camera;
    camera.name = in.name.empty() ? holder.name : in.name;
    if (in.type == "perspective") {
      camera.vertical_fov = positive("perspective.yfov", in.perspective.yfov);
      if (camera.vertical_fov >= 2 * half_pi) {
        throw document.wrong(part + ".perspective.yfov", "is {} radians, expected less than pi", camera.vertical_fov);
      }
      camera.near_plane = positive("perspective.znear", in.perspective.znear);
      camera.far_plane = in.perspective.zfar;
      camera.aspect = in.perspective.aspectRatio;
      if (camera.aspect < 0) throw document.wrong(part + ".perspective.aspectRatio", "is {}", camera.aspect);
    } else if (in.type == "orthographic") {
      camera.orthographic = true;
      camera.vertical_extent = positive("orthographic.ymag", std::fabs(in.orthographic.ymag));
      camera.aspect = positive("orthographic.xmag", std::fabs(in.orthographic.xmag)) / camera.vertical_extent;
      camera.near_plane = in.orthographic.znear;
      camera.far_plane = positive("orthographic.zfar", in.orthographic.zfar);
    } else {
      throw document.wrong(part + ".type", "is '{}', expected perspective or orthographic", in.type);
    }
    if (camera.near_plane < 0) throw document.wrong(part, "znear is {}, expected 0 or more", camera.near_plane);
    if (camera.far_plane != 0 && camera.far_plane <= camera.near_plane) {
      throw document.wrong(part, "zfar {} is not beyond znear {}", camera.far_plane, camera.near_plane);
    }
    const Axes axes = axes_of(world[std::size_t(node)]);
    if (!axes.valid) {
      document.warn(node_name(node) + ": its camera is left out: the node's scale is zero");
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      camera.eye[i] = axes.position[i];
      camera.target[i] = axes.position[i] + axes.forward[i];
      camera.up[i] = axes.up[i];
    }
    scene.cameras.push_back(std::move(camera));
  }
}

}  // namespace tessera

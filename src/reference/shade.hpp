// The whole shading formula of one point, slowly and literally, in double.
#pragma once
#include <functional>
#include <vector>

#include "reference/albedo.hpp"
#include "reference/vector.hpp"

namespace tessera::reference {

struct ShadeSurface {
  Vec3 position, normal, base_color, emissive;
  double metallic = 0, roughness = 1, occlusion = 1;
  bool unlit = false;
};

struct ShadeLight {
  enum class Type { directional, point, spot } type = Type::point;
  bool plus_one = false;  // Karis's window over d^2 + 1; otherwise glTF's window over d^2
  Vec3 position, direction, color;
  double range = 0;                      // 0: unlimited
  double cos_inner = 1, cos_outer = -1;  // of the spot's half angles
};

/// Image-based light as functions; an empty radiance means that there is none.
struct ShadeEnvironment {
  std::function<Vec3(const Vec3& direction, double lod)> radiance;
  double max_lod = 0;
  std::function<Vec3(const Vec3& normal)> irradiance_over_pi;
  std::function<DirectionalAlbedo(double NoV, double roughness)> dfg;
};

/// Radiance towards an eye at `eye`. Metallic-roughness of glTF 2.0 appendix B with height-correlated GGX (Heitz 2014),
/// Schlick's Fresnel, Lambert; the environment by split sum (Karis 2013) and multiple scattering (Fdez-Aguera 2019).
Vec3 shade(const ShadeSurface& surface, const Vec3& eye, const std::vector<ShadeLight>& lights,
           const ShadeEnvironment& environment);

}  // namespace tessera::reference

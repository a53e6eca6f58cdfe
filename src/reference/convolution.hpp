// Radiance from all around under a round lobe, by brute force: what prefiltered levels of a cube are held to.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "reference/environment.hpp"

namespace tessera::reference {

/// Centre of texel (i, j) of a face of n x n texels as a unit vector; faces as OpenGL 4.6 has them (table 8.19).
Vec3 cube_texel_direction(int face, int i, int j, int n);

/// Every texel of a cube, with its direction and its exact solid angle (Arvo 1995: a rectangle seen from the centre).
class CubeSum {
 public:
  /// faces: SpherePicture::faces must be true.
  explicit CubeSum(const SpherePicture& faces);

  /// For each axis the mean of the radiance weighted by D(h) n.l with n = v = r = axis: what split-sum prefiltering
  /// approximates (Karis 2013, "Real shading in Unreal Engine 4", with n.l as weight). Summed over all texels.
  [[nodiscard]] std::vector<Vec3> convolved(std::span<const Vec3> axes, double roughness) const;

 private:
  std::vector<double> x_, y_, z_, solid_angle_;
  std::vector<float> rgb_;
};

}  // namespace tessera::reference

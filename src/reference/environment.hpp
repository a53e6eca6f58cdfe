// Light from all around as ground truth takes it: a picture, looked up in double, and directions drawn in proportion to
// its brightness.
#pragma once
#include <vector>

#include "reference/vector.hpp"

namespace tessera::reference {

/// RGB radiance, finite and non-negative. Equirectangular: the direction (x, y, z) is seen at u = 0.5 + atan2(z, x) /
/// 2pi, v = acos(y) / pi from the top left. Or six faces below each other, as OpenGL 4.6 has them (table 8.19).
struct SpherePicture {
  int width = 0, height = 0;
  std::vector<float> rgb;
  bool faces = false;
};

class EnvironmentMap {
 public:
  /// rotation: radians about +Y, counter-clockwise seen from above.
  EnvironmentMap(SpherePicture picture, double rotation);

  /// Bilinear between texels' centres; d a unit vector.
  [[nodiscard]] Vec3 radiance(const Vec3& d) const;

  /// A direction for two numbers in [0, 1), and its density over solid angle.
  struct Sample {
    Vec3 direction;
    double density = 0;
  };
  [[nodiscard]] Sample sample(double u, double v) const;
  [[nodiscard]] double density(const Vec3& d) const;

 private:
  [[nodiscard]] Vec3 lookup(const Vec3& d) const;  // in the picture's own orientation

  SpherePicture picture_;
  double cos_, sin_;
  // Cells of equal height in cos(theta) and equal width in azimuth, each with the mean luminance seen in it and a share
  // of the whole, so that nothing has no chance: density = weight / total / cell's solid angle.
  int columns_, rows_;
  std::vector<double> cumulative_;  // of all cells, row by row; last: the total
};

}  // namespace tessera::reference

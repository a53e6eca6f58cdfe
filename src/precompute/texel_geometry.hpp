// Where the texels of an environment's picture lie on the sphere. In double, by + - * / and square roots alone, but for
// the angles of an equirectangular map, which come from the kernels' own functions: the same on every machine.
#pragma once
#include <vector>

#include "kernels/interface.hpp"
#include "precompute/environment_source.hpp"

namespace tessera {

struct TexelDirection {
  double x, y, z, solid_angle;
};

class TexelGeometry {
 public:
  TexelGeometry(const EnvironmentPicture& picture, const Kernels& kernels);
  [[nodiscard]] TexelDirection at(int x, int y) const;

 private:
  bool faces_;
  int size_;
  double width_ = 0;                                    // of a column, radians
  std::vector<double> cos_phi_, sin_phi_;               // by column
  std::vector<double> cos_theta_, sin_theta_, height_;  // by row; height_: the row's share of the axis
};

}  // namespace tessera

#include "reference/convolution.hpp"

#include <algorithm>
#include <cmath>

namespace tessera::reference {
namespace {

// Axes that are summed for at once: each texel is read once for all of them, and compilers find vectors here.
constexpr std::size_t block = 16;

// The area of the unit sphere behind the rectangle from (0, 0) to (s, t) of a face at distance 1.
double corner_area(double s, double t) { return std::atan2(s * t, std::sqrt(1 + s * s + t * t)); }

double texel_solid_angle(int i, int j, int n) {
  const double s0 = 2.0 * i / n - 1, s1 = 2.0 * (i + 1) / n - 1, t0 = 2.0 * j / n - 1, t1 = 2.0 * (j + 1) / n - 1;
  return corner_area(s1, t1) - corner_area(s0, t1) - corner_area(s1, t0) + corner_area(s0, t0);
}

}  // namespace

Vec3 cube_texel_direction(int face, int i, int j, int n) {
  const double s = (2 * i + 1.0) / n - 1, t = (2 * j + 1.0) / n - 1;
  const Vec3 points[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
  return normalize(points[face]);
}

CubeSum::CubeSum(const SpherePicture& faces) : rgb_(faces.rgb) {
  const int n = faces.width;
  for (int row = 0; row < 6 * n; ++row)
    for (int i = 0; i < n; ++i) {
      const Vec3 d = cube_texel_direction(row / n, i, row % n, n);
      x_.push_back(d.x);
      y_.push_back(d.y);
      z_.push_back(d.z);
      solid_angle_.push_back(texel_solid_angle(i, row % n, n));
    }
}

std::vector<Vec3> CubeSum::convolved(std::span<const Vec3> axes, double roughness) const {
  const double alpha = roughness * roughness, alpha2 = alpha * alpha;
  std::vector<Vec3> out;
  for (std::size_t first = 0; first < axes.size(); first += block) {
    const std::size_t count = std::min(block, axes.size() - first);
    double ax[block] = {}, ay[block] = {}, az[block] = {}, sum[4][block] = {};
    for (std::size_t k = 0; k < count; ++k) {
      ax[k] = axes[first + k].x;
      ay[k] = axes[first + k].y;
      az[k] = axes[first + k].z;
    }
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double x = x_[i], y = y_[i], z = z_[i], area = solid_angle_[i];
      const double red = double(rgb_[3 * i]), green = double(rgb_[3 * i + 1]), blue = double(rgb_[3 * i + 2]);
      for (std::size_t k = 0; k < block; ++k) {
        const double NoL = ax[k] * x + ay[k] * y + az[k] * z;
        // D(h) up to a factor: h lies half way to l, NoH^2 = (1 + NoL) / 2.
        const double t = 1 + (alpha2 - 1) * (1 + NoL) / 2;
        const double weight = NoL > 0 ? area * NoL / (t * t) : 0;
        sum[0][k] += weight * red;
        sum[1][k] += weight * green;
        sum[2][k] += weight * blue;
        sum[3][k] += weight;
      }
    }
    for (std::size_t k = 0; k < count; ++k) out.push_back(Vec3{sum[0][k], sum[1][k], sum[2][k]} * (1 / sum[3][k]));
  }
  return out;
}

}  // namespace tessera::reference

#include "reference/environment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace tessera::reference {
namespace {

constexpr double pi = std::numbers::pi;

struct FacePoint {
  int face;
  double s, t;
};

FacePoint on_cube(const Vec3& d) {
  const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  if (ax >= ay && ax >= az) return d.x > 0 ? FacePoint{0, -d.z / ax, -d.y / ax} : FacePoint{1, d.z / ax, -d.y / ax};
  if (ay >= az) return d.y > 0 ? FacePoint{2, d.x / ay, d.z / ay} : FacePoint{3, d.x / ay, -d.z / ay};
  return d.z > 0 ? FacePoint{4, d.x / az, -d.y / az} : FacePoint{5, -d.x / az, -d.y / az};
}

double luminance(const Vec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

Vec3 texel(const SpherePicture& p, int x, int y) {
  const float* rgb = &p.rgb[(std::size_t(y) * std::size_t(p.width) + std::size_t(x)) * 3];
  return {double(rgb[0]), double(rgb[1]), double(rgb[2])};
}

Vec3 mix(const Vec3& a, const Vec3& b, double t) { return a * (1 - t) + b * t; }

}  // namespace

EnvironmentMap::EnvironmentMap(SpherePicture picture, double rotation)
    : picture_(std::move(picture)), cos_(std::cos(rotation)), sin_(std::sin(rotation)), columns_(512), rows_(512) {
  constexpr int points = 4;  // each way in a cell
  double total = 0;
  cumulative_.reserve(std::size_t(columns_) * std::size_t(rows_) + 1);
  cumulative_.push_back(0);
  std::vector<double> cells;
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i) {
      double sum = 0;
      for (int k = 0; k < points * points; ++k) {
        const double y = 1 - 2 * (j + (k / points + 0.5) / points) / rows_;
        const double phi = 2 * pi * (i + (k % points + 0.5) / points) / columns_, s = std::sqrt(1 - y * y);
        sum += luminance(radiance({s * std::cos(phi), y, s * std::sin(phi)}));
      }
      cells.push_back(sum / (points * points));
      total += cells.back();
    }
  const double share = total > 0 ? 0.1 * total / double(cells.size()) : 1;
  for (const double cell : cells) cumulative_.push_back(cumulative_.back() + cell + share);
}

Vec3 EnvironmentMap::radiance(const Vec3& d) const {
  // Turned back: the picture was turned by R, which takes +X to cos X - sin Z.
  return lookup({d.x * cos_ - d.z * sin_, d.y, d.x * sin_ + d.z * cos_});
}

Vec3 EnvironmentMap::lookup(const Vec3& d) const {
  const int w = picture_.width, h = picture_.faces ? picture_.width : picture_.height;
  double x = 0, y = 0;
  int top = 0;
  if (picture_.faces) {
    const FacePoint p = on_cube(d);
    x = std::clamp((p.s + 1) / 2 * w - 0.5, 0.0, w - 1.0);
    y = std::clamp((p.t + 1) / 2 * h - 0.5, 0.0, h - 1.0);
    top = p.face * h;
  } else {
    x = (0.5 + std::atan2(d.z, d.x) / (2 * pi)) * w - 0.5;
    y = std::clamp(std::atan2(std::hypot(d.x, d.z), d.y) / pi * h - 0.5, 0.0, h - 1.0);
  }
  const double x0 = std::floor(x), y0 = std::floor(y);
  const int j0 = int(y0), j1 = std::min(j0 + 1, h - 1);
  const int i0 = picture_.faces ? int(x0) : (int(x0) + w) % w;
  const int i1 = picture_.faces ? std::min(i0 + 1, w - 1) : (i0 + 1) % w;
  const Vec3 above = mix(texel(picture_, i0, top + j0), texel(picture_, i1, top + j0), x - x0);
  const Vec3 below = mix(texel(picture_, i0, top + j1), texel(picture_, i1, top + j1), x - x0);
  return mix(above, below, y - y0);
}

EnvironmentMap::Sample EnvironmentMap::sample(double u, double v) const {
  const double target = u * cumulative_.back();
  const auto after = std::upper_bound(cumulative_.begin(), cumulative_.end(), target);
  const std::size_t cell =
      std::min(std::size_t(std::max<std::ptrdiff_t>(after - cumulative_.begin() - 1, 0)), cumulative_.size() - 2);
  const double weight = cumulative_[cell + 1] - cumulative_[cell];
  const double within = std::clamp((target - cumulative_[cell]) / weight, 0.0, 1.0);
  const double column = double(cell % std::size_t(columns_)), row = double(cell / std::size_t(columns_));
  const double phi = 2 * pi * (column + within) / columns_, y = std::clamp(1 - 2 * (row + v) / rows_, -1.0, 1.0);
  const double s = std::sqrt(1 - y * y), area = 4 * pi / (double(columns_) * rows_);
  return {{s * std::cos(phi), y, s * std::sin(phi)}, weight / cumulative_.back() / area};
}

double EnvironmentMap::density(const Vec3& d) const {
  double phi = std::atan2(d.z, d.x);
  if (phi < 0) phi += 2 * pi;
  const int i = std::clamp(int(phi / (2 * pi) * columns_), 0, columns_ - 1);
  const int j = std::clamp(int((1 - d.y) / 2 * rows_), 0, rows_ - 1);
  const std::size_t cell = std::size_t(j) * std::size_t(columns_) + std::size_t(i);
  const double area = 4 * pi / (double(columns_) * rows_);
  return (cumulative_[cell + 1] - cumulative_[cell]) / cumulative_.back() / area;
}

}  // namespace tessera::reference

#include "precompute/texel_geometry.hpp"

#include <cmath>
#include <numbers>

#include "precompute/angles.hpp"
#include "precompute/cube.hpp"

namespace tessera {
namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

TexelGeometry::TexelGeometry(const EnvironmentPicture& picture, const Kernels& kernels)
    : faces_(picture.faces), size_(picture.image.width) {
  if (faces_) return;
  const int columns = picture.image.width, rows = picture.image.height;
  width_ = 2 * pi / columns;
  std::vector<float> phi, theta;
  for (int i = 0; i < columns; ++i) phi.push_back(float(((i + 0.5) / columns - 0.5) * 2 * pi));
  for (int j = 0; j < rows; ++j) theta.push_back(float((j + 0.5) / rows * pi));
  cos_phi_ = evaluate(MathFunction::cos, phi, kernels);
  sin_phi_ = evaluate(MathFunction::sin, phi, kernels);
  cos_theta_ = evaluate(MathFunction::cos, theta, kernels);
  sin_theta_ = evaluate(MathFunction::sin, theta, kernels);
  // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2)
  const double half = evaluate(MathFunction::sin, {float(pi / (2 * rows))}, kernels)[0];
  for (const double sine : sin_theta_) height_.push_back(2 * sine * half);
}

TexelDirection TexelGeometry::at(int x, int y) const {
  if (faces_) {
    const CubeDirection d = texel_direction(y / size_, x, y % size_, size_);
    return {double(d.x), double(d.y), double(d.z), double(d.solid_angle)};
  }
  const std::size_t i = std::size_t(x), j = std::size_t(y);
  return {sin_theta_[j] * cos_phi_[i], cos_theta_[j], sin_theta_[j] * sin_phi_[i], width_ * height_[j]};
}

}  // namespace tessera

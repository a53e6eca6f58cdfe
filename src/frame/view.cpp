#include "frame/view.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace tessera {
namespace {

struct Vector {
  double x, y, z;
};
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector scaled(const Vector& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
bool finite(const Vector& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

Vector from_array(const double (&a)[3]) { return {a[0], a[1], a[2]}; }

double evaluate(const Kernels& kernels, MathFunction f, double x) {
  const float in = static_cast<float>(x);
  float out = 0;
  kernels.evaluate(f, &in, &in, &out, 1);
  return out;
}

// scale * dot(axis, p - eye) + offset as a row over (p, 1).
void set_row(float (&row)[4], const Vector& axis, const Vector& eye, double scale, double offset) {
  row[0] = static_cast<float>(axis.x * scale);
  row[1] = static_cast<float>(axis.y * scale);
  row[2] = static_cast<float>(axis.z * scale);
  row[3] = static_cast<float>(offset - scale * dot(axis, eye));
}

void store(float (&out)[3], const Vector& v) {
  out[0] = static_cast<float>(v.x);
  out[1] = static_cast<float>(v.y);
  out[2] = static_cast<float>(v.z);
}

}  // namespace

View make_view(const Camera& camera, int width, int height, const Kernels& kernels) {
  const Vector eye = from_array(camera.eye);
  Vector forward = from_array(camera.target) - eye;
  const double length = std::sqrt(dot(forward, forward));
  if (!finite(eye) || !std::isfinite(length) || length == 0)
    throw usage_error("camera: eye and target must be finite and different");
  forward = scaled(forward, 1 / length);
  Vector up = from_array(camera.up);
  Vector right = cross(forward, up);
  if (!(dot(right, right) > 1e-12 * dot(up, up))) {  // up along the view: any other axis serves
    up = std::abs(forward.y) > 0.9 ? Vector{0, 0, forward.y > 0 ? 1.0 : -1.0} : Vector{0, 1, 0};
    right = cross(forward, up);
  }
  right = scaled(right, 1 / std::sqrt(dot(right, right)));
  up = cross(right, forward);

  View view{};
  ViewTransform& t = view.transform;
  t.width = width;
  t.height = height;
  const double half_width = 0.5 * width, half_height = 0.5 * height, aspect = static_cast<double>(width) / height;
  const double near = camera.near_plane, far = camera.far_plane;
  if (camera.orthographic) {
    if (!(camera.vertical_extent > 0) || !std::isfinite(camera.vertical_extent))
      throw usage_error("camera: vertical extent {} must be above 0", camera.vertical_extent);
    if (!(far > near)) throw usage_error("camera: the far plane ({}) must lie behind the near plane ({})", far, near);
    const double scale = half_height / camera.vertical_extent;
    set_row(t.x, right, eye, scale, half_width);
    set_row(t.y, up, eye, -scale, half_height);
    set_row(t.z, forward, eye, -1 / (far - near), far / (far - near));
    t.w[3] = 1;
    store(view.ray_corner, forward);
    t.eye[0] = static_cast<float>(-forward.x);
    t.eye[1] = static_cast<float>(-forward.y);
    t.eye[2] = static_cast<float>(-forward.z);
    return view;
  }
  const double pi = 3.14159265358979323846;
  if (!(camera.vertical_fov > 0 && camera.vertical_fov < pi))
    throw usage_error("camera: vertical field of view {:.3f} degrees: expected above 0 and below 180",
                      camera.vertical_fov * 180 / pi);
  if (!(near > 0)) throw usage_error("camera: the near plane ({}) must be above 0", near);
  const double tangent = evaluate(kernels, MathFunction::tan, 0.5 * camera.vertical_fov);
  // Window x * w = half_width * (right.p / (tangent * aspect) + w), with w = forward.p.
  const double scale = half_height / tangent;
  set_row(t.w, forward, eye, 1, 0);
  const auto combined = [&](const Vector& axis, double axis_scale, double w_scale) {
    return Vector{axis.x * axis_scale + forward.x * w_scale, axis.y * axis_scale + forward.y * w_scale,
                  axis.z * axis_scale + forward.z * w_scale};
  };
  set_row(t.x, combined(right, scale, half_width), eye, 1, 0);
  set_row(t.y, combined(up, -scale, half_height), eye, 1, 0);
  if (far > near)
    set_row(t.z, forward, eye, -near / (far - near), near * far / (far - near));
  else
    t.z[3] = static_cast<float>(near);
  t.eye[0] = static_cast<float>(eye.x);
  t.eye[1] = static_cast<float>(eye.y);
  t.eye[2] = static_cast<float>(eye.z);
  t.eye[3] = 1;
  const Vector corner = {forward.x - right.x * tangent * aspect + up.x * tangent,
                         forward.y - right.y * tangent * aspect + up.y * tangent,
                         forward.z - right.z * tangent * aspect + up.z * tangent};
  store(view.ray_corner, corner);
  store(view.ray_dx, scaled(right, 2 * tangent * aspect / width));
  store(view.ray_dy, scaled(up, -2 * tangent / height));
  return view;
}

Camera orbit_camera(const Bounds& bounds, double yaw, double pitch, double distance, double vertical_fov, double aspect,
                    const Kernels& kernels) {
  Camera camera;
  camera.name = "orbit";
  camera.vertical_fov = vertical_fov;
  const double radius = bounds.radius > 0 ? bounds.radius : 1;
  if (distance <= 0) {
    // The sphere touches the cone of the narrower angle: distance = r / sin(half angle).
    const double tangent = evaluate(kernels, MathFunction::tan, 0.5 * vertical_fov) * std::min(1.0, aspect);
    distance = radius * std::sqrt(1 + tangent * tangent) / tangent;
  }
  const double sin_yaw = evaluate(kernels, MathFunction::sin, yaw), cos_yaw = evaluate(kernels, MathFunction::cos, yaw);
  const double sin_pitch = evaluate(kernels, MathFunction::sin, pitch),
               cos_pitch = evaluate(kernels, MathFunction::cos, pitch);
  const double direction[3] = {sin_yaw * cos_pitch, sin_pitch, cos_yaw * cos_pitch};
  for (int k = 0; k < 3; ++k) {
    camera.target[k] = bounds.center[k];
    camera.eye[k] = bounds.center[k] + distance * direction[k];
  }
  // Straight down or up, +Y says nothing about the picture's orientation.
  if (!(cos_pitch > 1e-4)) camera.up[0] = -sin_yaw * sin_pitch, camera.up[1] = 0, camera.up[2] = -cos_yaw * sin_pitch;
  fit_clip_planes(camera, bounds);
  return camera;
}

void fit_clip_planes(Camera& camera, const Bounds& bounds) {
  const Vector offset = from_array(bounds.center) - from_array(camera.eye);
  const double distance = std::sqrt(dot(offset, offset));
  const double radius = bounds.radius > 0 ? bounds.radius : 1;
  // Reversed depth in floats loses nothing to a near plane this close; it only has to be above 0.
  camera.near_plane = std::max(0.99 * (distance - radius), 1e-4 * radius);
  camera.far_plane = camera.orthographic ? distance + radius * 1.01 : 0;
}

}  // namespace tessera

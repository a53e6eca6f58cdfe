// The slow, obvious twin of perspective-correct interpolation: a pinhole camera whose rays are intersected with
// triangles in double (Moller and Trumbore 1997).
#pragma once
#include <cmath>
#include <random>

#include "kernels/interface.hpp"

namespace tessera::resolve_test {

struct Vector {
  double x, y, z;
};
inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
inline double inner(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector outer(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vector unit(Vector a) { return 1 / std::sqrt(inner(a, a)) * a; }

inline double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * (random() / 4294967296.0);
}

struct RayHit {
  bool hit, back;
  double t, b[3];
  [[nodiscard]] bool inside(double margin) const {
    return hit && t > 0.1 && b[0] > margin && b[1] > margin && b[2] > margin;
  }
};

struct RayCamera {
  Vector eye{0.7, -1.3, 2.1}, forward = unit({0.3, 0.2, -0.9}), right = unit(outer(forward, {0, 1, 0})),
                              up = outer(right, forward);
  double width = 2000, height = 1100, focal = 900, near_plane = 0.01;

  [[nodiscard]] ViewTransform view() const {
    ViewTransform v{};
    const auto row = [&](float(&out)[4], Vector axis, double constant) {
      out[0] = float(axis.x);
      out[1] = float(axis.y);
      out[2] = float(axis.z);
      out[3] = float(constant - inner(axis, eye));
    };
    row(v.x, focal * right + 0.5 * width * forward, 0);
    row(v.y, -focal * up + 0.5 * height * forward, 0);
    row(v.z, {0, 0, 0}, near_plane);
    row(v.w, forward, 0);
    v.eye[0] = float(eye.x), v.eye[1] = float(eye.y), v.eye[2] = float(eye.z), v.eye[3] = 1;
    v.width = int(width), v.height = int(height);
    return v;
  }

  [[nodiscard]] double depth_of(Vector p) const { return inner(p - eye, forward); }

  // In front of the eye or behind it, within a wide cone.
  [[nodiscard]] Vector random_point(std::mt19937& random) const {
    const double z = uniform(random, -2, 6), x = uniform(random, -5, 5), y = uniform(random, -3, 3);
    return eye + z * forward + x * right + y * up;
  }

  [[nodiscard]] RayHit intersect(const Vector (&p)[3], double x, double y) const {
    const Vector ray =
        forward + (x - 0.5 * width) / focal * right + -((y - 0.5 * height) / focal) * up;  // t is the depth
    const Vector e1 = p[1] - p[0], e2 = p[2] - p[0], s = eye - p[0];
    const Vector h = outer(ray, e2), q = outer(s, e1);
    const double det = inner(e1, h);
    const double u = inner(s, h) / det, v = inner(ray, q) / det;
    return {det != 0, inner(outer(e1, e2), ray) > 0, inner(e2, q) / det, {1 - u - v, u, v}};
  }
};

}  // namespace tessera::resolve_test

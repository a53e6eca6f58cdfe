#include "bench/scaling/sphere_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "bench/peers/scene.hpp"

namespace tessera::scaling {
namespace {

constexpr int columns = 11, rows = 7;
constexpr double radius = 0.42, pi = 3.14159265358979323846;

struct Shape {
  AlignedVector<SurfaceVertex> vertices;
  AlignedVector<Triangle> triangles;

  // A grid of (across + 1) x (down + 1) vertices, vertex(u, v) for u and v from 0 to 1; u to the right and v upwards as
  // the front is seen.
  template <class At>
  void add_grid(int across, int down, const At& vertex) {
    const auto first = static_cast<std::uint32_t>(vertices.size()), row = static_cast<std::uint32_t>(across + 1);
    for (int j = 0; j <= down; ++j)
      for (int i = 0; i <= across; ++i) vertices.push_back(vertex(double(i) / across, double(j) / down));
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(down); ++j)
      for (std::uint32_t i = 0; i + 1 < row; ++i) {
        const std::uint32_t a = first + j * row + i, b = a + 1, c = a + row, d = c + 1;
        triangles.push_back({{a, b, d}, 0});
        triangles.push_back({{a, d, c}, 0});
      }
  }
};

SurfaceVertex vertex_of(const double (&position)[3], const double (&normal)[3], const double (&color)[3],
                        double metallic, double roughness) {
  SurfaceVertex v{};
  for (int k = 0; k < 3; ++k) {
    v.position[k] = float(position[k]);
    v.normal[k] = float(normal[k]);
    v.base_color[k] = float(color[k]);
  }
  v.metallic = float(metallic);
  v.roughness = float(roughness);
  v.occlusion = 0.8f;
  return v;
}

void add_sphere(Shape& shape, int column, int row, int across, int down) {
  const double u0 = double(column) / (columns - 1), v0 = double(row) / (rows - 1);
  const double centre[3] = {double(column - columns / 2), radius, 2.0 - row};
  const double color[3] = {0.9 - 0.6 * v0, 0.35 + 0.4 * u0, 0.25 + 0.6 * v0};
  shape.add_grid(across, down, [&](double u, double v) {
    const double phi = 2 * pi * u, theta = pi * (1 - v);  // counter-clockwise about +Y, from the lower pole upwards
    const double n[3] = {std::sin(theta) * std::cos(-phi), std::cos(theta), std::sin(theta) * std::sin(-phi)};
    const double p[3] = {centre[0] + radius * n[0], centre[1] + radius * n[1], centre[2] + radius * n[2]};
    return vertex_of(p, n, color, row % 2 == 0, 0.12 + 0.88 * u0);
  });
}

}  // namespace

workload::Mesh sphere_mesh(std::size_t triangles) {
  Shape shape;
  // A sphere of 2 n x n quads has 4 n^2 triangles.
  const double each = 0.9 * double(triangles) / (columns * rows);
  const int n = std::max(2, int(std::lround(std::sqrt(each / 4))));
  const int floor = std::max(2, int(std::lround(std::sqrt(0.1 * double(triangles) / 2))));
  for (int i = 0; i < columns * rows; ++i) add_sphere(shape, i % columns, i / columns, 2 * n, n);
  shape.add_grid(floor, floor, [](double u, double v) {
    const double p[3] = {40 * (u - 0.5), 0, 8 - 40 * v}, n[3] = {0, 1, 0}, grey[3] = {0.5, 0.5, 0.5};
    return vertex_of(p, n, grey, 0, 0.5);
  });
  return {std::move(shape.vertices), std::move(shape.triangles)};
}

View sphere_view(int width, int height, const Kernels& kernels) {
  Camera camera;
  for (int k = 0; k < 3; ++k) camera.eye[k] = double(peers::eye[k]);
  camera.target[0] = 0;
  camera.target[1] = 0.3;
  camera.target[2] = -1.5;
  camera.vertical_fov = 2 * std::atan(0.36);
  camera.near_plane = 0.5;
  return make_view(camera, width, height, kernels);
}

}  // namespace tessera::scaling

#include "bench/workload/mesh.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "bench/workload/bulk_file.hpp"
#include "bench/workload/inputs.hpp"

namespace tessera::workload {

Mesh::Mesh(const std::string& folder, const std::string& name) {
  const std::string path = folder + "/mesh_" + name;
  const BulkFile vertices(path + ".vtx.f32", sizeof(SurfaceVertex));
  const BulkFile indices(path + ".idx.u32", 3 * sizeof(std::uint32_t));
  vertices_.resize(vertices.records());
  positions_.resize(vertices.records() * 3);
  triangles_.resize(indices.records());
  vertices.for_each_piece([&](std::size_t first, std::size_t count) {
    vertices.read(first, count, vertices_.data() + first);
    for (std::size_t i = first; i < first + count; ++i)
      for (std::size_t k = 0; k < 3; ++k) positions_[3 * i + k] = vertices_[i].position[k];
  });
  indices.for_each_piece([&](std::size_t first, std::size_t count) {
    std::vector<std::uint32_t> index(count * 3);
    indices.read(first, count, index.data());
    for (std::size_t i = 0; i < count; ++i) {
      Triangle& triangle = triangles_[first + i];
      triangle.binding = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.vertex[k] = index[3 * i + k];
        if (triangle.vertex[k] >= vertices_.size())
          throw input_error("{}.idx.u32: triangle {}: vertex {} of {}", path, first + i, index[3 * i + k],
                            vertices_.size());
      }
    }
  });
}

Mesh::Mesh(AlignedVector<SurfaceVertex> vertices, AlignedVector<Triangle> triangles)
    : vertices_(std::move(vertices)), positions_(vertices_.size() * 3), triangles_(std::move(triangles)) {
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) positions_[3 * i + k] = vertices_[i].position[k];
}

MaterialView Mesh::plain_material() {
  MaterialView material{};
  for (float& c : material.base_color) c = 1;
  material.metallic = material.roughness = material.normal_scale = material.occlusion_strength = 1;
  return material;
}

PreparedScene Mesh::scene() const {
  PreparedScene scene{};
  scene.geometry = {positions_.data(),
                    nullptr,
                    triangles_.data(),
                    static_cast<std::uint32_t>(vertices_.size()),
                    static_cast<std::uint32_t>(triangles_.size()),
                    vertices_.data()};
  scene.materials = {&material_, 1};
  scene.double_sided = {&double_sided_, 1};
  scene.alpha_modes = {&alpha_, 1};
  return scene;
}

View read_view(const std::string& folder, int width, int height) {
  const auto clip = read_array<float>(folder + "/viewproj.f32"), eye = read_array<float>(folder + "/camera.f32");
  if (clip.size() != 16 || eye.size() < 3) throw input_error("{}: viewproj.f32 or camera.f32 is too short", folder);
  View view{};
  ViewTransform& t = view.transform;
  t.width = width;
  t.height = height;
  for (std::size_t column = 0; column < 4; ++column) {
    const double x = clip[4 * column], y = clip[4 * column + 1], z = clip[4 * column + 2], w = clip[4 * column + 3];
    t.x[column] = static_cast<float>(0.5 * width * (x + w));  // x / w from -1 .. 1 to pixels
    t.y[column] = static_cast<float>(0.5 * height * (y + w));
    t.z[column] = static_cast<float>(w - z);  // reversed
    t.w[column] = static_cast<float>(w);
  }
  for (int k = 0; k < 3; ++k) t.eye[k] = eye[static_cast<std::size_t>(k)];
  t.eye[3] = 1;
  return view;
}

}  // namespace tessera::workload

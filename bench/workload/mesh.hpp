// The triangle mesh of the full-frame workload, and the camera that it is seen with.
//   mesh_NAME.vtx.f32   SurfaceVertex records: position, normal, base colour, metallic, roughness, occlusion
//   mesh_NAME.idx.u32   three indices a triangle, counter-clockwise on the screen
//   viewproj.f32        4 x 4, column-major, Vulkan clip space: y down, depth 0 at the near plane and 1 at the far one
#pragma once
#include <string>
#include <vector>

#include "base/aligned.hpp"
#include "frame/pipeline.hpp"
#include "frame/view.hpp"
#include "kernels/interface.hpp"

namespace tessera::workload {

class Mesh {
 public:
  Mesh(const std::string& folder, const std::string& name);
  /// Of one binding, 0; indices within vertices.
  Mesh(AlignedVector<SurfaceVertex> vertices, AlignedVector<Triangle> triangles);
  /// One plain material; no lights yet.
  [[nodiscard]] PreparedScene scene() const;

 private:
  static MaterialView plain_material();
  AlignedVector<SurfaceVertex> vertices_;
  AlignedVector<float> positions_;
  AlignedVector<Triangle> triangles_;
  MaterialView material_ = plain_material();
  std::uint8_t double_sided_ = 0;
  AlphaMode alpha_ = AlphaMode::opaque;
};

View read_view(const std::string& folder, int width, int height);

}  // namespace tessera::workload

// A scene as flat arrays, in world space: what a loader fills and a frame reads. No pointers between parts, only
// indices.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"
#include "scene/camera.hpp"
#include "scene/light.hpp"
#include "scene/material.hpp"
#include "scene/texture.hpp"

namespace tessera {

/// One primitive of one node's mesh: a range of triangles.
struct Part {
  std::string node, mesh;
  std::uint32_t first_triangle = 0, triangle_count = 0;
  int binding = 0;
};

/// Bounding sphere of all triangles, world space.
struct Bounds {
  double center[3] = {0, 0, 0};
  double radius = 0;
  double min[3] = {0, 0, 0}, max[3] = {0, 0, 0};
};

struct Scene {
  AlignedVector<float> positions;              // xyz, stride 3; skins and morph targets applied
  AlignedVector<VertexAttributes> attributes;  // one per position
  AlignedVector<Triangle> triangles;           // mirrored nodes already turned round: counter-clockwise is front
  std::vector<Part> parts;
  std::vector<Material> materials;
  std::vector<MaterialBinding> bindings;  // Triangle::binding indexes this
  std::vector<Texture> textures;
  std::vector<SourceImage> images;  // unused ones are left empty (width 0)
  std::vector<Light> lights;
  std::vector<Camera> cameras;

  [[nodiscard]] GeometryView geometry() const {
    return {positions.data(), attributes.data(), triangles.data(), std::uint32_t(positions.size() / 3),
            std::uint32_t(triangles.size())};
  }
};

Bounds bounds_of(const Scene& scene);

}  // namespace tessera

#include "io/gltf_placement.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "io/gltf_build.hpp"

namespace tessera {

// The cofactor matrix is det(M) times the inverse transpose and exists where the inverse does not; normals want its
// direction only, but with the sign of the determinant taken out.
Placement Placement::of(const glm::dmat4& matrix) {
  Placement result;
  result.matrix = matrix;
  const glm::dvec3 x(matrix[0]);
  const glm::dvec3 y(matrix[1]);
  const glm::dvec3 z(matrix[2]);
  glm::dmat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  result.mirrored = glm::dot(x, cofactors[0]) < 0;
  result.normal_matrix = result.mirrored ? -cofactors : cofactors;
  return result;
}

std::vector<glm::dmat4> joint_matrices(GltfDocument& document, int index, const std::vector<glm::dmat4>& world) {
  const tinygltf::Skin& skin = document.model.skins[std::size_t(index)];
  std::vector<glm::dmat4> result;
  for (const int joint : skin.joints) result.push_back(world[std::size_t(joint)]);
  if (skin.inverseBindMatrices < 0) return result;
  const std::string part = fmt::format("skins[{}].inverseBindMatrices", index);
  const FloatArray inverse = read_floats(document, skin.inverseBindMatrices);
  if (inverse.components != 16 || inverse.integers) throw document.wrong(part, "are no MAT4 of floats");
  if (inverse.count() < result.size()) {
    throw document.wrong(part, "has {} matrices for {} joints", inverse.count(), result.size());
  }
  for (std::size_t j = 0; j < result.size(); ++j) {
    glm::dmat4 m;
    for (int i = 0; i < 16; ++i) {
      const float value = inverse.values[j * 16 + std::size_t(i)];
      if (!std::isfinite(value)) throw document.wrong(part, "matrix {} is not finite", j);
      m[i / 4][i % 4] = double(value);
    }
    // The last row must be 0 0 0 1; some exporters leave rounding there.
    m[0][3] = m[1][3] = m[2][3] = 0;
    m[3][3] = 1;
    result[j] = result[j] * m;
  }
  return result;
}

Placement skinned_placement(const GltfDocument& document, const GltfPrimitive& primitive, std::size_t vertex,
                            const std::vector<glm::dmat4>& joints) {
  glm::dmat4 blended(0.0);
  double total = 0;
  for (const auto& [indices, weights] : primitive.influences) {
    for (std::size_t k = vertex * 4; k < vertex * 4 + 4; ++k) {
      const double weight = double(weights->values[k]);
      if (weight == 0) continue;
      const double joint = double(indices->values[k]);
      if (!(joint >= 0 && joint < double(joints.size()))) {
        throw document.wrong(primitive.part + ".attributes.JOINTS_0", "vertex {} names joint {}: there are {}", vertex,
                             joint, joints.size());
      }
      blended += joints[std::size_t(joint)] * weight;
      total += weight;
    }
  }
  // Weights should sum to one, and often do not quite. None at all: the first joint carries the vertex.
  if (!(total > 0)) return Placement::of(joints.empty() ? glm::dmat4(1.0) : joints[0]);
  return Placement::of(blended * (1.0 / total));
}

std::vector<glm::dmat4> instance_matrices(GltfDocument& document, int node) {
  const auto* extension = extension_of(document.model.nodes[std::size_t(node)].extensions, "EXT_mesh_gpu_instancing");
  if (extension == nullptr) return {glm::dmat4(1.0)};
  const std::string part = node_name(node) + ".extensions.EXT_mesh_gpu_instancing";
  const tinygltf::Value& attributes = extension->Get("attributes");
  std::size_t count = 0;
  const auto read = [&](const char* name, int components) {
    FloatArray values;
    if (!attributes.Has(name)) return values;
    values = read_floats(document, attributes.Get(name).GetNumberAsInt());
    if (values.components != components) throw document.wrong(part, "{} has {} components", name, values.components);
    if (count != 0 && values.count() != count) throw document.wrong(part, "attributes differ in length");
    count = values.count();
    for (const float v : values.values) {
      if (!std::isfinite(v)) throw document.wrong(part, "{} is not finite", name);
    }
    return values;
  };
  const FloatArray translation = read("TRANSLATION", 3);
  const FloatArray rotation = read("ROTATION", 4);
  const FloatArray scale = read("SCALE", 3);
  std::vector<glm::dmat4> result(count, glm::dmat4(1.0));
  for (std::size_t i = 0; i < count; ++i) {
    glm::dmat4& m = result[i];
    if (!rotation.values.empty()) {
      const float* r = &rotation.values[i * 4];
      const glm::dquat q(r[3], r[0], r[1], r[2]);
      const double length = std::sqrt(glm::dot(q, q));
      if (!(length > 0)) throw document.wrong(part, "ROTATION {} is zero", i);
      m = glm::mat4_cast(q / length);
    }
    for (int c = 0; c < 3 && !scale.values.empty(); ++c) m[c] = m[c] * double(scale.values[i * 3 + std::size_t(c)]);
    for (int c = 0; c < 3 && !translation.values.empty(); ++c) {
      m[3][c] = double(translation.values[i * 3 + std::size_t(c)]);
    }
  }
  return result;
}

}  // namespace tessera

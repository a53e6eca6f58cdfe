// Where a primitive's vertices go in the world: by their node, or by the joints of a skin.
#pragma once
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

#include "io/gltf_primitive.hpp"

namespace tessera {

/// A vertex's matrix, with the form that carries normals: the cofactors, turned so that normals keep their side.
struct Placement {
  glm::dmat4 matrix{1.0};
  glm::dmat3 normal_matrix{1.0};
  bool mirrored = false;

  static Placement of(const glm::dmat4& matrix);
};

/// World matrix of every joint times its inverse bind matrix.
std::vector<glm::dmat4> joint_matrices(GltfDocument& document, int skin, const std::vector<glm::dmat4>& world);

/// The blended placement of one vertex. joints must outlast nothing; throws Error(input) for a joint that is not there.
Placement skinned_placement(const GltfDocument& document, const GltfPrimitive& primitive, std::size_t vertex,
                            const std::vector<glm::dmat4>& joints);

/// Instance matrices of EXT_mesh_gpu_instancing on a node; a single identity without it.
std::vector<glm::dmat4> instance_matrices(GltfDocument& document, int node);

}  // namespace tessera

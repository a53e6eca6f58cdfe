// The builders of a scene's parts from a checked document.
#pragma once
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "io/gltf_document.hpp"

namespace tessera {

/// World matrix of every node that the document's scene reaches.
std::vector<glm::dmat4> world_matrices(const GltfDocument& document);

/// Nodes of the scene in depth-first order: the order in which meshes are submitted.
std::vector<int> scene_order(const GltfDocument& document);

/// Scene materials by glTF index, made when first asked for together with the textures and samplers they use.
class MaterialBuilder {
 public:
  MaterialBuilder(GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}
  /// Index of a MaterialBinding; material -1: glTF's default one.
  int binding(int material, bool has_tangents, bool has_colors);
  /// Decodes the images that the textures use.
  void decode_images();

 private:
  int material(int index);
  Material read_material(int index);
  TextureSlot read_slot(const std::string& part, int texture, int uv_set, const tinygltf::ExtensionMap& extensions);
  int texture(int index);

  GltfDocument& document_;
  Scene& scene_;
  std::vector<int> materials_, textures_;  // scene index by glTF index, -1: not made yet
  int default_material_ = -1;
  std::map<std::tuple<int, bool, bool>, int> bindings_;
};

/// Appends the meshes of all nodes in scene order.
void build_meshes(GltfDocument& document, const std::vector<int>& order, const std::vector<glm::dmat4>& world,
                  MaterialBuilder& materials, Scene& scene);

void build_lights(GltfDocument& document, const std::vector<int>& order, const std::vector<glm::dmat4>& world,
                  Scene& scene);
void build_cameras(GltfDocument& document, const std::vector<int>& order, const std::vector<glm::dmat4>& world,
                   Scene& scene);

std::string node_name(int node);

}  // namespace tessera

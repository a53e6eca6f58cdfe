#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "io/gltf_build.hpp"

namespace tessera {
namespace {

glm::dmat4 local_matrix(const GltfDocument& document, int index) {
  const tinygltf::Node& node = document.model.nodes[std::size_t(index)];
  glm::dmat4 m(1.0);
  if (!node.matrix.empty()) {
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[std::size_t(i)];  // column-major, as GLM
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1) {
      throw document.wrong(node_name(index) + ".matrix", "is projective: its last row is not 0 0 0 1");
    }
    return m;
  }
  if (!node.rotation.empty()) {
    const auto& r = node.rotation;
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    if (!(length > 0) || !std::isfinite(length)) {
      throw document.wrong(node_name(index) + ".rotation", "is no rotation: its length is {}", length);
    }
    m = glm::mat4_cast(glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length));
  }
  if (!node.scale.empty()) {
    for (int i = 0; i < 3; ++i) m[i] = m[i] * node.scale[std::size_t(i)];
  }
  if (!node.translation.empty()) m[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
  return m;
}

}  // namespace

std::string node_name(int node) { return fmt::format("nodes[{}]", node); }

std::vector<glm::dmat4> world_matrices(const GltfDocument& document) {
  const std::size_t count = document.model.nodes.size();
  std::vector<glm::dmat4> world(count, glm::dmat4(1.0));
  std::vector<bool> done(count);
  std::vector<int> way;
  for (std::size_t i = 0; i < count; ++i) {
    // Unreached nodes are placeholders, and may hang together in loops.
    way.clear();
    for (int at = int(i); at >= 0 && !done[std::size_t(at)] && way.size() <= count;
         at = document.parent[std::size_t(at)]) {
      way.push_back(at);
    }
    for (; !way.empty(); way.pop_back()) {
      const int at = way.back();
      const int parent = document.parent[std::size_t(at)];
      const glm::dmat4 local = local_matrix(document, at);
      world[std::size_t(at)] = parent >= 0 ? world[std::size_t(parent)] * local : local;
      done[std::size_t(at)] = true;
    }
  }
  return world;
}

std::vector<int> scene_order(const GltfDocument& document) {
  std::vector<int> order;
  std::vector<int> stack(document.roots.rbegin(), document.roots.rend());
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    order.push_back(node);
    const auto& children = document.model.nodes[std::size_t(node)].children;
    stack.insert(stack.end(), children.rbegin(), children.rend());
  }
  return order;
}

}  // namespace tessera

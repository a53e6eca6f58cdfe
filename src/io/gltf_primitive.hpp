// One primitive's vertices and triangles, as the file has them: in the mesh's own space, checked, not yet placed.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf_accessor.hpp"

namespace tessera {

using SharedFloats = std::shared_ptr<const FloatArray>;

struct GltfPrimitive {
  std::string part;  // "meshes[1].primitives[0]", for messages
  int material = -1;
  std::size_t vertex_count = 0;
  std::vector<std::uint32_t> triangles;                           // three vertices each, all below vertex_count
  SharedFloats positions;                                         // xyz, finite
  SharedFloats normals, tangents, colors;                         // null where absent; finite
  std::array<SharedFloats, 2> uv;                                 // the same
  std::vector<std::pair<SharedFloats, SharedFloats>> influences;  // joints and weights, four of each per vertex
};

class PrimitiveReader {
 public:
  explicit PrimitiveReader(GltfDocument& document) : document_(document) {}

  /// Null when there is nothing to draw: points, lines, no positions (noted in the report). Each is read once.
  const GltfPrimitive* read(int mesh, int primitive);

  /// A copy with morph targets added by weight.
  GltfPrimitive morphed(const GltfPrimitive& base, int mesh, int primitive, const std::vector<double>& weights);

  /// Warnings on what was left out.
  void finish();

 private:
  SharedFloats attribute(const tinygltf::Primitive& in, const std::string& name, std::size_t count,
                         const std::string& part);
  SharedFloats floats(int accessor);
  std::unique_ptr<GltfPrimitive> make(int mesh, int primitive);
  SharedFloats checked(SharedFloats values, const std::string& name, const std::string& part);

  GltfDocument& document_;
  std::map<std::pair<int, int>, std::unique_ptr<GltfPrimitive>> known_;
  std::map<int, SharedFloats> accessors_;
  std::map<std::pair<std::string, int>, SharedFloats> attributes_;  // by what an accessor is used as
  std::map<int, int> skipped_;                                      // by mode
};

}  // namespace tessera

// Compressed geometry: EXT_meshopt_compression (buffer views) and KHR_draco_mesh_compression (primitives).
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/gltf_document.hpp"

namespace tessera {

/// The content of a buffer view compressed with meshoptimizer's codecs, filter undone. Throws Error(input).
std::vector<std::byte> decode_meshopt(GltfDocument& document, const tinygltf::Value& extension, int view);

struct DracoPrimitive {
  struct Attribute {
    int components = 0;
    std::vector<float> values;  // components per vertex; normalised integers already scaled
  };
  std::size_t vertex_count = 0;
  std::vector<std::uint32_t> indices;  // three per triangle
  std::map<std::string, Attribute> attributes;
};

/// A primitive compressed with Draco. Throws Error(input).
DracoPrimitive decode_draco(GltfDocument& document, const tinygltf::Value& extension, const std::string& part);

}  // namespace tessera

// The outermost layer of a glTF file: JSON text alone, or the binary container (GLB).
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace tessera {

struct GltfContainer {
  std::string_view json;
  std::span<const std::byte> binary;  // the BIN chunk
  bool has_binary = false;
};

/// Tells .glb from .gltf by content. The views point into bytes. Throws Error(input).
GltfContainer split_gltf(std::span<const std::byte> bytes, const std::string& file);

}  // namespace tessera

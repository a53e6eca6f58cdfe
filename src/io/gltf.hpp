// glTF 2.0 files into scenes.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace tessera {

/// What a file declares, for `tessera info` and for warnings.
struct GltfReport {
  std::string generator, version, copyright, default_scene;
  std::size_t nodes = 0, meshes = 0, primitives = 0, skipped_primitives = 0, animations = 0, skins = 0;
  std::vector<std::string> extensions_used, extensions_required, extensions_unsupported;
  std::vector<std::string> variants;  // KHR_materials_variants; the default materials are used
  std::vector<std::string> warnings;  // one clear line each
};

/// Reads .gltf or .glb (told apart by content) with everything it refers to. Throws Error(input) with file and part for
/// anything wrong: nothing in the file is trusted. Images that no reachable material uses are not decoded, and broken
/// unused parts are no error.
Scene load_gltf(const std::string& path, GltfReport* report = nullptr);

}  // namespace tessera

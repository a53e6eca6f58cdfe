// Reachability and validity of a glTF document, before tinygltf sees it.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tessera {

struct CheckedGltf {
  nlohmann::json json;      // what the scene reaches, known keys only; everything else is a placeholder or gone
  std::vector<int> roots;   // nodes of the scene drawn
  std::vector<int> parent;  // of each node, -1: none; right for every node that is reached
  std::string scene_name;
};

/// Follows every index from the default scene (scene 0; all root nodes if there are no scenes) through the schema's
/// table. Types, ranges and indices of all that is reached are right afterwards, and its nodes form trees. Throws
/// Error(input) that names file and JSON path. What is not reached is not looked at.
CheckedGltf check_gltf(const nlohmann::json& document, const std::string& file);

}  // namespace tessera

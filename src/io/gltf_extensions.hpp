// Which glTF extensions are supported, and what to say about the others.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "io/gltf.hpp"

namespace tessera {

/// Fills the report's lists of extensions and warns of those that are used and not supported. Throws Error(input) that
/// names the first unsupported one that is required.
void check_extensions(const nlohmann::json& document, const std::string& file, GltfReport& report);

}  // namespace tessera

#include "io/gltf_extensions.hpp"

#include <algorithm>
#include <string_view>

#include "base/error.hpp"

namespace tessera {
namespace {

constexpr std::string_view supported[] = {
    "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",         "EXT_texture_webp",    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",     "KHR_materials_emissive_strength", "KHR_materials_unlit", "KHR_materials_variants",
    "KHR_mesh_quantization",   "KHR_texture_transform",
};

// Extensions that hold nothing to draw.
constexpr std::string_view harmless[] = {
    "KHR_animation_pointer",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MSFT_packing_normalRoughnessMetallic",
    "MSFT_packing_occlusionRoughnessMetallic",
};

template <std::size_t N>
bool among(const std::string_view (&list)[N], const std::string& name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

std::vector<std::string> names(const nlohmann::json& document, const char* key, const std::string& file) {
  std::vector<std::string> result;
  const auto list = document.find(key);
  if (list == document.end()) return result;
  if (!list->is_array()) throw input_error("{}: {}: is {}, expected an array", file, key, list->type_name());
  for (const nlohmann::json& name : *list) {
    if (!name.is_string()) throw input_error("{}: {}: holds a {}, expected names", file, key, name.type_name());
    if (std::find(result.begin(), result.end(), name) == result.end()) result.push_back(name);
  }
  return result;
}

}  // namespace

void check_extensions(const nlohmann::json& document, const std::string& file, GltfReport& report) {
  report.extensions_used = names(document, "extensionsUsed", file);
  report.extensions_required = names(document, "extensionsRequired", file);
  for (const std::string& name : report.extensions_required) {
    if (!among(supported, name) && !among(harmless, name)) {
      throw input_error("{}: requires the extension {}, which is not supported", file, name);
    }
  }
  for (const std::string& name : report.extensions_used) {
    if (among(supported, name)) continue;
    report.extensions_unsupported.push_back(name);
    if (among(harmless, name)) continue;
    report.warnings.push_back(name.starts_with("KHR_materials_")
                                  ? name + " is not supported yet: the core material is rendered without it"
                                  : name + " is not supported: rendered without it");
  }
}

}  // namespace tessera

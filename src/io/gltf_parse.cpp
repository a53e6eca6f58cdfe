// From the bytes of a file to a checked GltfDocument. The order matters: tinygltf (2.7) replaces values of the wrong
// type by defaults, ignores indices that are out of range and loads whatever a URI names, so it is given only the part
// of the document that gltf_check has found sound, and neither buffers nor images.
#include <algorithm>
#include <limits>

#include "io/file_bytes.hpp"
#include "io/gltf_check.hpp"
#include "io/gltf_document.hpp"
#include "io/gltf_extensions.hpp"

namespace tessera {
namespace {

using nlohmann::json;

json parse_json(const GltfDocument& document) {
  try {
    json result = json::parse(document.container.json);
    if (!result.is_object()) throw input_error("{}: the JSON is no object", document.file);
    return result;
  } catch (const json::exception& e) {
    std::string reason = e.what();
    reason = reason.substr(reason.find("] ") == std::string::npos ? 0 : reason.find("] ") + 2);
    for (char& c : reason)
      if (static_cast<unsigned char>(c) < 32) c = ' ';
    throw input_error("{}: invalid JSON: {}", document.file, reason.substr(0, 200));
  }
}

std::string string_in(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void check_version(const json& root, GltfDocument& document) {
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object()) throw document.wrong("asset", "is missing: not a glTF 2.0 file");
  const std::string version = string_in(*asset, "version");
  if (!version.starts_with("2.")) throw document.wrong("asset.version", "is '{}', expected 2.0", version);
  const std::string least = string_in(*asset, "minVersion");
  if (!least.empty() && least != "2.0") throw document.wrong("asset.minVersion", "is '{}', expected 2.0", least);
  document.report.version = version;
  document.report.generator = string_in(*asset, "generator");
  document.report.copyright = string_in(*asset, "copyright");
}

void count_parts(const json& root, GltfReport& report) {
  const auto size = [&](const char* key) {
    const auto found = root.find(key);
    return found != root.end() && found->is_array() ? found->size() : 0;
  };
  report.nodes = size("nodes");
  report.meshes = size("meshes");
  report.animations = size("animations");
  report.skins = size("skins");
  const json::json_pointer variants("/extensions/KHR_materials_variants/variants");
  if (root.contains(variants) && root.at(variants).is_array()) {
    for (const json& variant : root.at(variants)) {
      if (variant.is_object()) report.variants.push_back(string_in(variant, "name"));
    }
  }
}

// Buffers and images stay ours.
void take_resources(json& checked, GltfDocument& document) {
  for (const json& in : checked.value("buffers", json::array())) {
    GltfBuffer& buffer = document.buffers.emplace_back();
    buffer.length = in.value("byteLength", std::uint64_t{0});
    if (in.contains("uri")) buffer.uri = in["uri"].get<std::string>();
  }
  for (const json& in : checked.value("images", json::array())) {
    GltfImage& image = document.images.emplace_back();
    image.name = in.value("name", "");
    image.uri = in.value("uri", "");
    image.mime_type = in.value("mimeType", "");
    image.buffer_view = in.value("bufferView", -1);
  }
  checked.erase("buffers");
  checked.erase("images");
}

// tinygltf's own conditions on what we take from it, so that it never has reason to refuse.
void check_for_parser(const json& checked, const GltfDocument& document) {
  static constexpr std::string_view types[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
  std::size_t i = 0;
  for (const json& accessor : checked.value("accessors", json::array())) {
    const std::string type = accessor["type"];
    if (std::find(std::begin(types), std::end(types), type) == std::end(types)) {
      throw document.wrong(fmt::format("accessors[{}].type", i), "is '{}', expected SCALAR, VEC2 ... MAT4", type);
    }
    if (accessor["componentType"] == 5124) {
      throw document.wrong(fmt::format("accessors[{}].componentType", i), "is 5124, which glTF does not have");
    }
    ++i;
  }
  i = 0;
  for (const json& view : checked.value("bufferViews", json::array())) {
    if (view.value("byteStride", 4) % 4 != 0) {
      throw document.wrong(fmt::format("bufferViews[{}].byteStride", i), "is {}, expected a multiple of 4",
                           view["byteStride"].get<int>());
    }
    ++i;
  }
}

// tinygltf refuses indices whose accessor has no buffer view, which is right for sparse and for Draco-compressed ones.
std::vector<std::size_t> lend_buffer_views(json& checked) {
  std::vector<std::size_t> without;
  if (!checked.contains("accessors")) return without;
  for (std::size_t i = 0; i < checked["accessors"].size(); ++i) {
    json& accessor = checked["accessors"][i];
    if (accessor.contains("bufferView")) continue;
    accessor["bufferView"] = 0;
    without.push_back(i);
  }
  if (!checked.contains("bufferViews")) checked["bufferViews"] = {{{"buffer", 0}, {"byteLength", 1}}};
  return without;
}

void parse_model(json& checked, GltfDocument& document) {
  const std::vector<std::size_t> without_view = lend_buffer_views(checked);
  const std::string text = checked.dump();
  if (text.size() > std::numeric_limits<unsigned>::max()) throw input_error("{}: JSON of 4 GiB or more", document.file);
  tinygltf::TinyGLTF parser;
  std::string errors;
  std::string warnings;
  if (!parser.LoadASCIIFromString(&document.model, &errors, &warnings, text.data(), unsigned(text.size()), "")) {
    std::replace(errors.begin(), errors.end(), '\n', ' ');
    throw input_error("{}: invalid glTF: {}", document.file, errors);
  }
  for (const std::size_t i : without_view) document.model.accessors[i].bufferView = -1;
}

}  // namespace

void GltfDocument::warn(const std::string& text) {
  constexpr std::size_t most = 200;
  auto& warnings = report.warnings;
  if (warnings.size() > most || std::find(warnings.begin(), warnings.end(), text) != warnings.end()) return;
  warnings.push_back(warnings.size() == most ? "further warnings are left out" : text);
}

std::unique_ptr<GltfDocument> parse_gltf(const std::string& path) {
  auto document = std::make_unique<GltfDocument>();
  document->file = path;
  document->bytes = read_file(path);
  document->container = split_gltf(document->bytes, path);
  const json root = parse_json(*document);
  check_version(root, *document);
  check_extensions(root, path, document->report);
  count_parts(root, document->report);

  CheckedGltf checked = check_gltf(root, path);
  document->roots = std::move(checked.roots);
  document->parent = std::move(checked.parent);
  document->report.default_scene = checked.scene_name;
  checked.json["asset"] = {{"version", "2.0"}};
  take_resources(checked.json, *document);
  check_for_parser(checked.json, *document);
  parse_model(checked.json, *document);
  document->decompressed.resize(document->model.bufferViews.size());
  return document;
}

const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() ? &found->second : nullptr;
}

double number_in(const tinygltf::Value& object, const char* key, double fallback) {
  return object.IsObject() && object.Has(key) ? object.Get(key).GetNumberAsDouble() : fallback;
}

}  // namespace tessera

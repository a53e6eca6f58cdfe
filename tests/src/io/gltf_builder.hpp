// Builds small glTF files: JSON that a test can edit before it is written, and one buffer.
#pragma once
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace tessera {

using nlohmann::json;

template <class T>
constexpr int gltf_component_type() {
  if constexpr (std::is_same_v<T, std::int8_t>) return 5120;
  if constexpr (std::is_same_v<T, std::uint8_t>) return 5121;
  if constexpr (std::is_same_v<T, std::int16_t>) return 5122;
  if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
  if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
  return 5126;
}

inline std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t bits = std::uint32_t(bytes[i]) << 16 | (left > 1 ? std::uint32_t(bytes[i + 1]) << 8 : 0) |
                               (left > 2 ? std::uint32_t(bytes[i + 2]) : 0);
    out += digits[bits >> 18];
    out += digits[bits >> 12 & 63];
    out += left > 1 ? digits[bits >> 6 & 63] : '=';
    out += left > 2 ? digits[bits & 63] : '=';
  }
  return out;
}

class GltfBuilder {
 public:
  json root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", json::array()}}}}};
  std::vector<std::uint8_t> buffer;

  /// Appends bytes; returns the index of a new buffer view.
  int view(const void* data, std::size_t size, int stride = 0) {
    while (buffer.size() % 4 != 0) buffer.push_back(0);
    json v = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", size}};
    if (stride != 0) v["byteStride"] = stride;
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    buffer.insert(buffer.end(), bytes, bytes + size);
    return push("bufferViews", v);
  }

  template <class T>
  int accessor(const std::vector<T>& values, const std::string& type, bool normalized = false) {
    const std::size_t components = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : std::size_t(type[3] - '0');
    json a = {{"bufferView", view(values.data(), values.size() * sizeof(T))},
              {"componentType", gltf_component_type<T>()},
              {"count", values.size() / components},
              {"type", type}};
    if (normalized) a["normalized"] = true;
    return push("accessors", a);
  }

  int push(const std::string& collection, const json& element) {
    root[collection].push_back(element);
    return int(root[collection].size()) - 1;
  }

  /// A mesh of one primitive.
  int mesh(const json& primitive) { return push("meshes", {{"primitives", {primitive}}}); }

  /// A node at the root of the scene.
  int node(const json& description) {
    const int index = push("nodes", description);
    root["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  /// (0,0,0) (1,0,0) (0,1,0): counter-clockwise seen from +Z.
  int triangle_positions() { return accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"); }

  /// A scene of one such triangle.
  static GltfBuilder triangle() {
    GltfBuilder b;
    const int positions = b.triangle_positions();
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
    return b;
  }

  /// A triangle with a texture coordinate and a textured material: edit root["materials"][0].
  static GltfBuilder textured(const std::vector<std::uint8_t>& image) {
    GltfBuilder b;
    const int positions = b.triangle_positions();
    const int uvs = b.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    b.push("images", {{"bufferView", b.view(image.data(), image.size())}, {"mimeType", "image/png"}});
    b.push("textures", {{"source", 0}});
    b.push("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"material", 0}})}});
    return b;
  }

  json& primitive() { return root["meshes"][0]["primitives"][0]; }

  /// .gltf with the buffer as a data URI.
  [[nodiscard]] std::string gltf() const {
    json copy = root;
    if (!copy.contains("buffers") && !buffer.empty()) {
      copy["buffers"] = {
          {{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
    }
    return copy.dump();
  }

  /// .glb with the buffer as its binary chunk.
  [[nodiscard]] std::string glb() const {
    json copy = root;
    if (!copy.contains("buffers")) copy["buffers"] = {{{"byteLength", buffer.size()}}};
    std::string text = copy.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::string binary(buffer.begin(), buffer.end());
    while (binary.size() % 4 != 0) binary += '\0';
    std::string out = "glTF" + word(2) + word(28 + text.size() + binary.size());
    out += word(text.size()) + "JSON" + text;
    out += word(binary.size()) + std::string("BIN\0", 4) + binary;
    return out;
  }

  static std::string word(std::size_t value) {
    std::string out;
    for (int i = 0; i < 4; ++i) out += char(value >> (8 * i) & 255);
    return out;
  }
};

inline std::string write_file(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

}  // namespace tessera

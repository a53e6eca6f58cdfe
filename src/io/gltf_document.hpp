// A parsed glTF file whose reachable part has been checked: what the builders of a scene read.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "base/error.hpp"
#include "io/gltf.hpp"
#include "io/gltf_container.hpp"

namespace tessera {

struct GltfBuffer {
  std::optional<std::string> uri;
  std::uint64_t length = 0;
  std::vector<std::byte> bytes;  // filled when first used, unless it is the GLB's binary chunk
  bool loaded = false;
};

struct GltfImage {
  std::string name, uri, mime_type;
  int buffer_view = -1;
};

struct GltfDocument {
  std::string file;
  std::vector<std::byte> bytes;  // of the file
  GltfContainer container;       // views into bytes
  tinygltf::Model model;         // indices and types are right; unreached elements are placeholders
  std::vector<GltfBuffer> buffers;
  std::vector<GltfImage> images;
  std::vector<int> roots, parent;                                   // of nodes
  std::vector<std::optional<std::vector<std::byte>>> decompressed;  // per buffer view: EXT_meshopt_compression
  GltfReport report;

  template <class... Args>
  [[nodiscard]] Error wrong(const std::string& part, fmt::format_string<Args...> format, Args&&... args) const {
    return input_error("{}: {}: {}", file, part, fmt::format(format, std::forward<Args>(args)...));
  }
  /// Notes a warning, once; of very many, the first ones.
  void warn(const std::string& text);
};

/// Reads and checks everything but geometry and pixels. Throws Error(input).
std::unique_ptr<GltfDocument> parse_gltf(const std::string& path);

/// The bytes of a range of a buffer, which is loaded if need be. part names what asks, for messages.
std::span<const std::byte> buffer_range(GltfDocument& document, int buffer, std::uint64_t offset, std::uint64_t length,
                                        const std::string& part);

/// The bytes of a buffer view, decompressed if need be.
std::span<const std::byte> buffer_view_bytes(GltfDocument& document, int view);

/// What a URI names: a data URI's content, or a file relative to the glTF file. part names what asks, for messages.
std::vector<std::byte> read_uri(const std::string& uri, const std::string& gltf_file, const std::string& part);

/// The file that a relative URI names, percent-decoded; for messages, too.
bool is_data_uri(const std::string& uri);
std::string uri_path(const std::string& uri, const std::string& gltf_file, const std::string& part);

/// An extension's object on a glTF object, or null; and numbers in it.
const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const char* name);
double number_in(const tinygltf::Value& object, const char* key, double fallback);

}  // namespace tessera

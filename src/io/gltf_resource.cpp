// Buffers and URIs: where the bytes of a glTF file come from.
#include <array>
#include <filesystem>

#include "io/file_bytes.hpp"
#include "io/gltf_compression.hpp"
#include "io/gltf_document.hpp"

namespace tessera {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// RFC 3986, section 2.1. A '%' that starts no escape stays: such names are met in practice.
std::string percent_decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
      out.push_back(char(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])));
      i += 2;
    } else {
      out.push_back(text[i]);
    }
  }
  return out;
}

// RFC 4648, section 4; the padding may be missing.
std::vector<std::byte> base64_decoded(std::string_view text, const std::string& file, const std::string& part) {
  static const auto values = [] {
    std::array<std::int16_t, 256> table{};
    table.fill(-1);
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i)
      table[static_cast<unsigned char>(digits[i])] = static_cast<std::int16_t>(i);
    return table;
  }();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::vector<std::byte> out;
  out.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int value = values[static_cast<unsigned char>(text[i])];
    if (value < 0) throw input_error("{}: {}: data URI has an invalid base64 character at {}", file, part, i);
    bits = bits << 6 | std::uint32_t(value);
    held += 6;
    if (held >= 8) {
      held -= 8;
      out.push_back(std::byte(bits >> held & 255));
    }
  }
  if (held == 6) throw input_error("{}: {}: data URI's base64 is truncated", file, part);
  return out;
}

std::string shortened(const std::string& uri) { return uri.size() <= 80 ? uri : uri.substr(0, 77) + "..."; }

}  // namespace

bool is_data_uri(const std::string& uri) { return uri.starts_with("data:"); }

std::string uri_path(const std::string& uri, const std::string& gltf_file, const std::string& part) {
  namespace fs = std::filesystem;
  const std::string name = percent_decoded(uri);
  const std::size_t colon = uri.find(':');
  const bool scheme = colon != std::string::npos && colon < uri.find('/');
  if (scheme || name.starts_with('/') || name.starts_with('\\') || name.find('\0') != std::string::npos ||
      name.empty()) {
    throw input_error("{}: {}: URI '{}', expected a relative path or data", gltf_file, part, shortened(uri));
  }
  return (fs::path(gltf_file).parent_path() / name).string();
}

std::vector<std::byte> read_uri(const std::string& uri, const std::string& gltf_file, const std::string& part) {
  namespace fs = std::filesystem;
  if (is_data_uri(uri)) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos) throw input_error("{}: {}: data URI without a comma", gltf_file, part);
    const std::string_view head = std::string_view(uri).substr(0, comma);
    const std::string_view content = std::string_view(uri).substr(comma + 1);
    if (head.ends_with(";base64")) return base64_decoded(content, gltf_file, part);
    const std::string plain = percent_decoded(content);
    const auto* first = reinterpret_cast<const std::byte*>(plain.data());
    return {first, first + plain.size()};
  }
  const std::string path = uri_path(uri, gltf_file, part);
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {
    throw input_error("{}: {}: {} is no regular file", gltf_file, part, path);
  }
  try {
    return read_file(path);
  } catch (const Error& e) {
    throw input_error("{}: {}: {}", gltf_file, part, e.what());
  }
}

std::span<const std::byte> buffer_range(GltfDocument& document, int index, std::uint64_t offset, std::uint64_t length,
                                        const std::string& part) {
  GltfBuffer& buffer = document.buffers[std::size_t(index)];
  const std::string name = fmt::format("buffers[{}]", index);
  if (offset > buffer.length || length > buffer.length - offset) {
    throw document.wrong(part, "bytes {} to {} are beyond the end of {}, which has {}", offset, offset + length, name,
                         buffer.length);
  }
  const bool in_container = index == 0 && !buffer.uri && document.container.has_binary;
  if (!in_container && !buffer.loaded) {
    if (!buffer.uri) throw document.wrong(name, "has no URI, and the file has no binary chunk");
    buffer.bytes = read_uri(*buffer.uri, document.file, name);
    buffer.loaded = true;
  }
  const std::span<const std::byte> bytes = in_container ? document.container.binary : buffer.bytes;
  if (buffer.length > bytes.size()) {
    throw document.wrong(name, "byteLength is {}, only {} bytes are there", buffer.length, bytes.size());
  }
  return bytes.subspan(std::size_t(offset), std::size_t(length));
}

std::span<const std::byte> buffer_view_bytes(GltfDocument& document, int index) {
  const tinygltf::BufferView& view = document.model.bufferViews[std::size_t(index)];
  auto& decompressed = document.decompressed[std::size_t(index)];
  if (const tinygltf::Value* meshopt = extension_of(view.extensions, "EXT_meshopt_compression")) {
    if (!decompressed) decompressed = decode_meshopt(document, *meshopt, index);
    return *decompressed;
  }
  return buffer_range(document, view.buffer, view.byteOffset, view.byteLength, fmt::format("bufferViews[{}]", index));
}

}  // namespace tessera

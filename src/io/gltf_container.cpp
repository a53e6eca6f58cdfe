#include "io/gltf_container.hpp"

#include <bit>
#include <cstdint>
#include <cstring>

#include "base/error.hpp"

namespace tessera {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

std::uint32_t word(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

std::string_view text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

constexpr std::uint32_t chunk_json = 0x4e4f534a;
constexpr std::uint32_t chunk_bin = 0x004e4942;

// glTF 2.0, section 4: GLB File Format Specification.
GltfContainer split_glb(std::span<const std::byte> bytes, const std::string& file) {
  if (bytes.size() < 12) throw input_error("{}: GLB header is truncated at {} bytes, expected 12", file, bytes.size());
  const std::uint32_t version = word(bytes, 4);
  const std::uint32_t length = word(bytes, 8);
  if (version != 2) throw input_error("{}: GLB container version {}, expected 2", file, version);
  if (length > bytes.size()) {
    throw input_error("{}: truncated: GLB header states {} bytes, the file has {}", file, length, bytes.size());
  }
  if (length < 20) throw input_error("{}: GLB header states {} bytes, too few for a JSON chunk", file, length);

  GltfContainer result;
  int number = 0;
  for (std::size_t at = 12; at < length; ++number) {
    if (length - at < 8) throw input_error("{}: GLB chunk {} has a truncated header", file, number);
    const std::uint32_t size = word(bytes, at);
    const std::uint32_t type = word(bytes, at + 4);
    at += 8;
    if (size > length - at) {
      throw input_error("{}: GLB chunk {} states {} bytes, only {} are left", file, number, size, length - at);
    }
    const auto content = bytes.subspan(at, size);
    if (number == 0) {
      if (type != chunk_json) throw input_error("{}: first GLB chunk has type {:#x}, expected JSON", file, type);
      result.json = text(content);
    } else if (type == chunk_bin && !result.has_binary) {
      result.binary = content;
      result.has_binary = true;
    }
    at += size;
  }
  return result;
}

}  // namespace

GltfContainer split_gltf(std::span<const std::byte> bytes, const std::string& file) {
  if (bytes.empty()) throw input_error("{}: the file is empty, expected glTF", file);
  if (text(bytes).starts_with("glTF")) return split_glb(bytes, file);
  std::string_view json = text(bytes);
  if (json.starts_with("\xef\xbb\xbf")) json.remove_prefix(3);
  const std::size_t start = json.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || json[start] != '{') {
    throw input_error("{}: neither GLB (no 'glTF' at its start) nor JSON (no '{{'): not a glTF file", file);
  }
  return {json, {}, false};
}

}  // namespace tessera

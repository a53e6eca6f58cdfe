// EXT_meshopt_compression. The codecs are meshoptimizer's; the filters are written here, because the library's vector
// forms of them need not round alike on every machine.
#include <meshoptimizer.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "io/gltf_compression.hpp"

namespace tessera {
namespace {

std::string string_in(const tinygltf::Value& object, const char* key) {
  return object.Has(key) ? object.Get(key).Get<std::string>() : std::string();
}

int rounded(float value) { return int(value + (value >= 0.0f ? 0.5f : -0.5f)); }

// Appendix B, filter 1: x and y octahedral, z holds the value that stands for one.
template <class T>
void unfilter_octahedral(std::vector<std::byte>& bytes) {
  constexpr float largest = sizeof(T) == 1 ? 127.0f : 32767.0f;
  for (std::size_t at = 0; at + 4 * sizeof(T) <= bytes.size(); at += 4 * sizeof(T)) {
    T v[4];
    std::memcpy(v, &bytes[at], sizeof(v));
    float x = v[0];
    float y = v[1];
    const float z = float(v[2]) - std::fabs(x) - std::fabs(y);
    const float fold = z >= 0.0f ? 0.0f : z;
    x += x >= 0.0f ? fold : -fold;
    y += y >= 0.0f ? fold : -fold;
    const float length = std::sqrt(x * x + y * y + z * z);
    const float scale = length > 0.0f ? largest / length : 0.0f;
    v[0] = T(rounded(x * scale));
    v[1] = T(rounded(y * scale));
    v[2] = T(rounded(z * scale));
    std::memcpy(&bytes[at], v, sizeof(v));
  }
}

// Filter 2: the three smallest components of a unit quaternion.
void unfilter_quaternion(std::vector<std::byte>& bytes) {
  const float root_half = 1.0f / std::sqrt(2.0f);
  for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
    std::int16_t v[4];
    std::memcpy(v, &bytes[at], sizeof(v));
    const float scale = root_half / float(v[3] | 3);
    const float x = float(v[0]) * scale;
    const float y = float(v[1]) * scale;
    const float z = float(v[2]) * scale;
    const float rest = 1.0f - x * x - y * y - z * z;
    const float w = std::sqrt(rest >= 0.0f ? rest : 0.0f);
    const int largest = v[3] & 3;
    std::int16_t out[4];
    out[(largest + 1) & 3] = std::int16_t(rounded(x * 32767.0f));
    out[(largest + 2) & 3] = std::int16_t(rounded(y * 32767.0f));
    out[(largest + 3) & 3] = std::int16_t(rounded(z * 32767.0f));
    out[largest] = std::int16_t(rounded(w * 32767.0f));
    std::memcpy(&bytes[at], out, sizeof(out));
  }
}

// Filter 3: eight bits of exponent, 24 of mantissa.
void unfilter_exponential(std::vector<std::byte>& bytes) {
  for (std::size_t at = 0; at + 4 <= bytes.size(); at += 4) {
    std::int32_t v = 0;
    std::memcpy(&v, &bytes[at], 4);
    const int exponent = v >> 24;
    const auto mantissa = std::int32_t(std::uint32_t(v) << 8) >> 8;
    const auto value = float(std::ldexp(double(mantissa), exponent));
    std::memcpy(&bytes[at], &value, 4);
  }
}

}  // namespace

std::vector<std::byte> decode_meshopt(GltfDocument& document, const tinygltf::Value& extension, int view) {
  const std::string part = fmt::format("bufferViews[{}].extensions.EXT_meshopt_compression", view);
  const auto count = std::uint64_t(number_in(extension, "count", 0));
  const auto stride = std::uint64_t(number_in(extension, "byteStride", 0));
  const auto length = std::uint64_t(number_in(extension, "byteLength", 0));
  const std::string mode = string_in(extension, "mode");
  const std::string filter = extension.Has("filter") ? string_in(extension, "filter") : "NONE";
  const auto in = buffer_range(document, int(number_in(extension, "buffer", 0)),
                               std::uint64_t(number_in(extension, "byteOffset", 0)), length, part);
  const auto* data = reinterpret_cast<const unsigned char*>(in.data());

  // The best case is a block of 256 equal vertices: 4 bytes of headers for 256 bytes of each byte of the stride.
  if (count * stride / 128 > length + 1024) {
    throw document.wrong(part, "{} bytes cannot hold {} elements of {} bytes", length, count, stride);
  }
  std::vector<std::byte> out(std::size_t(count * stride));
  int status = 0;
  if (mode == "ATTRIBUTES") {
    if (stride % 4 != 0) throw document.wrong(part + ".byteStride", "is {}, expected a multiple of 4", stride);
    status = meshopt_decodeVertexBuffer(out.data(), count, stride, data, in.size());
  } else if (mode == "TRIANGLES" || mode == "INDICES") {
    if (stride != 2 && stride != 4) throw document.wrong(part + ".byteStride", "is {}, expected 2 or 4", stride);
    if (mode == "INDICES") {
      status = meshopt_decodeIndexSequence(out.data(), count, stride, data, in.size());
    } else {
      if (count % 3 != 0) throw document.wrong(part + ".count", "is {}, expected a multiple of 3", count);
      status = meshopt_decodeIndexBuffer(out.data(), count, stride, data, in.size());
    }
  } else {
    throw document.wrong(part + ".mode", "is '{}', expected ATTRIBUTES, TRIANGLES or INDICES", mode);
  }
  if (status != 0) throw document.wrong(part, "the compressed data are damaged (meshoptimizer's code {})", status);

  const bool known = filter == "NONE" || filter == "OCTAHEDRAL" || filter == "QUATERNION" || filter == "EXPONENTIAL";
  const bool fits =
      filter == "NONE" || (mode == "ATTRIBUTES" && (filter != "OCTAHEDRAL" || stride == 4 || stride == 8) &&
                           (filter != "QUATERNION" || stride == 8));
  if (!known || !fits) throw document.wrong(part + ".filter", "is '{}' for mode {}, stride {}", filter, mode, stride);
  if (filter == "OCTAHEDRAL" && stride == 4) unfilter_octahedral<std::int8_t>(out);
  if (filter == "OCTAHEDRAL" && stride == 8) unfilter_octahedral<std::int16_t>(out);
  if (filter == "QUATERNION") unfilter_quaternion(out);
  if (filter == "EXPONENTIAL") unfilter_exponential(out);
  return out;
}

}  // namespace tessera

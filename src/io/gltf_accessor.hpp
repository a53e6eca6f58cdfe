// Accessors: typed arrays inside buffers.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "io/gltf_document.hpp"

namespace tessera {

/// Values as floats, `components` per element; normalised integers become [0,1] or [-1,1]. Sparse substitution is
/// applied.
struct FloatArray {
  int components = 0;
  bool normalized = false;  // was an integer meant to be a fraction
  bool integers = false;    // was any integer
  std::vector<float> values;

  [[nodiscard]] std::size_t count() const { return values.size() / std::size_t(components); }
};
FloatArray read_floats(GltfDocument& document, int accessor);

/// Values of unsigned integer accessors (indices, joints).
struct IntegerArray {
  int components = 0;
  std::vector<std::uint32_t> values;

  [[nodiscard]] std::size_t count() const { return values.size() / std::size_t(components); }
};
IntegerArray read_integers(GltfDocument& document, int accessor);

std::string accessor_name(int accessor);

}  // namespace tessera

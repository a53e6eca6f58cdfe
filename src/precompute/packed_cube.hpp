// A cubemap in half the memory: one 32-bit word a texel.
#pragma once
#include "precompute/cube.hpp"

namespace tessera {

/// A cube whose texels are CubeFormat::rgb9_e5.
class PackedCube {
 public:
  PackedCube() = default;
  /// Every texel rounded to the nearest that the format holds, within 1/511 of its largest channel. On all threads.
  explicit PackedCube(const Cube& cube, const Kernels& kernels);
  [[nodiscard]] CubeView view() const { return {texels_.data(), size_, levels_, CubeFormat::rgb9_e5}; }
  [[nodiscard]] std::size_t bytes() const { return texels_.size() * sizeof(std::uint16_t); }

 private:
  AlignedVector<std::uint16_t> texels_;
  int size_ = 0, levels_ = 0;
};

}  // namespace tessera

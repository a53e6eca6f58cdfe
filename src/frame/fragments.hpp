// The fragments of one tile on their way from visibility to picture: G-buffer and radiance in SoA planes that one
// thread keeps and reuses, so that the tile stays in its core's cache.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera {

/// Where a tile stands in the picture.
struct TileRect {
  int x, y, width, height;
};

class TileFragments {
 public:
  /// Sorted for compositing: pixels ascending; in a pixel front to back, or, where none is transparent, by triangle.
  ScratchVector<Fragment> fragments;
  /// slots[i]: where fragments[i] lies in the planes; not looked at if in_order.
  ScratchVector<std::uint32_t> slots;
  bool in_order = false;  // fragments[i] lies in slot i
  bool whole = false;     // in order, one fragment for every pixel of the tile, opaque, that covers all samples: their
                          // pixels are in the film, and no radiance in the planes

  [[nodiscard]] std::uint32_t slot(std::size_t i) const { return in_order ? static_cast<std::uint32_t>(i) : slots[i]; }
  void clear() {
    fragments.clear();
    slots.clear();
    in_order = whole = false;
  }

  ScratchVector<std::uint32_t> reached;  // lights that reach a run

  /// Room for `count` slots in every plane; keeps no content when it grows.
  void reserve_planes(std::uint32_t count);
  /// The planes from slot `first` on.
  [[nodiscard]] GBufferView gbuffer(std::uint32_t first = 0) const;
  [[nodiscard]] std::array<float*, 3> radiance(std::uint32_t first = 0) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] float* plane(int k, std::uint32_t first) const {
    return const_cast<float*>(planes_.data()) + k * stride_ + first;
  }
  AlignedVector<float> planes_;
  std::size_t stride_ = 0;
};

inline std::uint32_t round_up_to_lanes(std::uint32_t n) { return (n + max_lanes - 1) / max_lanes * max_lanes; }

}  // namespace tessera

// The order in which a tile's fragments are composited, where some are transparent.
#pragma once
#include <array>
#include <cstdint>

#include "base/aligned.hpp"
#include "frame/fragments.hpp"

namespace tessera {

class FragmentSorter {
 public:
  /// Sorts fragments and their slots as TileFragments::fragments has it. Those before `opaque_count` are opaque and so
  /// sorted already, the others transparent and in any order; the planes hold their depths.
  void sort(TileFragments& tile, std::size_t opaque_count);
  [[nodiscard]] std::size_t bytes() const {
    return sorted_.capacity() * sizeof(Fragment) + sorted_slots_.capacity() * sizeof(std::uint32_t) +
           keys_.capacity() * sizeof(Key);
  }

 private:
  struct Key {
    float depth;
    std::uint32_t triangle;
    std::uint32_t index;  // in fragments
  };
  void sort_pixel(const TileFragments& tile, std::uint32_t begin, std::uint32_t end);

  std::array<std::uint32_t, tile_pixels + 1> next_{};  // of each pixel's fragments: where the next one goes
  std::array<bool, tile_pixels> transparent_{};
  ScratchVector<Key> keys_;
  ScratchVector<Fragment> sorted_;
  ScratchVector<std::uint32_t> sorted_slots_;
};

}  // namespace tessera

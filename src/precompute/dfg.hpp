// The environment BRDF as a table over (n.v, perceptual roughness).
#pragma once
#include <algorithm>
#include <cstddef>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera {

/// size x size pairs -> DfgView::texels.
inline AlignedVector<float> with_border(const float* pairs, int size) {
  const int pitch = dfg_pitch(size);
  AlignedVector<float> texels(std::size_t(pitch) * std::size_t(pitch) * 2);
  for (int j = 0; j < pitch; ++j)
    for (int i = 0; i < pitch; ++i) {
      const int row = std::clamp(j - 1, 0, size - 1), column = std::clamp(i - 1, 0, size - 1);
      std::copy_n(pairs + std::size_t(row * size + column) * 2, 2, texels.data() + std::size_t(j * pitch + i) * 2);
    }
  return texels;
}

struct DfgTable {
  AlignedVector<float> texels;  // as DfgView has them
  int size = 0;
  bool warped = false;

  [[nodiscard]] DfgView view() const { return {texels.data(), size, warped}; }
  /// The pair at column i of row j.
  [[nodiscard]] const float* node(int i, int j) const {
    return texels.data() + std::size_t((j + 1) * dfg_pitch(size) + i + 1) * 2;
  }
};

/// size >= 2. At 128 the nodes are within 1e-5 of the integral. Elsewhere the linear axes are the limit: at most 2e-4
/// (mean 2e-5) for n.v and r from 0.1 up, 4e-3 beyond the last node (r > 0.996), 2e-2 below 0.02, and 8e-2 at r < 0.03
/// where n.v < 0.002 is off the table.
DfgTable build_dfg_table(const Kernels& kernels, int size = 128);

/// The same on warped axes: at 128 within 1e-4 everywhere, between the nodes too. What the renderer uses.
DfgTable build_warped_dfg_table(const Kernels& kernels, int size = 128);

}  // namespace tessera

// The environment BRDF as a table over (n.v, perceptual roughness).
#pragma once
#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera {

struct DfgTable {
  AlignedVector<float> texels;  // DfgView's layout
  int size = 0;
  bool warped = false;

  [[nodiscard]] DfgView view() const { return {texels.data(), size, warped}; }
};

/// size >= 2. At 128 the nodes are within 1e-5 of the integral. Elsewhere the linear axes are the limit: at most 2e-4
/// (mean 2e-5) for n.v and r from 0.1 up, 4e-3 beyond the last node (r > 0.996), 2e-2 below 0.02, and 8e-2 at r < 0.03
/// where n.v < 0.002 is off the table.
DfgTable build_dfg_table(const Kernels& kernels, int size = 128);

/// The same on warped axes: at 128 within 1e-4 everywhere, between the nodes too. What the renderer uses.
DfgTable build_warped_dfg_table(const Kernels& kernels, int size = 128);

}  // namespace tessera

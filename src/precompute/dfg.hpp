// The environment BRDF as a table over (n.v, perceptual roughness).
#pragma once
#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera {

struct DfgTable {
  AlignedVector<float> texels;  // DfgView's layout
  int size = 0;

  [[nodiscard]] DfgView view() const { return {texels.data(), size}; }
};

/// size >= 2. Nodes are within 1e-5 of the integral. Between nodes the linear axes are the limit: within 1e-3 for
/// n.v >= 0.1 and r >= 0.1, worse towards n.v = 0 at low roughness (tests/src/precompute/dfg_test.cpp has the figures).
DfgTable build_dfg_table(const Kernels& kernels, int size = 128);

}  // namespace tessera

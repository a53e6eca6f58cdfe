// Tables of the environment BRDF in the layouts that kernels/light/dfg_lookup.hpp reads: for charts, and to choose the
// renderer's own by.
#pragma once
#include <cstddef>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera {

enum class DfgAxes { linear, root, warped };
enum class DfgFormat { float32, half, unorm16 };

struct DfgVariant {
  AlignedVector<float> words;  // TermArgs::table
  int size = 0;
  std::size_t bytes = 0;
};

/// size >= 2. Balanced: nodes are moved by a sixteenth of the second differences, so that a bilinear lookup errs as
/// much to one side at the nodes as to the other between them: half as much in all. For bilinear lookup only.
DfgVariant build_dfg_variant(const Kernels& kernels, DfgAxes axes, DfgFormat format, int size, bool balanced = false);

}  // namespace tessera

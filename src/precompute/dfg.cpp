#include "precompute/dfg.hpp"

#include "base/parallel.hpp"
#include "precompute/dfg_variants.hpp"

namespace tessera {

DfgTable build_dfg_table(const Kernels& kernels, int size) {
  AlignedVector<float> pairs(std::size_t(size) * std::size_t(size) * 2);
  parallel_for(std::size_t(size), [&](std::size_t row) {
    kernels.dfg_table({pairs.data(), size, int(row), int(row) + 1});
  });
  return {with_border(pairs.data(), size), size, false};
}

DfgTable build_warped_dfg_table(const Kernels& kernels, int size) {
  const DfgVariant nodes = build_dfg_variant(kernels, DfgAxes::warped, DfgFormat::float32, size, true);
  return {with_border(nodes.words.data(), size), size, true};
}

}  // namespace tessera

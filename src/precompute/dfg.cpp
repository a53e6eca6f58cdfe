#include "precompute/dfg.hpp"

#include <cstddef>

#include "base/parallel.hpp"
#include "precompute/dfg_variants.hpp"

namespace tessera {

AlignedVector<float> dfg_pairs(const Kernels& kernels, int size) {
  AlignedVector<float> pairs(std::size_t(size) * std::size_t(size) * 2);
  parallel_for(std::size_t(size), [&](std::size_t row) {
    kernels.dfg_table({pairs.data(), size, int(row), int(row) + 1});
  });
  return pairs;
}

DfgTable build_dfg_table(const Kernels& kernels, int size) { return {dfg_pairs(kernels, size).data(), size}; }

DfgTable build_warped_dfg_table(const Kernels& kernels, int size) {
  const DfgVariant nodes = build_dfg_variant(kernels, DfgAxes::warped, DfgFormat::float32, size, true);
  return {nodes.words.data(), size, true};
}

}  // namespace tessera

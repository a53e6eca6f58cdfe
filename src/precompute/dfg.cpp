#include "precompute/dfg.hpp"

#include "base/parallel.hpp"
#include "precompute/dfg_variants.hpp"

namespace tessera {

DfgTable build_dfg_table(const Kernels& kernels, int size) {
  DfgTable table;
  table.size = size;
  table.texels.resize(std::size_t(size) * std::size_t(size) * 2);
  parallel_for(std::size_t(size), [&](std::size_t row) {
    kernels.dfg_table({table.texels.data(), size, int(row), int(row) + 1});
  });
  return table;
}

DfgTable build_warped_dfg_table(const Kernels& kernels, int size) {
  DfgTable table;
  table.texels = build_dfg_variant(kernels, DfgAxes::warped, DfgFormat::float32, size, true).words;
  table.size = size;
  table.warped = true;
  return table;
}

}  // namespace tessera

#include "precompute/dfg.hpp"

#include "base/parallel.hpp"

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

}  // namespace tessera

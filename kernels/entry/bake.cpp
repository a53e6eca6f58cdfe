#include "kernels/entry/entries.hpp"

namespace tessera::TESSERA_ISA {
void dfg_table(const DfgTableArgs&) { __builtin_trap(); }
void equirect_to_cube(const CubeFaceArgs&) { __builtin_trap(); }
void prefilter_cube(const CubeFaceArgs&) { __builtin_trap(); }
}  // namespace tessera::TESSERA_ISA

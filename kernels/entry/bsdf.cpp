#include "kernels/entry/entries.hpp"

namespace tessera::TESSERA_ISA {
void evaluate_bsdf(const BsdfTermArgs&) { __builtin_trap(); }
}  // namespace tessera::TESSERA_ISA

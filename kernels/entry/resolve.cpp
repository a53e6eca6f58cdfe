#include "kernels/entry/entries.hpp"

namespace tessera::TESSERA_ISA {
void resolve(const ResolveArgs&) { __builtin_trap(); }
void resolve_alpha(const ResolveAlphaArgs&) { __builtin_trap(); }
}  // namespace tessera::TESSERA_ISA

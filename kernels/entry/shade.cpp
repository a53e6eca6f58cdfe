#include "kernels/entry/entries.hpp"

namespace tessera::TESSERA_ISA {
void shade(const ShadeArgs&) { __builtin_trap(); }
void background(const BackgroundArgs&) { __builtin_trap(); }
}  // namespace tessera::TESSERA_ISA

// The renderer's kernels once more, from the same sources, compiled as GCC does by default: a * b + c may become one
// fused multiply-add wherever the compiler likes. What they draw differs from machine to machine; they exist to be
// timed against the kernels that do not (cmake/bench.cmake).
#pragma once
#include "kernels/interface.hpp"

namespace tessera::determinism {

/// `kernels` with everything that draws a frame taken from the contracted build. Only for instruction sets with a fused
/// multiply-add: `can_contract`.
Kernels contracted(const Kernels& kernels);
bool can_contract(const Kernels& kernels);

}  // namespace tessera::determinism

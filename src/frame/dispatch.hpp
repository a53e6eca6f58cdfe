// Which instruction set runs.
#pragma once
#include <string_view>
#include <vector>

#include "kernels/interface.hpp"

namespace tessera {

/// Every table of this build, narrowest first.
std::vector<const Kernels*> built_kernels();
/// Whether this CPU (and operating system) runs them.
bool cpu_runs(const Kernels& kernels);
/// The widest that this CPU runs; or the one named ("" and "auto": the environment variable TESSERA_ISA, then the
/// widest). Throws Error(usage) for a name that is not built or that this CPU lacks.
const Kernels& select_kernels(std::string_view name = {});

}  // namespace tessera

// The instruction sets whose kernels this CPU can run: every kernel test loops over them. (src/frame/dispatch answers
// the same, but kernel tests link the kernels alone.)
#pragma once
#include <cstring>
#include <vector>

#include "kernels/interface.hpp"

namespace tessera {

inline std::vector<const Kernels*> runnable_kernels() {
  std::vector<const Kernels*> tables;
  for (const Kernels* const* table = kernel_tables; *table != nullptr; ++table) {
#if defined(__x86_64__)
    __builtin_cpu_init();
    const char* isa = (*table)->isa;
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                        __builtin_cpu_supports("avx512cd");
    if (std::strcmp(isa, "avx2") == 0 && !avx2) continue;
    if (std::strcmp(isa, "avx512") == 0 && !avx512) continue;
#endif
    tables.push_back(*table);
  }
  return tables;
}

}  // namespace tessera

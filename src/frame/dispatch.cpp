#include "frame/dispatch.hpp"

#include <cstdlib>
#include <string>

#include "base/error.hpp"

namespace tessera {

std::vector<const Kernels*> built_kernels() {
  std::vector<const Kernels*> tables;
  for (const Kernels* const* table = kernel_tables; *table != nullptr; ++table) tables.push_back(*table);
  return tables;
}

// What each set was compiled for: the x86-64 micro-architecture levels v2, v3 and v4. (Clang 14 cannot ask for f16c and
// lzcnt, which v3 has too; every CPU with AVX2 and BMI2 has them.)
bool cpu_runs(const Kernels& kernels) {
  const std::string_view isa = kernels.isa;
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool v2 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
  const bool v3 = v2 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                  __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                  __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                  __builtin_cpu_supports("avx512vl");
  return isa == "avx512" ? v4 : isa == "avx2" ? v3 : isa == "sse42" && v2;
#else
  return isa == "neon64";
#endif
}

const Kernels& select_kernels(std::string_view name) {
  if (name.empty() || name == "auto") {
    const char* wish = std::getenv("TESSERA_ISA");
    name = wish != nullptr ? wish : "";
  }
  std::string built;
  const Kernels* widest = nullptr;
  for (const Kernels* table : built_kernels()) {
    if (name == table->isa) {
      if (cpu_runs(*table)) return *table;
      throw usage_error("instruction set '{}': this CPU does not run it ('tessera isa' lists those it runs)", name);
    }
    built += built.empty() ? table->isa : std::string(", ") + table->isa;
    if (cpu_runs(*table)) widest = table;
  }
  if (!name.empty() && name != "auto")
    throw usage_error("instruction set '{}' is not one of this build's: {}", name, built);
  if (widest == nullptr) throw usage_error("this CPU runs none of the instruction sets of this build: {}", built);
  return *widest;
}

}  // namespace tessera

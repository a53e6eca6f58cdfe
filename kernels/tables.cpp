// The list of instruction sets in this build. Compiled once, for the baseline.
#include "kernels/interface.hpp"

namespace tessera {

#define TESSERA_DECLARE(isa)    \
  namespace isa {               \
  extern const Kernels kernels; \
  }
#if defined(__x86_64__)
TESSERA_DECLARE(sse42)
TESSERA_DECLARE(avx2)
TESSERA_DECLARE(avx512)
extern const Kernels* const kernel_tables[];
const Kernels* const kernel_tables[] = {&sse42::kernels, &avx2::kernels, &avx512::kernels, nullptr};
#else
TESSERA_DECLARE(neon64)
extern const Kernels* const kernel_tables[];
const Kernels* const kernel_tables[] = {&neon64::kernels, nullptr};
#endif

}  // namespace tessera

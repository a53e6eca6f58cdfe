// The sampling kernels of each instruction set in this build. Compiled once, for the baseline.
#include "kernels/sampling.hpp"

namespace tessera {

#define TESSERA_DECLARE(isa)             \
  namespace isa {                        \
  extern const SamplingKernels sampling; \
  }
#if defined(__x86_64__)
TESSERA_DECLARE(sse42)
TESSERA_DECLARE(avx2)
TESSERA_DECLARE(avx512)
extern const SamplingKernels* const sampling_tables[];
const SamplingKernels* const sampling_tables[] = {&sse42::sampling, &avx2::sampling, &avx512::sampling, nullptr};
#else
TESSERA_DECLARE(neon64)
extern const SamplingKernels* const sampling_tables[];
const SamplingKernels* const sampling_tables[] = {&neon64::sampling, nullptr};
#endif

}  // namespace tessera

#include "bench/chart/samplers.hpp"

#include <cstring>

#include "bench/chart/instructions.hpp"
#include "bench/chart/measure.hpp"

namespace tessera::chart {

const SamplingKernel* sampler_of(const char* isa, SamplingFormat format, SamplingLayout layout, SamplingFilter filter,
                                 bool cube) {
  for (const SamplingKernels* const* list = sampling_tables; *list != nullptr; ++list)
    for (int k = 0; std::strcmp((*list)->isa, isa) == 0 && k < (*list)->count; ++k) {
      const SamplingKernel& kernel = (*list)->first[k];
      if (kernel.format == format && kernel.layout == layout && kernel.filter == filter && kernel.cube == cube)
        return &kernel;
    }
  return nullptr;
}

void add_sampler_counts(const Session& session, Point& point, SamplingFormat format, SamplingLayout layout,
                        SamplingFilter filter, bool cube) {
  for (const SamplerCount& count : sampler_counts()) {
    if (count.format != format || count.layout != layout || count.filter != filter || count.cube != cube) continue;
    if (!runs_on(session, count.isa)) continue;
    point.extra["instructions " + count.isa] = count.instructions;
    const int gathers = count.gathers_of_words + count.gathers_of_pairs;
    if (gathers == 0) continue;  // SSE4.2, NEON: lane by lane
    point.extra["gathers " + count.isa] = gathers;
    point.extra["loads a lookup"] = count.gathers_of_words + count.gathers_of_pairs / 2.0;
  }
}

}  // namespace tessera::chart

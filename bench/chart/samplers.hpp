// The array kernels that sample textures (kernels/sampling.hpp), for families that time them.
#pragma once
#include "bench/chart/chart.hpp"
#include "kernels/sampling.hpp"

namespace tessera::chart {

/// Null if this instruction set has none.
const SamplingKernel* sampler_of(const char* isa, SamplingFormat format, SamplingLayout layout, SamplingFilter filter,
                                 bool cube);

/// Columns for a point of this way to sample: instructions and, where the instruction set has them, gathers per vector;
/// how often a lookup reads memory. Of the session's instruction sets.
void add_sampler_counts(const Session& session, Point& point, SamplingFormat format, SamplingLayout layout,
                        SamplingFilter filter, bool cube);

}  // namespace tessera::chart

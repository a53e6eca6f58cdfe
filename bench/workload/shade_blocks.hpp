// Deferred shading of a whole G-buffer, block by block, on all threads.
#pragma once
#include "bench/workload/inputs.hpp"

namespace tessera::workload {

/// Every pixel once: reads the G-buffer, writes `rgba` (the G-buffer's width * height * 4 floats, top row first). No
/// state is kept between frames.
void shade_blocks(const Kernels& kernels, const BlockedGBuffer& gbuffer, const Surroundings& surroundings,
                  const LightSet& lights, float* rgba);

}  // namespace tessera::workload

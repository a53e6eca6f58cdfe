// Deferred shading of a whole G-buffer, block by block, on all threads.
#pragma once
#include "bench/workload/inputs.hpp"

namespace tessera::workload {

/// RGBA floats, top row first, on huge pages where the system has them.
class Film {
 public:
  Film();
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;
  [[nodiscard]] float* rgba() const { return rgba_; }

 private:
  float* rgba_;
};

/// Every pixel once: reads the G-buffer, writes the film. No state is kept between frames.
void shade_blocks(const Kernels& kernels, const BlockedGBuffer& gbuffer, const Surroundings& surroundings,
                  const LightSet& lights, const Film& film);

}  // namespace tessera::workload

#include "frame/settings.hpp"

#include "base/error.hpp"

namespace tessera {

void validate(const RenderSettings& s) {
  if (s.width < 1 || s.height < 1 || s.width > max_frame_size || s.height > max_frame_size)
    throw usage_error("size {}x{}: expected 1x1 to {}x{}", s.width, s.height, max_frame_size, max_frame_size);
  if (s.samples != 1 && s.samples != 2 && s.samples != 4 && s.samples != 8 && s.samples != 16)
    throw usage_error("samples {}: expected 1, 2, 4, 8 or 16", s.samples);
  if (!(s.background_blur >= 0 && s.background_blur <= 1))
    throw usage_error("background blur {}: expected 0 to 1", s.background_blur);
  if (s.environment_size < 0 || s.environment_size > max_cube_size ||
      (s.environment_size & (s.environment_size - 1)) != 0)
    throw usage_error("environment size {}: expected a power of two up to {}, or 0", s.environment_size, max_cube_size);
  if (!(s.light_cutoff >= 0 && s.light_cutoff <= 1e6f))
    throw usage_error("light cutoff {}: expected 0 to 1e6 lux", s.light_cutoff);
  for (const float c : s.background_color)
    if (!(c >= 0 && c <= 65504)) throw usage_error("background colour component {}: expected 0 to 65504", c);
}

}  // namespace tessera

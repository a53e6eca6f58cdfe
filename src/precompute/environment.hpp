// An environment made ready for rendering: background, prefiltered reflections, irradiance.
#pragma once
#include <cstddef>

#include "base/image.hpp"
#include "kernels/interface.hpp"
#include "precompute/cube.hpp"
#include "precompute/irradiance.hpp"

namespace tessera {

struct EnvironmentSettings {
  float rotation = 0;       // radians about +Y: counter-clockwise seen from above
  float intensity = 1;      // factor, >= 0
  int background_size = 0;  // texels along a face, a power of two; 0: as fine as the picture, within 64 .. 1024
  int specular_size = 0;    // of the sharpest reflections; 0: up to 256
  int samples = 0;          // points per texel of each prefiltered level; 0: by roughness
};

/// What was wrong with the picture's texels, and how many times it was put right.
struct EnvironmentReport {
  std::size_t negative = 0;    // texels with a negative channel, taken as 0
  std::size_t non_finite = 0;  // texels with a NaN or infinite channel, taken as 0
  std::size_t clamped = 0;     // texels of the cube brighter than a half can hold, clamped to 65504
};

class Environment {
 public:
  [[nodiscard]] EnvironmentView view() const;
  [[nodiscard]] const EnvironmentReport& report() const { return report_; }

 private:
  friend Environment build_environment(const Image&, const EnvironmentSettings&, const Kernels&);
  Cube background_, specular_;
  IrradianceSh irradiance_;
  EnvironmentReport report_;
};

/// From an equirectangular picture (EquirectView has the orientation) of 1 to 4 channels: one or two are grey (and
/// alpha), three or four RGB (and alpha, which is not looked at). Same bits for any thread count and instruction set.
/// Throws Error(input) for a picture without pixels or with 2^29 or more.
Environment build_environment(const Image& equirect, const EnvironmentSettings& settings, const Kernels& kernels);

/// The same radiance from everywhere.
Environment constant_environment(float red, float green, float blue, const Kernels& kernels);

}  // namespace tessera

// An environment made ready for rendering: background, prefiltered reflections, irradiance.
#pragma once
#include <cstddef>
#include <optional>

#include "base/image.hpp"
#include "kernels/interface.hpp"
#include "precompute/cube.hpp"
#include "precompute/dominant_light.hpp"
#include "precompute/environment_source.hpp"
#include "precompute/irradiance.hpp"

namespace tessera {

enum class IrradianceForm {
  automatic,  // harmonics, unless a bright source makes them negative somewhere
  harmonics,
  cube,
};

struct EnvironmentSettings {
  float rotation = 0;       // radians about +Y: counter-clockwise seen from above
  float intensity = 1;      // factor, >= 0
  int background_size = 0;  // texels along a face, a power of two; 0: as fine as the picture, within 64 .. 1024
  int specular_size = 0;    // of the sharpest reflections; 0: up to 256
  int samples = 0;          // points per texel of each prefiltered level; 0: by roughness
  int levels = 0;           // of reflections, 1 .. log2(size) + 1; 0: down to 4 x 4 texels
  float firefly_limit = 0;  // radiance (after intensity) above which a texel is dimmed to it; 0: none
  float sh_window = 0;      // lambda of windowed()
  IrradianceForm irradiance = IrradianceForm::automatic;
  bool keep_cube = false;      // bakes the cube of irradiance in any case
  bool extract_light = false;  // takes the dominant light out
};

/// What was wrong with the picture's texels, and how many times it was put right.
struct EnvironmentReport {
  std::size_t negative = 0;    // texels with a negative channel, taken as 0
  std::size_t non_finite = 0;  // texels with a NaN or infinite channel, taken as 0
  std::size_t fireflies = 0;   // texels dimmed to firefly_limit
  std::size_t clamped = 0;     // texels of the cube brighter than a half can hold, clamped to 65504
};

/// Of the picture as it came, intensity included, a light extracted from it not. Luminance: Rec.709.
struct EnvironmentStatistics {
  double mean[3] = {0, 0, 0};  // radiance over the sphere
  double brightest = 0;        // luminance
};

/// All that is baked; what a file of it holds.
struct EnvironmentData {
  Cube background, specular;
  Cube irradiance;         // E / pi; may be empty if the harmonics serve
  bool uses_cube = false;  // for irradiance
  float lod_curve = 0;
  IrradianceSh sh;
  EnvironmentReport report;
  EnvironmentStatistics statistics;
  std::optional<DominantLight> light;
};

class Environment {
 public:
  explicit Environment(EnvironmentData data) : data_(std::move(data)) {}
  [[nodiscard]] EnvironmentView view() const;
  [[nodiscard]] const EnvironmentReport& report() const { return data_.report; }
  [[nodiscard]] const EnvironmentData& data() const { return data_; }

 private:
  EnvironmentData data_;
};

/// From a picture of 1 to 4 channels: one or two are grey (and alpha), three or four RGB (and alpha, which is not
/// looked at). Same bits for any thread count and instruction set.
Environment build_environment(const EnvironmentPicture& picture, const EnvironmentSettings& settings,
                              const Kernels& kernels);

/// The same of an equirectangular picture. Throws Error(input) for one without pixels or with 2^29 or more.
Environment build_environment(const Image& equirect, const EnvironmentSettings& settings, const Kernels& kernels);

/// The same radiance from everywhere.
Environment constant_environment(float red, float green, float blue, const Kernels& kernels);

}  // namespace tessera

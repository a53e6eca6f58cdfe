// What a person may choose about a frame. The scene and the environment are given separately.
#pragma once
#include <array>
#include <cstdint>
#include <functional>

#include "kernels/interface.hpp"
#include "precompute/environment.hpp"
#include "precompute/texture.hpp"

namespace tessera {

/// Values of RenderSettings::samples.
inline constexpr std::array<int, 5> sample_counts = {1, 2, 4, 8, 16};
/// How textures are filtered.
enum class TextureFilter {
  file,         // as the file's samplers say
  nearest_mip,  // within the nearest level, not between two
  no_mips,      // level 0 alone
  nearest,      // the nearest texel of the nearest level
};

/// What people call the values of the enumerations, in their order.
inline constexpr std::array<const char*, 5> environment_lobe_names = {"n=v", "shifted", "taps2", "taps4", "fis8"};
inline constexpr std::array<const char*, 2> environment_fresnel_names = {"kS", "f0"};
inline constexpr std::array<const char*, 3> environment_albedo_names = {"table", "fit", "small-fit"};
inline constexpr std::array<const char*, 2> environment_texel_names = {"half", "rgb9e5"};
inline constexpr std::array<const char*, 3> irradiance_form_names = {"auto", "sh", "cube"};
inline constexpr std::array<const char*, 4> texture_filter_names = {"file", "nearest-mip", "no-mips", "nearest"};
inline constexpr std::array<const char*, 2> color_texel_names = {"half", "8bit"};

enum class Background { environment, color, transparent };

struct RenderSettings {
  int width = 1920, height = 1080;  // 1 .. max_frame_size
  int samples = 4;                  // per pixel: 1, 2, 4, 8 or 16
  Background background = Background::environment;
  float background_color[3] = {0, 0, 0};  // linear
  float background_blur = 0;              // 0 sharp .. 1 the most blurred mip
  // How an environment is looked up. Against `tessera reference` on spheres of metal and plastic, at grazing angles and
  // roughness 0.2 to 0.6, this errs by 0.26 (courtyard), 0.47 (interior) and 0.22 (sunset) of what one lookup along the
  // mirror direction and kS do.
  EnvironmentShading environment_shading = {EnvironmentLobe::taps4, EnvironmentFresnel::f0, false};
  CubeFormat environment_texels = CubeFormat::rgba16_float;           // of reflections
  IrradianceForm environment_irradiance = IrradianceForm::automatic;  // the environment must hold what is asked for
  // Texels along a face of the sharpest reflections, for whoever builds the environment (EnvironmentSettings).
  int environment_size = 0;
  float light_cutoff = 0;  // lux: where point and spot lights may end (compile_lights)
  TextureFilter texture_filter = TextureFilter::file;
  ColorTexels color_texels = ColorTexels::halves;
  int threads = 0;     // 0: all cores
  bool trace = false;  // remember when each thread did what: FrameStatistics::profile
  bool hash = true;    // compute FrameStatistics::pixel_hash

  std::uint64_t tile_order_seed = 0;  // 0: rows; else a shuffle (the picture must not change: tests use it)
  std::function<void(std::size_t done, std::size_t total)> progress;  // tiles; called from any thread
};

/// Throws Error(usage) naming the setting that is out of range.
void validate(const RenderSettings& settings);

}  // namespace tessera

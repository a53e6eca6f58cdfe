// What all frames of a scene share, built once and only as far as scene and settings call for it.
#pragma once
#include <optional>
#include <vector>

#include "frame/composite.hpp"
#include "frame/lights.hpp"
#include "frame/settings.hpp"
#include "frame/tile.hpp"
#include "precompute/dfg.hpp"
#include "precompute/environment.hpp"
#include "precompute/packed_cube.hpp"

namespace tessera {

/// Lights and environment, compiled for the kernels. Keeps references to what it is made of; `environment` may be null.
class Lighting {
 public:
  Lighting(const std::vector<Light>& lights, const Environment* environment, const Kernels& kernels);

  /// In the form that the settings ask for; what is not there yet is made. Valid until the next call. Throws
  /// Error(usage) for a form that the environment does not hold.
  LightingView view(const RenderSettings& settings);
  /// Memory of the cubes and of the environment BRDF's table that such a view reads.
  [[nodiscard]] std::size_t table_bytes(const RenderSettings& settings) const;
  [[nodiscard]] BackgroundSource background(const RenderSettings& settings) const;

 private:
  struct CompiledLights {
    float cutoff;
    std::vector<LightView> lights;
    LightBounds bounds;
  };
  const CompiledLights& compiled(float cutoff);

  const std::vector<Light>& file_lights_;
  const Environment* environment_;
  const Kernels& kernels_;
  std::vector<CompiledLights> lights_;  // by cutoff: those that were asked for
  std::optional<PackedCube> packed_;    // reflections, if asked for
};

}  // namespace tessera

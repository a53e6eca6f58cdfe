// What all frames of a scene share, built once and only as far as the scene calls for it.
#pragma once
#include <vector>

#include "frame/composite.hpp"
#include "frame/lights.hpp"
#include "frame/settings.hpp"
#include "frame/tile.hpp"
#include "precompute/dfg.hpp"
#include "precompute/environment.hpp"

namespace tessera {

/// Lights and environment, compiled for the kernels. `environment` may be null.
struct Lighting {
  std::vector<LightView> lights;
  LightBounds bounds;
  const Environment* environment = nullptr;
  const DfgTable* dfg = nullptr;  // null without an environment
  std::uint32_t features = 0;

  Lighting(const std::vector<Light>& lights, const Environment* environment, const Kernels& kernels);
  [[nodiscard]] LightingView view() const;
  /// Memory of the cubes and of the environment BRDF's table.
  [[nodiscard]] std::size_t table_bytes() const;
  [[nodiscard]] BackgroundSource background(const RenderSettings& settings) const;
};

}  // namespace tessera

// Lights as the kernels want them.
#pragma once
#include <vector>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"
#include "scene/light.hpp"

namespace tessera {

/// Cone angles become KHR_lights_punctual's scale and offset; intensity is folded into the colour. Lights that give
/// nothing (zero or not finite intensity) are left out. cutoff: illuminance in lux at which a point or spot light may
/// end: its range is at most the distance where its strongest channel has fallen to that. 0: only where the light says.
std::vector<LightView> compile_lights(const std::vector<Light>& lights, const Kernels& kernels, float cutoff = 0);

/// The lights as spheres, for Kernels::cull_lights.
class LightBounds {
 public:
  LightBounds() = default;
  explicit LightBounds(const std::vector<LightView>& lights);
  [[nodiscard]] LightBoundsView view() const;
  /// Some light has a range: culling can leave one out.
  [[nodiscard]] bool limited() const { return limited_; }
  /// And there are so many that looking costs less than shading with all.
  [[nodiscard]] bool worth_culling() const { return limited_ && count_ > 4; }

 private:
  AlignedVector<float> planes_;  // x, y, z, 1 / range^2
  std::size_t stride_ = 0;
  std::uint32_t count_ = 0;
  bool limited_ = false;
};

}  // namespace tessera

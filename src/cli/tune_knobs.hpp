// The settings that `tune` varies, and how a choice of them becomes a frame's settings.
#pragma once
#include <string>
#include <vector>

#include "frame/knob_search.hpp"
#include "frame/settings.hpp"

namespace tessera::cli {

/// What each setting may be, the most exact first; a setting with one value is not varied.
struct TuneKnobs {
  std::vector<int> samples;
  std::vector<EnvironmentLobe> lobes;
  std::vector<EnvironmentFresnel> fresnels;
  std::vector<bool> specular_occlusion;

  [[nodiscard]] std::vector<int> counts() const;
  void apply(const KnobChoice& choice, RenderSettings& settings) const;
  /// The choice nearest to the defaults of RenderSettings: equal to them where the knobs allow it.
  [[nodiscard]] KnobChoice defaults() const;
};

/// All knobs that could make a difference. Lobes are taken from `tessera chart ibl`: four taps are as near to the
/// lobe's integral as eight points and cheaper.
TuneKnobs make_knobs(bool has_environment, bool has_occlusion);

/// "4 samples, taps4, f0, specular occlusion"; without what `knobs` leaves no choice of.
std::string describe(const TuneKnobs& knobs, const KnobChoice& choice);

}  // namespace tessera::cli

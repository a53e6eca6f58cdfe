// The settings that `tune` varies, and how a choice of them becomes a frame's settings.
#pragma once
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "frame/knob_search.hpp"
#include "frame/settings.hpp"
#include "scene/scene.hpp"

namespace tessera::cli {

/// One setting, and what it may be, the most exact first.
struct TuneKnob {
  std::string key;                 // in a file of settings
  std::vector<std::string> words;  // what a person calls each choice
  int standard = 0;                // the choice that the defaults are
  std::function<void(int choice, RenderSettings&)> apply;
};

/// What of a scene makes settings matter.
struct TuneTraits {
  bool environment = false;
  std::vector<int> environment_sizes;             // that can be had, the largest first; fewer than two: not varied
  bool irradiance_cube = false;                   // there is one
  bool irradiance_from_cube = false;              // and it is the default
  bool occlusion = false;                         // some material has an occlusion map
  bool ranged_lights = false;                     // there are point or spot lights
  bool textures = false, color_textures = false;  // there are textures; and such as are sRGB
  float exposure = 1;                             // factor: what little light is depends on it
};

/// Without environment_sizes and irradiance.
TuneTraits traits_of(const Scene& scene);

struct TuneKnobs {
  std::vector<TuneKnob> list;  // of at least two choices each

  [[nodiscard]] std::vector<int> counts() const;
  void apply(const KnobChoice& choice, RenderSettings& settings) const;
  /// What the defaults are among these choices.
  [[nodiscard]] KnobChoice defaults() const;
  /// "4 samples, taps2": what differs from the exact choice; of the exact choice, everything.
  [[nodiscard]] std::string describe(const KnobChoice& choice) const;
};

/// All knobs that could make a difference to a scene, but those whose keys are `given`. Lobes are taken from `tessera
/// chart ibl`: four taps are as near to the lobe's integral as eight points and cheaper.
TuneKnobs make_knobs(const TuneTraits& traits, const std::set<std::string>& given);

}  // namespace tessera::cli

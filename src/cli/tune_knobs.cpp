#include "cli/tune_knobs.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tessera::cli {
namespace {

template <class T, class U>
int index_or_first(const std::vector<T>& values, const U& value) {
  const auto found = std::find(values.begin(), values.end(), value);
  return found == values.end() ? 0 : static_cast<int>(found - values.begin());
}

std::size_t at(const KnobChoice& choice, std::size_t knob) { return static_cast<std::size_t>(choice.at(knob)); }

}  // namespace

std::vector<int> TuneKnobs::counts() const {
  return {static_cast<int>(samples.size()), static_cast<int>(lobes.size()), static_cast<int>(fresnels.size()),
          static_cast<int>(specular_occlusion.size())};
}

void TuneKnobs::apply(const KnobChoice& choice, RenderSettings& settings) const {
  settings.samples = samples.at(at(choice, 0));
  settings.environment_shading = {lobes.at(at(choice, 1)), fresnels.at(at(choice, 2)),
                                  specular_occlusion.at(at(choice, 3))};
}

KnobChoice TuneKnobs::defaults() const {
  const RenderSettings settings;
  const EnvironmentShading& shading = settings.environment_shading;
  return {index_or_first(samples, settings.samples), index_or_first(lobes, shading.lobe),
          index_or_first(fresnels, shading.fresnel), index_or_first(specular_occlusion, shading.specular_occlusion)};
}

TuneKnobs make_knobs(bool has_environment, bool has_occlusion) {
  const EnvironmentShading standard = RenderSettings{}.environment_shading;
  TuneKnobs knobs = {{sample_counts.rbegin(), sample_counts.rend()},
                     {standard.lobe},
                     {standard.fresnel},
                     {standard.specular_occlusion}};
  if (!has_environment) return knobs;
  knobs.lobes = {EnvironmentLobe::taps4, EnvironmentLobe::points8, EnvironmentLobe::taps2, EnvironmentLobe::shifted,
                 EnvironmentLobe::mirror};
  knobs.fresnels = {EnvironmentFresnel::f0, EnvironmentFresnel::roughness};
  if (has_occlusion) knobs.specular_occlusion = {true, false};
  return knobs;
}

std::string describe(const TuneKnobs& knobs, const KnobChoice& choice) {
  RenderSettings s;
  knobs.apply(choice, s);
  const EnvironmentShading& shading = s.environment_shading;
  std::string text = fmt::format("{} sample{}", s.samples, s.samples == 1 ? "" : "s");
  if (knobs.lobes.size() > 1) text += fmt::format(", {}", environment_lobe_names.at(std::size_t(shading.lobe)));
  if (knobs.fresnels.size() > 1)
    text += fmt::format(", {}", environment_fresnel_names.at(std::size_t(shading.fresnel)));
  if (knobs.specular_occlusion.size() > 1) text += shading.specular_occlusion ? ", specular occlusion" : "";
  return text;
}

}  // namespace tessera::cli

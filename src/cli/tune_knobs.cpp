#include "cli/tune_knobs.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tessera::cli {
namespace {

// at(settings) is the setting; it may take these values. standard: the default among them.
template <class T, class At>
TuneKnob knob(const char* key, std::vector<T> values, std::vector<std::string> words, const T& standard, At at) {
  const auto found = std::find(values.begin(), values.end(), standard);
  const int index = found == values.end() ? 0 : static_cast<int>(found - values.begin());
  return {key, std::move(words), index, [values = std::move(values), at](int choice, RenderSettings& settings) {
            at(settings) = values.at(static_cast<std::size_t>(choice));
          }};
}

// Values of an enumeration, by their names in settings.hpp.
template <class T, std::size_t N, class At>
TuneKnob named_knob(const char* key, const std::vector<T>& values, const std::array<const char*, N>& names,
                    const char* after, const T& standard, At at) {
  std::vector<std::string> words;
  for (const T value : values) words.push_back(std::string(names.at(static_cast<std::size_t>(value))) + after);
  return knob(key, values, words, standard, at);
}

TuneKnob samples_knob() {
  std::vector<std::string> words;
  const std::vector<int> counts(sample_counts.rbegin(), sample_counts.rend());
  for (const int count : counts) words.push_back(fmt::format("{} sample{}", count, count == 1 ? "" : "s"));
  return knob(
      "samples", counts, words, RenderSettings{}.samples, [](auto& s) -> auto& { return s.samples; });
}

void add_environment_knobs(const TuneTraits& traits, std::vector<TuneKnob>& list) {
  using S = RenderSettings;
  const S standard;
  const EnvironmentShading& shading = standard.environment_shading;
  list.push_back(named_knob<EnvironmentLobe>(
      "env-lobe",
      {EnvironmentLobe::taps4, EnvironmentLobe::points8, EnvironmentLobe::taps2, EnvironmentLobe::shifted,
       EnvironmentLobe::mirror},
      environment_lobe_names, "", shading.lobe, [](S & s) -> auto& { return s.environment_shading.lobe; }));
  list.push_back(named_knob<EnvironmentFresnel>(
      "env-fresnel", {EnvironmentFresnel::f0, EnvironmentFresnel::roughness}, environment_fresnel_names, "",
      shading.fresnel, [](S & s) -> auto& { return s.environment_shading.fresnel; }));
  if (traits.occlusion)
    list.push_back(knob<bool>(
        "specular-occlusion", {true, false}, {"specular occlusion", "no specular occlusion"},
        shading.specular_occlusion, [](S & s) -> auto& { return s.environment_shading.specular_occlusion; }));
  list.push_back(named_knob<EnvironmentAlbedo>(
      "env-albedo", {EnvironmentAlbedo::table, EnvironmentAlbedo::fit, EnvironmentAlbedo::small_fit},
      environment_albedo_names, "", shading.albedo, [](S & s) -> auto& { return s.environment_shading.albedo; }));
  std::vector<std::string> sizes;
  for (const int size : traits.environment_sizes) sizes.push_back(fmt::format("{}² cube", size));
  if (sizes.size() > 1)
    list.push_back(knob(
        "env-size", traits.environment_sizes, sizes, 256, [](S & s) -> auto& { return s.environment_size; }));
  list.push_back(named_knob<CubeFormat>(
      "env-texels", {CubeFormat::rgba16_float, CubeFormat::rgb9_e5}, environment_texel_names, " cube",
      standard.environment_texels, [](S & s) -> auto& { return s.environment_texels; }));
  if (traits.irradiance_cube)
    list.push_back(knob<IrradianceForm>(
        "env-irradiance", {IrradianceForm::cube, IrradianceForm::harmonics}, {"irradiance cube", "harmonics"},
        traits.irradiance_from_cube ? IrradianceForm::cube : IrradianceForm::harmonics,
        [](S & s) -> auto& { return s.environment_irradiance; }));
}

// A white surface that faces 0.001 lux has radiance 0.0003, which on black is a twelfth of a display step... and as
// much as one step where sRGB is linear.
TuneKnob cutoff_knob(float exposure) {
  std::vector<float> cutoffs = {0};
  std::vector<std::string> words = {"lights without end"};
  for (const float at_exposure_1 : {0.001f, 0.01f, 0.1f}) {
    cutoffs.push_back(std::min(at_exposure_1 / exposure, 1e6f));
    words.push_back(fmt::format("lights to {:.3g} lux", cutoffs.back()));
  }
  return knob(
      "light-cutoff", cutoffs, words, RenderSettings{}.light_cutoff,
      [](RenderSettings & s) -> auto& { return s.light_cutoff; });
}

}  // namespace

TuneTraits traits_of(const Scene& scene) {
  TuneTraits traits;
  for (const Material& m : scene.materials) {
    traits.occlusion |= m.occlusion_texture.texture >= 0;
    traits.color_textures |= m.base_color_texture.texture >= 0 || m.emissive_texture.texture >= 0;
    traits.textures |= traits.occlusion || traits.color_textures || m.metallic_roughness_texture.texture >= 0 ||
                       m.normal_texture.texture >= 0;
  }
  for (const Light& light : scene.lights) traits.ranged_lights |= light.type != LightType::directional;
  return traits;
}

std::vector<int> TuneKnobs::counts() const {
  std::vector<int> all;
  for (const TuneKnob& k : list) all.push_back(static_cast<int>(k.words.size()));
  return all;
}

void TuneKnobs::apply(const KnobChoice& choice, RenderSettings& settings) const {
  for (std::size_t k = 0; k < list.size(); ++k) list[k].apply(choice.at(k), settings);
}

KnobChoice TuneKnobs::defaults() const {
  KnobChoice choice;
  for (const TuneKnob& k : list) choice.push_back(k.standard);
  return choice;
}

std::string TuneKnobs::describe(const KnobChoice& choice) const {
  const bool exact = std::all_of(choice.begin(), choice.end(), [](int k) { return k == 0; });
  std::string text;
  for (std::size_t k = 0; k < list.size(); ++k)
    if (exact || choice.at(k) != 0)
      text += (text.empty() ? "" : ", ") + list[k].words.at(static_cast<std::size_t>(choice.at(k)));
  return text.empty() ? "nothing to vary" : text;
}

TuneKnobs make_knobs(const TuneTraits& traits, const std::set<std::string>& given) {
  TuneKnobs knobs;
  knobs.list.push_back(samples_knob());
  if (traits.environment) add_environment_knobs(traits, knobs.list);
  if (traits.ranged_lights) knobs.list.push_back(cutoff_knob(traits.exposure));
  if (traits.textures)
    knobs.list.push_back(knob<TextureFilter>(
        "texture-filter",
        {TextureFilter::file, TextureFilter::nearest_mip, TextureFilter::no_mips, TextureFilter::nearest},
        {"textures as filed", "nearest mip", "no mips", "nearest texel"}, TextureFilter::file,
        [](RenderSettings & s) -> auto& { return s.texture_filter; }));
  if (traits.color_textures)
    knobs.list.push_back(knob<ColorTexels>(
        "color-texels", {ColorTexels::halves, ColorTexels::bytes}, {"half colours", "8-bit colours"},
        ColorTexels::halves, [](RenderSettings & s) -> auto& { return s.color_texels; }));
  std::erase_if(knobs.list, [&](const TuneKnob& k) { return given.contains(k.key); });
  return knobs;
}

}  // namespace tessera::cli

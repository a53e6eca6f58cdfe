// Settings that a person keeps in a file: what `tessera tune` writes and `tessera render --settings` reads.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "frame/settings.hpp"

namespace tessera {

/// Sets what the file names and leaves the rest of settings. The file is a JSON object:
///   "tessera-settings": 1               its version; must be there
///   "samples": 1, 2, 4, 8 or 16
///   "env-lobe", "env-fresnel", "env-albedo", "env-texels", "env-irradiance", "texture-filter", "color-texels": words
///   of settings.hpp
///   "specular-occlusion": true or false
///   "env-size": a power of two up to 4096, or 0: up to 256
///   "light-cutoff": lux, 0 to 1e6
///   "about": words for a person
/// Throws Error(input) for anything else.
void read_settings(const std::string& path, RenderSettings& settings);

/// Writes all of these. path "-": standard output. Throws Error(output).
void write_settings(const std::string& path, const RenderSettings& settings, const std::string& about);

/// All that such a file may say about a frame, by its keys.
nlohmann::ordered_json settings_json(const RenderSettings& settings);

}  // namespace tessera

// Settings that a person keeps in a file: what `tessera tune` writes and `tessera render --settings` reads.
#pragma once
#include <string>

#include "frame/settings.hpp"

namespace tessera {

/// Sets what the file names and leaves the rest of settings. The file is a JSON object:
///   "tessera-settings": 1               its version; must be there
///   "samples": 1, 2, 4, 8 or 16
///   "env-lobe", "env-fresnel": names of environment_lobe_names, environment_fresnel_names
///   "specular-occlusion": true or false
///   "about": words for a person
/// Throws Error(input) for anything else.
void read_settings(const std::string& path, RenderSettings& settings);

/// Writes all of these. path "-": standard output. Throws Error(output).
void write_settings(const std::string& path, const RenderSettings& settings, const std::string& about);

}  // namespace tessera

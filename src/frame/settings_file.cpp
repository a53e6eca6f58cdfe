#include "frame/settings_file.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.hpp"
#include "io/file_bytes.hpp"
#include "io/output_file.hpp"

namespace tessera {
namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 1;
constexpr std::uint64_t longest_file = 65536;  // bytes; a file of all keys has some 200

constexpr const char* version_key = "tessera-settings";
constexpr const char* samples_key = "samples";
constexpr const char* lobe_key = "env-lobe";
constexpr const char* fresnel_key = "env-fresnel";
constexpr const char* occlusion_key = "specular-occlusion";
constexpr const char* about_key = "about";

// A value as messages quote it: on one line, and short.
std::string one_line(const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 60) + "...";
  return text;
}

Json parse(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path, longest_file);
  const char* const text = reinterpret_cast<const char*>(bytes.data());
  // Of a key that comes twice the parser would keep the last.
  std::set<std::string> keys;
  const auto once = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::key && depth == 1 && !keys.insert(parsed.get<std::string>()).second)
      throw input_error("{}: {} is there twice", path, one_line(parsed));
    return true;
  };
  try {
    Json root = Json::parse(text, text + bytes.size(), once);
    if (!root.is_object()) throw input_error("{}: found {}, expected a JSON object of settings", path, one_line(root));
    return root;
  } catch (const Json::exception& e) {
    const std::string reason = e.what();
    const std::size_t begin = reason.find("] ");  // behind the library's number of the error
    throw input_error("{}: invalid JSON: {}", path, reason.substr(begin == std::string::npos ? 0 : begin + 2, 200));
  }
}

[[noreturn]] void refuse(const std::string& path, const char* key, const Json& value, const std::string& expected) {
  throw input_error("{}: \"{}\": found {}, expected {}", path, key, one_line(value), expected);
}

template <std::size_t N>
std::size_t index_of(const std::string& path, const char* key, const Json& value,
                     const std::array<const char*, N>& names) {
  for (std::size_t k = 0; k < N; ++k)
    if (value.is_string() && value.get_ref<const std::string&>() == names[k]) return k;
  refuse(path, key, value, fmt::format("one of {}", fmt::join(names, ", ")));
}

}  // namespace

void read_settings(const std::string& path, RenderSettings& settings) {
  const Json root = parse(path);
  const auto found = root.find(version_key);
  if (found == root.end()) throw input_error("{}: \"{}\" is missing: not a file of settings", path, version_key);
  if (*found != version) refuse(path, version_key, *found, std::to_string(version));
  EnvironmentShading& shading = settings.environment_shading;
  for (const auto& [key, value] : root.items()) {
    if (key == samples_key) {
      const auto count = std::find(sample_counts.begin(), sample_counts.end(), value);
      if (!value.is_number_integer() || count == sample_counts.end())
        refuse(path, samples_key, value, fmt::format("one of {}", fmt::join(sample_counts, ", ")));
      settings.samples = *count;
    } else if (key == lobe_key) {
      shading.lobe = static_cast<EnvironmentLobe>(index_of(path, lobe_key, value, environment_lobe_names));
    } else if (key == fresnel_key) {
      shading.fresnel = static_cast<EnvironmentFresnel>(index_of(path, fresnel_key, value, environment_fresnel_names));
    } else if (key == occlusion_key) {
      if (!value.is_boolean()) refuse(path, occlusion_key, value, "true or false");
      shading.specular_occlusion = value.get<bool>();
    } else if (key == about_key) {
      if (!value.is_string()) refuse(path, about_key, value, "words");
    } else if (key != version_key) {
      throw input_error("{}: unknown setting {}; expected some of {}, {}, {}, {}", path, one_line(key), samples_key,
                        lobe_key, fresnel_key, occlusion_key);
    }
  }
}

void write_settings(const std::string& path, const RenderSettings& settings, const std::string& about) {
  Json root;
  root[version_key] = version;
  root[about_key] = about;
  root[samples_key] = settings.samples;
  root[lobe_key] = environment_lobe_names.at(static_cast<std::size_t>(settings.environment_shading.lobe));
  root[fresnel_key] = environment_fresnel_names.at(static_cast<std::size_t>(settings.environment_shading.fresnel));
  root[occlusion_key] = settings.environment_shading.specular_occlusion;
  const std::string text = root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  OutputFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace tessera

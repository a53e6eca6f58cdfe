#include "frame/settings_file.hpp"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "base/error.hpp"
#include "base/json_depth.hpp"
#include "io/file_bytes.hpp"
#include "io/output_file.hpp"

namespace tessera {
namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 1;
constexpr std::uint64_t longest_file = 65536;  // bytes; a file of all keys has some 200

constexpr int deepest_nesting = 16;

constexpr const char* version_key = "tessera-settings";
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
  if (nests_deeper({text, bytes.size()}, deepest_nesting))
    throw input_error("{}: invalid JSON: nested more than {} deep, expected a JSON object of settings", path,
                      deepest_nesting);
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

// A setting as the file has it.
struct Entry {
  const char* key;
  std::string expected;                                   // what its values may be, in words
  std::function<bool(const Json&, RenderSettings&)> set;  // whether it was one of them
  std::function<Json(const RenderSettings&)> get;
};

// One of several words; at(settings) is the enumeration that they stand for.
template <std::size_t N, class At>
Entry words(const char* key, const std::array<const char*, N>& names, At at) {
  return {key, fmt::format("one of {}", fmt::join(names, ", ")),
          [&names, at](const Json& value, RenderSettings& settings) {
            for (std::size_t k = 0; k < N; ++k)
              if (value.is_string() && value.get_ref<const std::string&>() == names[k]) {
                at(settings) = static_cast<std::remove_reference_t<decltype(at(settings))>>(k);
                return true;
              }
            return false;
          },
          [&names, at](const RenderSettings& settings) -> Json {
            return names.at(static_cast<std::size_t>(at(settings)));
          }};
}

bool set_samples(const Json& value, RenderSettings& settings) {
  const auto count = std::find(sample_counts.begin(), sample_counts.end(), value);
  if (!value.is_number_integer() || count == sample_counts.end()) return false;
  settings.samples = *count;
  return true;
}

bool set_size(const Json& value, RenderSettings& settings) {
  if (!value.is_number_unsigned()) return false;
  const auto size = value.get<std::uint64_t>();
  if (size > std::uint64_t{max_cube_size} || (size & (size - 1)) != 0) return false;
  settings.environment_size = static_cast<int>(size);
  return true;
}

bool set_cutoff(const Json& value, RenderSettings& settings) {
  if (!value.is_number() || !(value.get<double>() >= 0 && value.get<double>() <= 1e6)) return false;
  settings.light_cutoff = value.get<float>();
  return true;
}

bool set_occlusion(const Json& value, RenderSettings& settings) {
  if (value.is_boolean()) settings.environment_shading.specular_occlusion = value.get<bool>();
  return value.is_boolean();
}

const std::vector<Entry>& entries() {
  using S = RenderSettings;
  static const std::vector<Entry> all = {
      {"samples", fmt::format("one of {}", fmt::join(sample_counts, ", ")), set_samples,
       [](const S& s) -> Json { return s.samples; }},
      words(
          "env-lobe", environment_lobe_names, [](auto& s) -> auto& { return s.environment_shading.lobe; }),
      words(
          "env-fresnel", environment_fresnel_names, [](auto& s) -> auto& { return s.environment_shading.fresnel; }),
      {"specular-occlusion", "true or false", set_occlusion,
       [](const S& s) -> Json { return s.environment_shading.specular_occlusion; }},
      words(
          "env-albedo", environment_albedo_names, [](auto& s) -> auto& { return s.environment_shading.albedo; }),
      {"env-size", "a power of two up to 4096, or 0", set_size, [](const S& s) -> Json { return s.environment_size; }},
      words(
          "env-texels", environment_texel_names, [](auto& s) -> auto& { return s.environment_texels; }),
      words(
          "env-irradiance", irradiance_form_names, [](auto& s) -> auto& { return s.environment_irradiance; }),
      // As the shortest decimal that reads back as the same float.
      {"light-cutoff", "0 to 1e6", set_cutoff,
       [](const S& s) -> Json { return std::stod(fmt::format("{}", s.light_cutoff)); }},
      words(
          "texture-filter", texture_filter_names, [](auto& s) -> auto& { return s.texture_filter; }),
      words(
          "color-texels", color_texel_names, [](auto& s) -> auto& { return s.color_texels; }),
  };
  return all;
}

}  // namespace

void read_settings(const std::string& path, RenderSettings& settings) {
  const Json root = parse(path);
  const auto found = root.find(version_key);
  if (found == root.end()) throw input_error("{}: \"{}\" is missing: not a file of settings", path, version_key);
  const auto refuse = [&](const std::string& key, const Json& value, const std::string& expected) {
    throw input_error("{}: \"{}\": found {}, expected {}", path, key, one_line(value), expected);
  };
  if (*found != version) refuse(version_key, *found, std::to_string(version));
  for (const auto& [key, value] : root.items()) {
    const auto entry =
        std::find_if(entries().begin(), entries().end(), [&k = key](const Entry& e) { return e.key == k; });
    if (entry != entries().end()) {
      if (!entry->set(value, settings)) refuse(key, value, entry->expected);
    } else if (key == about_key) {
      if (!value.is_string()) refuse(key, value, "words");
    } else if (key != version_key) {
      std::string known;
      for (const Entry& e : entries()) known += (known.empty() ? "" : ", ") + std::string(e.key);
      throw input_error("{}: unknown setting {}; expected some of {}", path, one_line(key), known);
    }
  }
}

Json settings_json(const RenderSettings& settings) {
  Json all;
  for (const Entry& entry : entries()) all[entry.key] = entry.get(settings);
  return all;
}

void write_settings(const std::string& path, const RenderSettings& settings, const std::string& about) {
  Json root;
  root[version_key] = version;
  root[about_key] = about;
  root.update(settings_json(settings));
  const std::string text = root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  OutputFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace tessera

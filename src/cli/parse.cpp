#include "cli/parse.hpp"

#include <charconv>
#include <cmath>

#include "base/error.hpp"

namespace tessera::cli {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// The whole of text as a finite number; independent of the locale.
std::optional<double> number(std::string_view text) {
  text = trim(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

void set_direction(float (&out)[3], std::string_view what, std::string_view text) {
  const std::array<double, 3> d = parse_vector(what, text);
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if (!(length > 0) || !std::isfinite(length)) throw usage_error("{} '{}': this direction has no length", what, text);
  for (std::size_t k = 0; k < 3; ++k) out[k] = static_cast<float>(d[k] / length);
}

void set_position(float (&out)[3], std::string_view what, std::string_view text) {
  const std::array<double, 3> p = parse_vector(what, text);
  for (std::size_t k = 0; k < 3; ++k) out[k] = static_cast<float>(p[k]);
}

}  // namespace

std::vector<double> parse_numbers(std::string_view what, std::string_view text, std::size_t least, std::size_t most) {
  std::vector<double> values;
  for (const std::string_view part : split(text, ',')) {
    const std::optional<double> value = number(part);
    if (!value) throw usage_error("{} '{}': '{}' is not a number", what, text, part);
    if (!(std::abs(*value) <= 1e30)) throw usage_error("{} '{}': {} is out of range", what, text, part);
    values.push_back(*value);
  }
  if (values.size() < least || values.size() > most) {
    const std::string expected = least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
    throw usage_error("{} '{}': expected {} numbers with commas between them, found {}", what, text, expected,
                      values.size());
  }
  return values;
}

std::array<double, 3> parse_vector(std::string_view what, std::string_view text) {
  const std::vector<double> v = parse_numbers(what, text, 3, 3);
  return {v[0], v[1], v[2]};
}

std::array<int, 2> parse_size(std::string_view text) {
  std::array<int, 2> size{};
  const std::vector<std::string_view> parts = split(text, 'x');
  bool good = parts.size() == 2;
  for (std::size_t k = 0; k < 2 && good; ++k) {
    const char* end = parts[k].data() + parts[k].size();
    const auto result = std::from_chars(parts[k].data(), end, size[k]);
    good = result.ec == std::errc() && result.ptr == end && size[k] >= 1 && size[k] <= max_frame_size;
  }
  if (!good)
    throw usage_error("--size '{}': expected WIDTHxHEIGHT in pixels, each 1 to {}, such as 1920x1080", text,
                      max_frame_size);
  return size;
}

BackgroundChoice parse_background(std::string_view text, const Kernels& kernels) {
  if (text == "env") return {Background::environment, {}};
  if (text == "transparent") return {Background::transparent, {}};
  BackgroundChoice choice{Background::color, {}};
  if (text.starts_with('#')) {
    unsigned value = 0;
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data() + 1, end, value, 16);
    if (text.size() != 7 || result.ec != std::errc() || result.ptr != end)
      throw usage_error("--background '{}': expected #rrggbb, six hexadecimal digits", text);
    const float encoded[3] = {static_cast<float>(value >> 16) / 255.0f, static_cast<float>((value >> 8) & 255) / 255.0f,
                              static_cast<float>(value & 255) / 255.0f};
    kernels.evaluate(MathFunction::srgb_to_linear, encoded, encoded, choice.color, 3);
    return choice;
  }
  if (text.find(',') == std::string_view::npos)
    throw usage_error("--background '{}': expected env, transparent, a colour #rrggbb (sRGB) or r,g,b (linear)", text);
  set_position(choice.color, "--background", text);
  return choice;
}

Light parse_light(const std::string& text) {
  constexpr std::string_view what = "--light";
  const std::vector<std::string_view> parts = split(text, ':');
  Light light;
  std::string_view usage;
  std::size_t fields = 3;  // before the colour
  if (parts[0] == "point") {
    light.type = LightType::point;
    usage = "point:x,y,z:candela[:r,g,b]";
  } else if (parts[0] == "directional") {
    light.type = LightType::directional;
    usage = "directional:dx,dy,dz:lux[:r,g,b]";
  } else if (parts[0] == "spot") {
    light.type = LightType::spot;
    usage = "spot:x,y,z:dx,dy,dz:candela:inner,outer[:r,g,b]";
    fields = 5;
  } else {
    throw usage_error("--light '{}': unknown kind '{}'; expected point, directional or spot", text, parts[0]);
  }
  if (parts.size() != fields && parts.size() != fields + 1) throw usage_error("--light '{}': expected {}", text, usage);

  if (light.type == LightType::directional)
    set_direction(light.direction, what, parts[1]);
  else
    set_position(light.position, what, parts[1]);
  if (light.type == LightType::spot) set_direction(light.direction, what, parts[2]);
  const double intensity = parse_numbers(what, parts[light.type == LightType::spot ? 3 : 2], 1, 1)[0];
  if (!(intensity >= 0)) throw usage_error("--light '{}': the intensity must not be negative", text);
  light.intensity = static_cast<float>(intensity);
  if (light.type == LightType::spot) {
    const std::vector<double> cone = parse_numbers(what, parts[4], 2, 2);
    if (!(cone[0] >= 0 && cone[0] < cone[1] && cone[1] <= 90))
      throw usage_error("--light '{}': cone '{}': expected 0 <= inner < outer <= 90, degrees from the axis", text,
                        parts[4]);
    light.inner_cone_angle = static_cast<float>(cone[0] * radians_per_degree);
    light.outer_cone_angle = static_cast<float>(cone[1] * radians_per_degree);
  }
  if (parts.size() > fields) set_position(light.color, what, parts[fields]);
  for (const float c : light.color)
    if (!(c >= 0)) throw usage_error("--light '{}': colour components must not be negative", text);
  return light;
}

ToneCurve parse_tone_curve(std::string_view text) {
  if (text == "none") return ToneCurve::none;
  if (text == "reinhard") return ToneCurve::reinhard;
  if (text == "aces") return ToneCurve::aces;
  if (text == "khronos-neutral") return ToneCurve::khronos_neutral;
  throw usage_error("--tonemap '{}': expected none, reinhard, aces or khronos-neutral", text);
}

std::vector<std::string> parse_words(std::string_view what, std::string_view text) {
  std::vector<std::string> words;
  for (const std::string_view part : split(text, ',')) {
    if (trim(part).empty()) throw usage_error("{} '{}': expected names with commas between them", what, text);
    words.emplace_back(trim(part));
  }
  return words;
}

}  // namespace tessera::cli

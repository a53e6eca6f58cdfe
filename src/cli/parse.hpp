// What a person types, into values. Each throws Error(usage) that says what was found and what was expected.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "frame/settings.hpp"
#include "kernels/interface.hpp"
#include "scene/light.hpp"

namespace tessera::cli {

inline constexpr double radians_per_degree = 0.017453292519943295;

/// "a,b,c" into that many finite numbers, at least `least` and at most `most`. `what` begins the error message.
std::vector<double> parse_numbers(std::string_view what, std::string_view text, std::size_t least, std::size_t most);
std::array<double, 3> parse_vector(std::string_view what, std::string_view text);

/// "1920x1080"
std::array<int, 2> parse_size(std::string_view text);

/// "env", "transparent", "#rrggbb" (sRGB) or "r,g,b" (linear).
struct BackgroundChoice {
  Background kind = Background::environment;
  float color[3] = {0, 0, 0};  // linear
};
BackgroundChoice parse_background(std::string_view text, const Kernels& kernels);

/// "point:x,y,z:candela[:r,g,b]", "directional:dx,dy,dz:lux[:r,g,b]" or
/// "spot:x,y,z:dx,dy,dz:candela:inner,outer[:r,g,b]"
Light parse_light(const std::string& text);

/// The enumeration's value that `text` is the name of; nothing happens if text is empty.
template <class Enumeration, std::size_t N>
void choose_word(Enumeration& value, const std::array<const char*, N>& names, const char* option,
                 const std::string& text) {
  if (text.empty()) return;
  for (std::size_t k = 0; k < N; ++k)
    if (text == names[k]) {
      value = static_cast<Enumeration>(k);
      return;
    }
  throw usage_error("{} '{}': expected {}", option, text, fmt::join(names, ", "));
}

ToneCurve parse_tone_curve(std::string_view text);

/// "a,b,c" into its words; empty ones are an error.
std::vector<std::string> parse_words(std::string_view what, std::string_view text);

}  // namespace tessera::cli

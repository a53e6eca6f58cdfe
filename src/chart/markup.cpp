#include "chart/markup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "chart/axis.hpp"

namespace tessera::chart {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
  }
  return out;
}

std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string amount(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 1e-3 && size < 1e5) {
    const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(size))));
    return fmt::format("{:.{}f}", value, decimals);
  }
  int exponent = static_cast<int>(std::floor(std::log10(size)));
  std::string mantissa = fmt::format("{:.2f}", value / std::pow(10.0, exponent));
  if (mantissa == "10.00" || mantissa == "-10.00") {
    mantissa.erase(mantissa.find("0.00"), 1);
    ++exponent;
  }
  const std::string power = tick_label(std::pow(10.0, exponent));
  return mantissa + "·" + (exponent >= -3 && exponent <= 4 ? fmt::format("10^{}", exponent) : power);
}

std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "…";
}

std::string filled_in(const std::string& text, const std::vector<std::pair<std::string, std::string>>& values) {
  std::string out;
  std::size_t at = 0;
  for (std::size_t open = text.find("{{"); open != std::string::npos; open = text.find("{{", at)) {
    const std::size_t close = text.find("}}", open);
    const std::string name = text.substr(open + 2, close - open - 2);
    const auto found =
        std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.first == name; });
    if (close == std::string::npos || found == values.end()) throw std::logic_error("no value for {{" + name + "}}");
    out += text.substr(at, open - at) + found->second;
    at = close + 2;
  }
  return out + text.substr(at);
}

}  // namespace tessera::chart

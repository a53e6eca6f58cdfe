#include "chart/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera::chart {
namespace {

constexpr double sparse_decades = 1.6;  // below this, decades alone would leave an axis with one label or none
constexpr double slack = 1e-9;          // decades: a bound that is a power of ten must not lose its tick to rounding

std::string superscript(int exponent) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[digit - '0'];
  return text;
}

}  // namespace

double LogAxis::at(double value) const { return from + (std::log10(value) - low) / (high - low) * (to - from); }

std::string tick_label(double value) {
  const int decade = static_cast<int>(std::floor(std::log10(value) + slack));
  if (decade >= -3 && decade <= 4) return fmt::format("{:.6g}", value);
  const double mantissa = value / std::pow(10.0, decade);
  const std::string power = "10" + superscript(decade);
  return std::abs(mantissa - 1) < 1e-6 ? power : fmt::format("{:.3g}·{}", mantissa, power);
}

std::vector<Tick> LogAxis::ticks(int most) const {
  std::vector<Tick> ticks;
  const int first = static_cast<int>(std::floor(low)), last = static_cast<int>(std::ceil(high));
  const bool between = high - low < sparse_decades;
  const int step = std::max(1, static_cast<int>(std::ceil((high - low) / most)));
  for (int decade = first; decade <= last; ++decade)
    for (int digit = 1; digit <= 9; ++digit) {
      const double position = decade + std::log10(digit);
      if (position < low - slack || position > high + slack) continue;
      if (digit > 1 && step > 1) continue;
      // Not digit * pow(10, decade): 3 * 0.1 would not be 0.3.
      const double value = decade < 0 ? digit / std::pow(10.0, -decade) : digit * std::pow(10.0, decade);
      const bool major = digit == 1 ? decade % step == 0 : between && (digit == 2 || digit == 5);
      ticks.push_back({value, major, major ? tick_label(value) : ""});
    }
  return ticks;
}

LogAxis axis_over(const std::vector<double>& values, double least, double margin, double from, double to) {
  double low = INFINITY, high = -INFINITY;
  for (const double value : values)
    if (value > 0 && std::isfinite(value)) {
      low = std::min(low, std::log10(value));
      high = std::max(high, std::log10(value));
    }
  if (low > high) {
    low = 0;
    high = 1;
  }
  const double missing = least - (high - low);
  if (missing > 0) {
    low -= missing / 2;
    high += missing / 2;
  }
  const double room = (high - low) * margin;
  return {low - room, high + room, from, to};
}

}  // namespace tessera::chart

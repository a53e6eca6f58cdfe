#include "bench/chart/error_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "chart/axis.hpp"
#include "chart/markup.hpp"
#include "chart/style.hpp"

namespace tessera::chart {
namespace {

struct Rgb {
  double r, g, b;
};
// From no error to the largest. Lightness falls steadily, so the order survives without colour vision: light to dark
// through yellow, orange and purple; towards negative, through blue.
constexpr Rgb positive[] = {{247, 247, 245}, {253, 224, 155}, {246, 150, 79},
                            {198, 59, 87},   {103, 18, 92},   {36, 8, 48}};
constexpr Rgb negative[] = {{247, 247, 245}, {178, 222, 224}, {94, 176, 206},
                            {38, 116, 181},  {28, 58, 129},   {8, 20, 58}};

std::uint32_t color_at(const Rgb (&stops)[6], double share) {
  const double at = std::clamp(share, 0.0, 1.0) * 5;
  const auto i = std::min<std::size_t>(4, static_cast<std::size_t>(at));
  const double t = at - static_cast<double>(i);
  const auto mix = [&](double Rgb::*channel) {
    return static_cast<std::uint32_t>(std::lround(stops[i].*channel * (1 - t) + stops[i + 1].*channel * t));
  };
  return mix(&Rgb::r) << 16 | mix(&Rgb::g) << 8 | mix(&Rgb::b);
}

std::string text(double x, double y, const char* anchor, const std::string& words, const char* cls = "tick") {
  return fmt::format(R"(<text class="{}" x="{}" y="{}" text-anchor="{}">{}</text>)", cls, coordinate(x), coordinate(y),
                     anchor, escaped(words));
}

std::string brief(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : "?"; }

}  // namespace

std::vector<MapGroup> map_groups(const Plot& plot) {
  std::map<std::string, int> methods_with;  // a map of this title
  for (const Point& point : plot.points)
    for (const ErrorMap& map : point.maps) ++methods_with[map.title];
  std::vector<MapGroup> groups;
  for (const Point& point : plot.points)
    for (const ErrorMap& map : point.maps) {
      if (map.columns.empty() || map.rows.empty()) continue;
      const std::string title = methods_with[map.title] > 1 ? map.title : map.row_name + " against " + map.column_name;
      auto group = std::find_if(groups.begin(), groups.end(), [&](const MapGroup& g) { return g.title == title; });
      if (group == groups.end()) group = groups.insert(groups.end(), {title, {}, {}});
      group->members.push_back({&point, &map});
    }
  for (MapGroup& group : groups) {
    std::vector<const ErrorMap*> maps;
    for (const MapGroup::Member& member : group.members) maps.push_back(member.map);
    group.scale = scale_of(maps);
  }
  return groups;
}

MapScale scale_of(const std::vector<const ErrorMap*>& maps) {
  MapScale scale;
  for (const ErrorMap* map : maps)
    for (const double value : map->values) {
      if (!std::isfinite(value)) continue;
      scale.largest = std::max(scale.largest, std::abs(value));
      scale.two_sided = scale.two_sided || value < 0;
    }
  return scale;
}

std::uint32_t map_color(const MapScale& scale, double value) {
  if (!std::isfinite(value)) return not_finite_color;
  if (value == 0 || scale.largest == 0) return color_at(positive, 0);
  const double share = 1 + std::log10(std::abs(value) / scale.largest) / map_decades;
  return value < 0 ? color_at(negative, share) : color_at(positive, share);
}

std::string map_png(const ErrorMap& map, const MapScale& scale) {
  std::vector<std::uint32_t> pixels;
  pixels.reserve(map.values.size());
  for (std::size_t row = map.rows.size(); row-- > 0;)
    for (std::size_t column = 0; column < map.columns.size(); ++column)
      pixels.push_back(map_color(scale, map.values[row * map.columns.size() + column]));
  return png_of_pixels(static_cast<int>(map.columns.size()), static_cast<int>(map.rows.size()), pixels);
}

std::string draw_scale(const MapScale& scale, double width) {
  constexpr double bar_y = 4, bar_height = 12;
  constexpr int steps = 96;
  std::string out;
  const double inset = 30, length = width - 2 * inset;
  const double low = scale.two_sided ? -1 : 0;  // the bar runs from low to 1, in shares of the scale
  for (int i = 0; i < steps; ++i) {
    const double share = low + (i + 0.5) / steps * (1 - low);
    const double value = std::copysign(std::pow(10.0, (std::abs(share) - 1) * map_decades), share) * scale.largest;
    out += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="#{:06x}"/>)",
                       coordinate(inset + length * i / steps), coordinate(bar_y), coordinate(length / steps + 0.6),
                       coordinate(bar_height), map_color(scale, value));
  }
  if (scale.largest == 0) return out + text(width / 2, bar_y + 30, "middle", "0 everywhere");
  for (int sign = scale.two_sided ? -1 : 1; sign <= 1; sign += 2)
    for (int decade = 0; decade < map_decades; decade += scale.two_sided ? 2 : 1) {
      const double share = sign * (1 - static_cast<double>(decade) / map_decades);
      const double x = inset + (share - low) / (1 - low) * length;
      const std::string label = amount(scale.largest * std::pow(10.0, -decade));
      out += text(x, bar_y + 30, "middle", sign < 0 ? "−" + label : label);
    }
  return out + text(inset - low / (1 - low) * length, bar_y + 30, "middle", "0");
}

std::string standalone_map(const ErrorMap& map, const MapScale& scale, const std::string& title,
                           const std::string& subtitle) {
  if (map.columns.empty() || map.rows.empty()) return "";
  constexpr double left = 62, top = 62, side = 320, width = left + side + 38, bottom = top + side;
  constexpr double height = bottom + 100;
  std::string out = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="{0}" height="{1}" viewBox="0 0 {0} {1}">)",
      width, height);
  out += std::string("<style>") + plot_css + "</style><rect class=\"paper\" width=\"100%\" height=\"100%\"/>";
  out += text(20, 26, "start", title, "map-title") + text(20, 46, "start", subtitle, "subtitle");
  out += fmt::format(
      R"(<image x="{}" y="{}" width="{}" height="{}" preserveAspectRatio="none" style="image-rendering:pixelated" xlink:href="data:image/png;base64,{}"/>)",
      left, top, side, side, base64(map_png(map, scale)));
  constexpr int labels = 4;
  for (int i = 0; i <= labels; ++i) {
    const auto index = [&](std::size_t count) { return (count - 1) * static_cast<std::size_t>(i) / labels; };
    const double share = static_cast<double>(i) / labels;
    out += text(left + share * side, bottom + 17, "middle", brief(map.columns[index(map.columns.size())]));
    out += text(left - 6, bottom - share * side + 4, "end", brief(map.rows[index(map.rows.size())]));
  }
  out += text(left + side / 2, bottom + 36, "middle", map.column_name, "axis");
  out += fmt::format(R"~(<text class="axis" text-anchor="middle" transform="translate(18 {}) rotate(-90)">{}</text>)~",
                     top + side / 2, escaped(map.row_name));
  out += fmt::format(R"~(<g transform="translate({} {})">{}</g></svg>)~", left - 30, bottom + 52,
                     draw_scale(scale, side + 60));
  return out + "\n";
}

}  // namespace tessera::chart

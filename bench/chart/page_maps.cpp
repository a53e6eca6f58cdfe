#include <fmt/format.h>

#include <cmath>

#include "bench/chart/error_map.hpp"
#include "bench/chart/markup.hpp"
#include "bench/chart/page.hpp"

namespace tessera::chart {
namespace {

struct Shown {
  const Point* point;
  const ErrorMap* map;
};

// Maps of the same title, over all methods: one gallery with one scale.
std::vector<std::pair<std::string, std::vector<Shown>>> galleries_of(const Plot& plot) {
  std::vector<std::pair<std::string, std::vector<Shown>>> galleries;
  for (const Point& point : plot.points)
    for (const ErrorMap& map : point.maps) {
      if (map.columns.empty() || map.rows.empty()) continue;
      std::size_t i = 0;
      while (i < galleries.size() && galleries[i].first != map.title) ++i;
      if (i == galleries.size()) galleries.push_back({map.title, {}});
      galleries[i].second.push_back({&point, &map});
    }
  return galleries;
}

std::string worst_of(const ErrorMap& map) {
  std::size_t worst = 0;
  const auto size = [&](std::size_t i) { return std::isfinite(map.values[i]) ? std::abs(map.values[i]) : 0.0; };
  for (std::size_t i = 1; i < map.values.size(); ++i)
    if (size(i) > size(worst)) worst = i;
  if (size(worst) == 0) return "0 everywhere";
  return fmt::format("largest {} at {} {}, {} {}", amount(map.values[worst]), map.column_name,
                     amount(map.columns[worst % map.columns.size()]), map.row_name,
                     amount(map.rows[worst / map.columns.size()]));
}

std::string figure(const Shown& shown, const MapScale& scale) {
  const std::string worst = escaped(worst_of(*shown.map)), title = escaped(shown.point->title);
  return fmt::format(
      R"(<figure><img src="data:image/png;base64,{}" width="{}" height="{}" alt="Error map of {}: {}"><figcaption><b>{}</b> {}</figcaption></figure>)",
      base64(map_png(*shown.map, scale)), shown.map->columns.size(), shown.map->rows.size(), title, worst, title,
      worst);
}

}  // namespace

std::string page_maps(const Plot& plot) {
  std::string out;
  for (const auto& [title, list] : galleries_of(plot)) {
    std::vector<const ErrorMap*> maps;
    bool finite = true;
    for (const Shown& shown : list) {
      maps.push_back(shown.map);
      for (const double value : shown.map->values) finite = finite && std::isfinite(value);
    }
    const MapScale scale = scale_of(maps);
    const ErrorMap& first = *maps.front();
    out += fmt::format(
        R"(<details class="maps" open><summary><h4>Where it fails: {}</h4></summary><p>Across: {}, {} to {}. Up: {}, {} to {}. )"
        "One logarithmic scale for all, largest colour {}{}{}</p>",
        escaped(title), escaped(first.column_name), amount(first.columns.front()), amount(first.columns.back()),
        escaped(first.row_name), amount(first.rows.front()), amount(first.rows.back()), amount(scale.largest),
        scale.two_sided ? "; blue is too small, orange too large." : ".", finite ? "" : " Magenta: not a number.");
    out += R"(<svg class="scale" viewBox="0 0 420 42" role="img" aria-label="Colour scale">)" + draw_scale(scale, 420) +
           "</svg>";
    out += "<div class=\"gallery\">";
    for (const Shown& shown : list) out += figure(shown, scale);
    out += "</div></details>\n";
  }
  return out;
}

}  // namespace tessera::chart

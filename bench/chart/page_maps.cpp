#include <fmt/format.h>

#include <cmath>

#include "bench/chart/error_map.hpp"
#include "bench/chart/page.hpp"
#include "chart/markup.hpp"

namespace tessera::chart {
namespace {

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

std::string figure(const MapGroup::Member& member, const MapGroup& group) {
  const ErrorMap& map = *member.map;
  const std::string worst = escaped(worst_of(map)), title = escaped(member.point->title);
  const bool own_title = map.title != group.title && map.title != member.point->title;
  return fmt::format(R"(<figure><img src="data:image/png;base64,{}" width="{}" height="{}" alt="Error map of {}: {}">)"
                     R"(<figcaption><b>{}</b> {}{}</figcaption></figure>)",
                     base64(map_png(map, group.scale)), map.columns.size(), map.rows.size(), title, worst, title,
                     own_title ? escaped(map.title) + ": " : "", worst);
}

}  // namespace

std::string page_maps(const Plot& plot) {
  std::string out;
  for (const MapGroup& group : map_groups(plot)) {
    bool finite = true;
    for (const MapGroup::Member& member : group.members)
      for (const double value : member.map->values) finite = finite && std::isfinite(value);
    const ErrorMap& first = *group.members.front().map;
    out += fmt::format(
        R"(<details class="maps" open><summary><h4>Where it fails: {}</h4></summary><p>Across: {}, {} to {}. Up: {}, {} )"
        "to {}. One logarithmic scale for all{}{}</p>",
        escaped(group.title), escaped(first.column_name), amount(first.columns.front()), amount(first.columns.back()),
        escaped(first.row_name), amount(first.rows.front()), amount(first.rows.back()),
        group.scale.two_sided ? "; blue is too small, orange too large." : ".",
        finite ? "" : " Magenta: not a number.");
    out += R"(<svg class="scale" viewBox="0 0 420 42" role="img" aria-label="Colour scale">)" +
           draw_scale(group.scale, 420) + "</svg><div class=\"gallery\">";
    for (const MapGroup::Member& member : group.members) out += figure(member, group);
    out += "</div></details>\n";
  }
  return out;
}

}  // namespace tessera::chart

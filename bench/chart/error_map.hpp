// Error maps as pictures. All maps of a plot that show the same thing share one scale, so that they can be compared.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bench/chart/chart.hpp"
#include "bench/chart/raster.hpp"

namespace tessera::chart {

/// Logarithmic from `largest` down over map_decades, below that as zero; two-sided if any value is negative.
struct MapScale {
  double largest = 0;
  bool two_sided = false;
};
inline constexpr int map_decades = 4;

/// Maps of a plot that belong side by side under one scale: those of the same title, if several methods have one of it;
/// else those with the same axes.
struct MapGroup {
  struct Member {
    const Point* point;
    const ErrorMap* map;
  };
  std::string title;
  std::vector<Member> members;
  MapScale scale;
};
std::vector<MapGroup> map_groups(const Plot& plot);

MapScale scale_of(const std::vector<const ErrorMap*>& maps);

/// 0xRRGGBB; what is no finite number has a colour of its own, not_finite_color.
std::uint32_t map_color(const MapScale& scale, double value);
inline constexpr std::uint32_t not_finite_color = 0xFF00FF;

/// The values alone, one pixel each, the first row at the bottom.
std::string map_png(const ErrorMap& map, const MapScale& scale);

/// A colour bar with its values, as SVG content for a width of `width` pixels and a height of 42.
std::string draw_scale(const MapScale& scale, double width);

/// A file of its own: title, map with axes, scale.
std::string standalone_map(const ErrorMap& map, const MapScale& scale, const std::string& title,
                           const std::string& subtitle);

}  // namespace tessera::chart

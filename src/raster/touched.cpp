#include "raster/touched.hpp"

#include <algorithm>

namespace tessera {
namespace {

constexpr std::int64_t tile_units = std::int64_t{tile_size} << subpixel_bits;
constexpr int last_pixel = (tile_size - 1) << subpixel_bits;

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {  // b > 0
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

}  // namespace

TileScreen::TileScreen(int frame_width, int frame_height, const SamplePattern& pattern)
    : width(frame_width),
      height(frame_height),
      columns((frame_width + tile_size - 1) / tile_size),
      rows((frame_height + tile_size - 1) / tile_size) {
  const auto [left, right] = std::minmax_element(pattern.x, pattern.x + pattern.count);
  const auto [top, bottom] = std::minmax_element(pattern.y, pattern.y + pattern.count);
  x_min = *left, x_max = *right, y_min = *top, y_max = *bottom;
}

void TouchedTiles::set_edges(const TileScreen& screen, const SetupTriangle& t) {
  for (int e = 0; e < 3; ++e) {  // as kernels/raster/edges.hpp defines them
    const int next = (e + 1) % 3;
    const std::int64_t a = t.y[next] - t.y[e], b = t.x[e] - t.x[next];
    const std::int64_t best_x = a > 0 ? last_pixel + screen.x_max : screen.x_min;
    const std::int64_t best_y = b > 0 ? last_pixel + screen.y_max : screen.y_min;
    const int bias = a > 0 || (a == 0 && b > 0) ? 0 : -1;
    a_[e] = a;
    b_[e] = b;
    most_[e] = a * (best_x - t.x[e]) + b * (best_y - t.y[e]) + bias;
  }
}

TileRange TouchedTiles::row_within_edges(int row) const {
  std::int64_t first = box_.first, last = box_.last;
  for (int e = 0; e < 3; ++e) {  // a * tile_units * column + most >= 0
    const std::int64_t most = most_[e] + b_[e] * tile_units * row, step = a_[e] * tile_units;
    if (step > 0) {
      first = std::max(first, -floor_divide(most, step));
    } else if (step < 0) {
      last = std::min(last, floor_divide(most, -step));
    } else if (most < 0) {
      return {0, -1};
    }
  }
  return first <= last ? TileRange{static_cast<int>(first), static_cast<int>(last)} : TileRange{0, -1};
}

}  // namespace tessera

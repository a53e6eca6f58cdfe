#include "raster/touched.hpp"

#include <gtest/gtest.h>

#include "kernels/raster/oracle.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::raster_test {
namespace {

// What the header promises, tile by tile: the samples' bounding box against the triangle's, and for triangles beyond
// 2 x 2 tiles that no edge has the tile's whole box of samples outside.
bool touched(const TileScreen& screen, const SamplePattern& pattern, const SetupTriangle& t, int column, int row,
             bool by_edges) {
  const auto [sx0, sx1] = std::minmax_element(pattern.x, pattern.x + pattern.count);
  const auto [sy0, sy1] = std::minmax_element(pattern.y, pattern.y + pattern.count);
  const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const auto meets = [](int tile, int size, int first, int last, int low, int high) {
    for (int p = tile * 32; p < std::min(tile * 32 + 32, size); ++p)
      if (p * 256 + last >= low && p * 256 + first < high) return true;
    return false;
  };
  const bool in_box =
      meets(column, screen.width, *sx0, *sx1, left, right) && meets(row, screen.height, *sy0, *sy1, top, bottom);
  if (!in_box || !by_edges) return in_box;
  for (int e = 0; e < 3; ++e) {
    const int i = e, j = (e + 1) % 3;
    bool any = false;
    for (const int x : {column * 8192 + *sx0, column * 8192 + 31 * 256 + *sx1})
      for (const int y : {row * 8192 + *sy0, row * 8192 + 31 * 256 + *sy1}) {
        const __int128 side = static_cast<__int128>(x - t.x[i]) * (t.y[j] - t.y[i]) -
                              static_cast<__int128>(y - t.y[i]) * (t.x[j] - t.x[i]);
        const bool owned = t.y[j] > t.y[i] || (t.y[j] == t.y[i] && t.x[j] < t.x[i]);
        any |= side > 0 || (side == 0 && owned);
      }
    if (!any) return false;
  }
  return true;
}

TEST(TouchedTiles, EqualsABruteForceSearch) {
  Random random(1);
  int listed = 0, left_out = 0;
  for (const int samples : {1, 4, 16}) {
    const SamplePattern pattern = runnable_kernels().front()->sample_pattern(samples);
    const TileScreen screen(500, 333, pattern);
    for (int i = 0; i < 1000; ++i) {
      const int extent = 1 << random.between(8, i % 10 == 0 ? 22 : 17);
      const int x = random.between(-extent, 500 * 256), y = random.between(-extent, 333 * 256);
      const auto off = [&] { return random.between(0, extent); };
      const int x0 = x + off(), y0 = y + off(), x1 = x + off(), y1 = y + off(), x2 = x + off();
      SetupTriangle t = make_triangle(x0, y0, x1, y1, x2, y + off());
      if (!orient(t)) continue;
      int columns[2] = {999, -1}, rows[2] = {999, -1};  // of the bounding box alone
      for (int row = 0; row < screen.rows; ++row)
        for (int column = 0; column < screen.columns; ++column)
          if (touched(screen, pattern, t, column, row, false)) {
            columns[0] = std::min(columns[0], column), columns[1] = std::max(columns[1], column);
            rows[0] = std::min(rows[0], row), rows[1] = std::max(rows[1], row);
          }
      const bool by_edges = columns[1] - columns[0] > 1 || rows[1] - rows[0] > 1;
      const TouchedTiles tiles(screen, t);
      for (int row = 0; row < screen.rows; ++row) {
        const bool in_rows = row >= tiles.first_row() && row <= tiles.last_row();
        const TileRange range = in_rows ? tiles.row(row) : TileRange{0, -1};
        for (int column = 0; column < screen.columns; ++column) {
          const bool expected = touched(screen, pattern, t, column, row, by_edges);
          ASSERT_EQ(column >= range.first && column <= range.last, expected) << i << ": " << column << ',' << row;
          ++(expected ? listed : left_out);
        }
      }
    }
  }
  EXPECT_GT(listed, 5000);
  EXPECT_GT(left_out, 10000);
}

}  // namespace
}  // namespace tessera::raster_test

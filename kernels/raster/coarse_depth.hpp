// Depths that blocks of a tile are known not to lie behind, so that what is hidden is not drawn.
#pragma once
#include "kernels/raster/coverage.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// The triangle's greatest depth in a block. Depth is monotonic along x and along y, rounding included, so that it is
/// that of a corner.
TESSERA_INLINE float greatest_depth(const VisibilityTile& tile, const SetupTriangle& t, const SampleExtent& extent,
                                    int block_x, int block_y) {
  const DepthPlane<float> plane(t);
  const bool right = t.depth_dx > 0, below = t.depth_dy > 0;
  const float x = from_vertex(tile.x << subpixel_bits, block_x + (right ? block_width - 1 : 0),
                              right ? extent.x_max : extent.x_min, t.x[0]);
  const float y = from_vertex(tile.y << subpixel_bits, block_y + (below ? block_height - 1 : 0),
                              below ? extent.y_max : extent.y_min, t.y[0]);
  return plane.at(plane.along_x(x), y);
}

/// For each block a depth that no sample of it lies behind. Only ever too far: drawing brings samples nearer.
struct CoarseDepth {
  float least[blocks_per_tile];

  TESSERA_INLINE CoarseDepth() {
    for (float& depth : least) depth = 0;  // of a cleared tile
  }
  /// Which blocks of 4 x 4 pixels of a group (draw.hpp) lie in hidden blocks, as bits.
  TESSERA_INLINE std::uint32_t hidden(const VisibilityTile& tile, const SetupTriangle& t, const SampleExtent& extent,
                                      int group_x, int group_y) const {
    std::uint32_t out = 0;
    for (int k = 0; k < 4; ++k) {
      const int y = group_y + k * block_height;
      const int block = y / block_height * block_columns + group_x / block_width;
      if (greatest_depth(tile, t, extent, group_x, y) < least[block]) out |= 0xfu << (4 * k);
    }
    return out;
  }
  /// Reads again those blocks whose blocks of 4 x 4 pixels are all in `filled`.
  TESSERA_INLINE void refresh(const VisibilityTile& tile, int group_x, int group_y, std::uint32_t filled, int samples) {
    for (int k = 0; k < 4; ++k)
      if ((filled >> (4 * k) & 0xfu) == 0xfu)
        refresh(tile, (group_y / block_height + k) * block_columns + group_x / block_width, samples);
  }
  TESSERA_INLINE void refresh(const VisibilityTile& tile, int block, int samples) {
    const float* first = tile.depth + block * block_pixels;
    Float nearest = load<Float>(first);
    for (int s = 0; s < samples; ++s)
      for (int i = 0; i < block_pixels; i += Float::lanes)
        nearest = min(nearest, load<Float>(first + s * tile_pixels + i));
    alignas(64) float lanes[Float::lanes];
    store(lanes, nearest);
    float depth = lanes[0];
    for (const float lane_depth : lanes) depth = lane_depth < depth ? lane_depth : depth;
    least[block] = depth;
  }
};

}  // namespace
}  // namespace tessera::TESSERA_ISA

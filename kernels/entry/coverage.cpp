#include "kernels/raster/coverage.hpp"

#include "kernels/entry/entries.hpp"
#include "kernels/raster/fragments.hpp"
#include "kernels/raster/list.hpp"
#include "kernels/raster/pattern.hpp"

namespace tessera::TESSERA_ISA {

SamplePattern sample_pattern(int samples) { return standard_pattern(samples); }

void clear_visibility(const VisibilityTile& tile) {
  const Float far(0);
  const Int nothing(no_triangle);
  for (int i = 0; i < tile.samples * tile_pixels; i += Float::lanes) {
    store(tile.depth + i, far);
    store(reinterpret_cast<std::int32_t*>(tile.triangle) + i, nothing);
  }
}

void rasterize_opaque(const RasterizeArgs& args, RasterCounters* counters) {
  const SamplePattern pattern = standard_pattern(args.tile.samples);
  const SampleExtent extent = sample_extent(pattern);
  const auto draw = [&](const auto& counter) {
    if (pattern.count == 1) {
      rasterize_list<1>(args, pattern, extent, counter);
    } else {
      rasterize_list<0>(args, pattern, extent, counter);
    }
  };
  if (counters == nullptr) return draw(CountNothing{});
  RasterCounters sum = *counters;
  draw(CountSamples{sum});
  *counters = sum;
}

std::uint32_t collect_triangle(const VisibilityTile& tile, const SetupTriangle& triangle, bool split_samples,
                               Fragment* out) {
  return triangle_fragments(tile, triangle, standard_pattern(tile.samples), split_samples, out);
}

void commit_fragments(const VisibilityTile& tile, const SetupTriangle& triangle, const Fragment* fragments,
                      const std::uint8_t* keep, std::uint32_t count) {
  write_fragments(tile, triangle, standard_pattern(tile.samples), fragments, keep, count);
}

std::uint32_t collect_visible(const VisibilityTile& tile, Fragment* out) {
  return tile.samples == 1 ? visible_single(tile, out) : visible_multi(tile, out);
}

}  // namespace tessera::TESSERA_ISA

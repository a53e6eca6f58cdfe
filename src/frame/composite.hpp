// From shaded fragments to the pixels of a tile.
#pragma once
#include "frame/fragments.hpp"
#include "frame/settings.hpp"
#include "frame/view.hpp"

namespace tessera {

/// Everything behind the surfaces, and where the pixels go.
struct TileFilm {
  int x, y, width, height;  // of the tile, in pixels
  float* rgba;              // of the tile's first pixel
  std::size_t row_stride;   // in floats
};

struct BackgroundSource {
  Background kind = Background::color;
  float color[3] = {0, 0, 0};
  CubeView cube{};
  float lod = 0;
};

/// A tile's pixels while they are put together, as it numbers them. Scratch of one thread.
struct TilePixels {
  alignas(64) float rgba[4][tile_pixels];  // planes
  alignas(64) float remaining[tile_pixels];
};

/// Blends the fragments of each pixel front to back, sample by sample:  C += T alpha L,  T *= 1 - alpha  (Porter & Duff
/// 1984, "over"), averages the samples. `fragments` as TileFragments sorts them. What light passes through is left in
/// pixels.remaining (0 .. 1).
void composite_surfaces(const TileFragments& fragments, int samples, TilePixels& pixels);

/// Fills in the background where something remains, and writes the tile to the film.
void composite_background(const BackgroundSource& background, const View& view, const Kernels& kernels,
                          TilePixels& pixels, const TileFilm& film);

/// The same of a tile without fragments: nothing but background.
void background_alone(const BackgroundSource& background, const View& view, const Kernels& kernels, TilePixels& pixels,
                      const TileFilm& film);

}  // namespace tessera

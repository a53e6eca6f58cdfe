// What a frame gives beside the picture: AOV layers and the G-buffer.
#pragma once
#include <string>
#include <vector>

#include "frame/fragments.hpp"
#include "frame/frame.hpp"

namespace tessera {

/// Layers of these names, width * height, set to what they hold where nothing is seen. Throws Error(usage) for an
/// unknown name.
std::vector<AovLayer> make_aov_layers(const std::vector<std::string>& names, int width, int height);

/// Fills the tile's pixels of every layer from the fragment that covers most of each pixel.
void capture_aovs(std::vector<AovLayer>& layers, const TileFragments& tile, const TileRect& rect, int picture_width,
                  const Scene& scene, const ViewTransform& view, int samples);

/// Collects the fragments of all tiles, which may come from any thread, one call a tile; then puts them into raster
/// order.
class GBufferCapture {
 public:
  GBufferCapture(int width, int height, int samples);
  void add(const TileFragments& tile, const TileRect& rect);
  /// Moves everything into `out`.
  void finish(GBufferImage& out);

 private:
  struct Piece {
    TileRect rect{};
    std::vector<Fragment> fragments;
    std::vector<float> planes;  // gbuffer_planes planes of fragments.size()
  };
  int width_, height_, samples_, tiles_x_;
  std::vector<Piece> pieces_;
};

/// Loads the part of a G-buffer that lies in a tile, ready for shading and compositing.
void load_tile(const GBufferImage& gbuffer, const std::vector<std::size_t>& first_of_row_pixel, const TileRect& rect,
               TileFragments& out);

}  // namespace tessera

// From a prepared scene to a film: vertices, triangles, bins, then tile by tile. Knows neither files nor materials as a
// person describes them: Renderer (frame.hpp) prepares those, and so can anyone who has arrays of his own.
#pragma once
#include <functional>
#include <span>

#include "base/image.hpp"
#include "frame/capture.hpp"
#include "frame/composite.hpp"
#include "frame/settings.hpp"
#include "frame/statistics.hpp"
#include "frame/tile_loop.hpp"
#include "frame/view.hpp"
#include "kernels/interface.hpp"
#include "raster/geometry.hpp"

namespace tessera {

/// What a frame reads of a scene: plain views of memory that whoever filled them in keeps.
struct PreparedScene {
  GeometryView geometry;
  std::span<const MaterialView> materials;     // per binding, as the two below
  std::span<const std::uint8_t> double_sided;  // 1: back faces are kept
  std::span<const AlphaMode> alpha_modes;
  LightingView lighting;
};

/// Keeps its memory from frame to frame.
class FramePipeline {
 public:
  using TileVisitor = std::function<void(const TileFragments&, const TileRect&)>;

  /// Fills the film, whose size settings.width and height are, on the threads of the caller's arena, and the statistics
  /// of what it did. `visit`, if any, sees every tile's shaded fragments, on any thread.
  void render(const PreparedScene& scene, const View& view, const RenderSettings& settings,
              const BackgroundSource& background, const Kernels& kernels, const FilmView& film,
              FrameStatistics& statistics, const TileVisitor& visit = {});

 private:
  GeometryStage geometry_;
  TileLoop tiles_;
  std::vector<std::uint64_t> row_hashes_;
};

}  // namespace tessera

// One tile from its triangle lists to shaded fragments, on one thread: coverage, alpha test, visibility, G-buffer,
// shading.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/image.hpp"
#include "base/stage_clock.hpp"
#include "frame/fragment_sorter.hpp"
#include "frame/fragments.hpp"
#include "kernels/interface.hpp"
#include "raster/bins.hpp"

namespace tessera {

/// Lights and environment as kernels read them.
struct LightingView {
  std::span<const LightView> lights;
  EnvironmentView environment{};  // read only if features has feature_environment
  DfgView dfg{};
  std::uint32_t features = 0;  // what the frame offers: feature_lights, feature_environment
  LightBoundsView bounds{};    // of the lights, if tiles shall look which of them reach their fragments; else count 0
};

/// What all tiles of a frame share.
struct TileInputs {
  const Kernels* kernels;
  GeometryView geometry;
  ViewTransform view;
  SamplePattern pattern;
  std::span<const MaterialView> materials;  // per binding
  LightingView lighting;
  EnvironmentShading environment_shading;
  std::span<const SetupTriangle> setup;
  bool all_planes;  // someone looks at the G-buffer: resolve what shading does not read, too
};

class TileWorker {
 public:
  StageClock clock;

  /// The clock has been started. Leaves the tile's shaded fragments, sorted for compositing, in `fragments`; or the
  /// pixels in the film, if fragments.whole.
  void render(const TileInputs& in, const TileRect& rect, const TileLists& lists, const FilmView& film);

  TileFragments fragments;
  [[nodiscard]] std::size_t bytes() const;

 private:
  void draw_masked(const TileInputs& in, const VisibilityTile& tile, std::span<const std::uint32_t> list);
  void collect(const TileInputs& in, const VisibilityTile& tile, std::span<const std::uint32_t> blend);
  bool one_binding(const TileInputs& in, std::uint32_t& binding) const;
  void group_by_binding(const TileInputs& in);
  void shade_runs(const TileInputs& in, const TileRect& rect, const FilmView& film);

  struct Piece {  // candidates of one masked triangle
    std::uint32_t setup, first, count;
  };
  struct Run {  // fragments of one binding, contiguous in the planes
    std::uint32_t binding, first, count;
  };

  ScratchVector<float> depth_;
  ScratchVector<std::uint32_t> ids_;
  ScratchVector<Fragment> candidates_;  // of masked triangles, then of transparent ones
  std::vector<float> alpha_;
  std::vector<std::uint8_t> keep_;
  ScratchVector<Fragment> grouped_;  // by binding: what resolve reads, unless fragments are in order
  std::vector<Piece> pieces_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> run_of_binding_;
  ScratchVector<std::uint32_t> fragment_run_;
  std::size_t opaque_count_ = 0;  // fragments before this one are opaque or masked
  FragmentSorter sorter_;
};

/// Shades slots [first, first + count) of the planes, for their radiance or for a film.
void shade_run(const TileInputs& in, TileFragments& fragments, std::uint32_t first, std::uint32_t count,
               std::uint32_t features, const FilmBlocks& film = {});

}  // namespace tessera

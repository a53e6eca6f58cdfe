// One tile from its triangle lists to shaded fragments, on one thread: coverage, alpha test, visibility, G-buffer,
// shading.
#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "frame/fragments.hpp"
#include "frame/statistics.hpp"
#include "kernels/interface.hpp"
#include "raster/bins.hpp"

namespace tessera {

/// What all tiles of a frame share.
struct TileInputs {
  const Kernels* kernels;
  GeometryView geometry;
  ViewTransform view;
  SamplePattern pattern;
  std::span<const MaterialView> materials;  // per binding
  std::span<const LightView> lights;
  EnvironmentView environment;  // read only if frame_features has feature_environment
  EnvironmentShading environment_shading;
  DfgView dfg;
  std::uint32_t frame_features;
  std::span<const SetupTriangle> setup;
};

/// Adds the time since the last call to a stage.
class StageClock {
 public:
  void start() { last_ = Clock::now(); }
  void lap(TileStage stage) {
    const Clock::time_point now = Clock::now();
    ms_[static_cast<int>(stage)] += std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
  }
  [[nodiscard]] const std::array<double, static_cast<int>(TileStage::count)>& ms() const { return ms_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_;
  std::array<double, static_cast<int>(TileStage::count)> ms_{};
};

class TileWorker {
 public:
  StageClock clock;

  /// Leaves the tile's shaded fragments, sorted for compositing, in `fragments`.
  void render(const TileInputs& in, int x, int y, int width, int height, const TileLists& lists);

  TileFragments fragments;
  [[nodiscard]] std::size_t bytes() const;

 private:
  void draw_masked(const TileInputs& in, const VisibilityTile& tile, std::span<const std::uint32_t> list);
  void collect(const TileInputs& in, const VisibilityTile& tile, std::span<const std::uint32_t> blend);
  void group_by_binding(const TileInputs& in);
  void shade_runs(const TileInputs& in, int x, int y);
  void sort_transparent();

  struct Run {  // fragments of one binding, contiguous in the planes
    std::uint32_t binding, first, count;
  };

  AlignedVector<float> depth_;
  AlignedVector<std::uint32_t> ids_;
  std::vector<Fragment> candidates_;  // of masked triangles, then of transparent ones
  std::vector<float> alpha_;
  std::vector<std::uint8_t> keep_;
  std::vector<Fragment> grouped_;  // by binding: what resolve reads
  std::vector<Run> runs_;
  std::vector<std::uint32_t> run_of_binding_, fragment_run_;
  std::size_t opaque_count_ = 0;  // fragments before this one are opaque or masked
  std::vector<std::uint64_t> sort_keys_;
  std::vector<Fragment> sorted_;
  std::vector<std::uint32_t> sorted_slots_;
};

/// Shades slots [first, first + count) of the planes.
void shade_run(const TileInputs& in, const TileFragments& fragments, std::uint32_t first, std::uint32_t count,
               std::uint32_t features);

}  // namespace tessera

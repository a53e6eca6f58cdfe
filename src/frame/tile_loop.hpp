// All tiles of a frame, on all threads: what both renderings of triangles and of G-buffers do.
#pragma once
#include <atomic>
#include <memory>
#include <vector>

#include "base/image.hpp"
#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "frame/capture.hpp"
#include "frame/composite.hpp"
#include "frame/settings.hpp"
#include "frame/statistics.hpp"
#include "frame/tile.hpp"

namespace tessera {

struct TileGrid {
  int width, height, columns, rows;
  TileGrid(int w, int h)
      : width(w), height(h), columns((w + tile_size - 1) / tile_size), rows((h + tile_size - 1) / tile_size) {}
  [[nodiscard]] std::size_t count() const { return std::size_t(columns) * std::size_t(rows); }
  [[nodiscard]] TileRect rect(std::size_t tile) const {
    const int x = static_cast<int>(tile) % columns * tile_size, y = static_cast<int>(tile) / columns * tile_size;
    return {x, y, std::min(tile_size, width - x), std::min(tile_size, height - y)};
  }
};

/// What a thread keeps from tile to tile, and counts.
struct FrameWorker {
  TileWorker tile;
  TilePixels composite;
  std::uint64_t fragments = 0, pixels = 0, empty = 0;
};

/// Keeps its memory from frame to frame.
class TileLoop {
 public:
  /// Calls body(worker, rect) for every tile, and adds up what the workers counted.
  template <class Body>
  void run(const TileGrid& grid, const RenderSettings& settings, FrameStatistics& statistics, const Body& body) {
    begin(grid, settings);
    std::atomic<std::size_t> done{0};
    parallel_for(grid.count(), [&](std::size_t i) {
      FrameWorker& worker = *workers_[static_cast<std::size_t>(thread_index())];
      worker.tile.clock.start(order_[i]);
      body(worker, grid.rect(order_[i]));
      const std::size_t n = done.fetch_add(1, std::memory_order_relaxed) + 1;
      if (settings.progress && (n % 64 == 0 || n == grid.count())) settings.progress(n, grid.count());
    });
    end(grid, statistics);
  }

 private:
  void begin(const TileGrid& grid, const RenderSettings& settings);
  void end(const TileGrid& grid, FrameStatistics& statistics) const;

  std::vector<std::unique_ptr<FrameWorker>> workers_;  // per thread
  std::vector<std::uint32_t> order_;
  std::uint64_t order_seed_ = 0;
};

/// Shaded fragments to pixels of the film, unless they are there; counts what there was.
void finish_tile(FrameWorker& worker, const TileRect& rect, int samples, const BackgroundSource& background,
                 const View& view, const Kernels& kernels, const FilmView& film);

/// PixelHash over the rows' own hashes, so that threads share the work; `rows` is memory to keep.
std::uint64_t hash_of(const FilmView& film, std::vector<std::uint64_t>& rows);

/// Adds the threads' clocks to the statistics' profile; clock_of(element) is a StageClock.
template <class Threads, class ClockOf>
void add_profile(FrameStatistics& statistics, const Threads& threads, const ClockOf& clock_of) {
  if (statistics.profile.size() < threads.size()) statistics.profile.resize(threads.size());
  for (std::size_t t = 0; t < threads.size(); ++t) {
    const StageClock& clock = clock_of(threads[t]);
    ThreadProfile& to = statistics.profile[t];
    for (std::size_t k = 0; k < to.ticks.size(); ++k) to.ticks[k] += clock.totals()[k];
    to.events.insert(to.events.end(), clock.events().begin(), clock.events().end());
  }
}

/// From first to last: begins the statistics' clock, and turns ticks into milliseconds at the end.
class ProfileScope {
 public:
  explicit ProfileScope(FrameStatistics& statistics) : statistics_(statistics) { statistics.begin_ticks = ticks(); }
  ~ProfileScope();
  ProfileScope(const ProfileScope&) = delete;
  ProfileScope& operator=(const ProfileScope&) = delete;

 private:
  FrameStatistics& statistics_;
  Stopwatch watch_;
};

}  // namespace tessera

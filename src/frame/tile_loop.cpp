#include "frame/tile_loop.hpp"

#include <numeric>

#include "base/hash.hpp"

namespace tessera {
namespace {

// The order in which tiles are taken must not show: tests shuffle it (Fisher-Yates over SplitMix64).
void shuffle(std::vector<std::uint32_t>& order, std::uint64_t seed) {
  const auto next = [&] {
    std::uint64_t z = (seed += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  };
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[next() % i]);
}

}  // namespace

void TileLoop::begin(const TileGrid& grid, const RenderSettings& settings) {
  while (workers_.size() < static_cast<std::size_t>(thread_count()))
    workers_.push_back(std::make_unique<FrameWorker>());
  for (const auto& worker : workers_) {
    worker->fragments = worker->pixels = worker->empty = 0;
    worker->tile.clock.reset(settings.trace);
  }
  if (order_.size() == grid.count() && order_seed_ == settings.tile_order_seed) return;
  order_.resize(grid.count());
  std::iota(order_.begin(), order_.end(), 0u);
  order_seed_ = settings.tile_order_seed;
  if (order_seed_ != 0) shuffle(order_, order_seed_);
}

void TileLoop::end(const TileGrid& grid, FrameStatistics& statistics) const {
  statistics.tiles = grid.count();
  statistics.fragments = statistics.pixels_shaded = statistics.tiles_empty = 0;
  for (const auto& worker : workers_) {
    statistics.fragments += worker->fragments;
    statistics.pixels_shaded += worker->pixels;
    statistics.tiles_empty += worker->empty;
    statistics.working_bytes += worker->tile.bytes();
  }
  add_profile(statistics, workers_, [](const auto& worker) -> const StageClock& { return worker->tile.clock; });
}

void finish_tile(FrameWorker& worker, const TileRect& rect, int samples, const BackgroundSource& background,
                 const View& view, const Kernels& kernels, const FilmView& film) {
  StageClock& clock = worker.tile.clock;
  const TileFragments& tile = worker.tile.fragments;
  worker.fragments += tile.fragments.size();
  if (tile.whole) {  // its pixels are there already
    worker.pixels += tile.fragments.size();
    return;
  }
  const TileFilm out{rect.x, rect.y, rect.width, rect.height, film.at(rect.x, rect.y), std::size_t(film.width) * 4};
  if (tile.fragments.empty()) {
    background_alone(background, view, kernels, worker.composite, out);
    clock.lap(Stage::background);
    ++worker.empty;
    return;
  }
  composite_surfaces(tile, samples, worker.composite);
  clock.lap(Stage::composite);
  composite_background(background, view, kernels, worker.composite, out);
  clock.lap(Stage::background);
  for (std::size_t i = 0; i < tile.fragments.size(); ++i)
    worker.pixels += i == 0 || tile.fragments[i].pixel != tile.fragments[i - 1].pixel;
}

ProfileScope::~ProfileScope() {
  const double ms = watch_.ms();
  statistics_.ticks_per_ms = ms > 0 ? static_cast<double>(ticks() - statistics_.begin_ticks) / ms : 0;
  statistics_.stage_ms = {};
  if (statistics_.ticks_per_ms <= 0) return;
  for (const ThreadProfile& thread : statistics_.profile)
    for (std::size_t k = 0; k < thread.ticks.size(); ++k)
      statistics_.stage_ms[k] += static_cast<double>(thread.ticks[k]) / statistics_.ticks_per_ms;
}

std::uint64_t hash_of(const FilmView& film, std::vector<std::uint64_t>& rows) {
  // A hash waits for its own multiplication at every word: several rows at once keep the multiplier busy.
  constexpr std::size_t together = 8;
  const auto height = static_cast<std::size_t>(film.height), words = std::size_t(film.width) * 4;
  rows.resize(height);
  parallel_for((height + together - 1) / together, [&](std::size_t group) {
    const std::size_t first = group * together, count = std::min(together, height - first);
    PixelHash hashes[together];
    const float* row[together];
    for (std::size_t r = 0; r < together; ++r) row[r] = film.at(0, static_cast<int>(first + std::min(r, count - 1)));
    for (std::size_t i = 0; i < words; ++i)
      for (std::size_t r = 0; r < together; ++r) hashes[r].add(row[r][i]);
    for (std::size_t r = 0; r < count; ++r) rows[first + r] = hashes[r].value();
  });
  PixelHash hash;
  for (const std::uint64_t row : rows) {
    hash.add(static_cast<std::uint32_t>(row));
    hash.add(static_cast<std::uint32_t>(row >> 32));
  }
  return hash.value();
}

}  // namespace tessera

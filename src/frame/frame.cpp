#include "frame/frame.hpp"

#include <atomic>
#include <chrono>
#include <numeric>
#include <optional>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "frame/capture.hpp"
#include "frame/classify.hpp"
#include "frame/composite.hpp"
#include "frame/material.hpp"
#include "frame/tables.hpp"
#include "frame/tile.hpp"
#include "precompute/texture.hpp"
#include "raster/geometry.hpp"

namespace tessera {
namespace {

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct TileGrid {
  int width, height, columns, rows;
  TileGrid(int w, int h)
      : width(w), height(h), columns((w + tile_size - 1) / tile_size), rows((h + tile_size - 1) / tile_size) {}
  [[nodiscard]] std::size_t count() const { return std::size_t(columns) * rows; }
  [[nodiscard]] TileRect rect(std::size_t tile) const {
    const int x = static_cast<int>(tile % columns) * tile_size, y = static_cast<int>(tile / columns) * tile_size;
    return {x, y, std::min(tile_size, width - x), std::min(tile_size, height - y)};
  }
};

// The order in which tiles are taken must not show: tests shuffle it (Fisher-Yates over SplitMix64).
std::vector<std::uint32_t> tile_order(std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  if (seed == 0) return order;
  const auto next = [&] {
    std::uint64_t z = (seed += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  };
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[next() % i]);
  return order;
}

struct Worker {
  TileWorker tile;
  CompositeScratch composite;
  std::uint64_t fragments = 0, pixels = 0, empty = 0;
};

// Calls body(worker, rect) for every tile on all threads, and adds up what the workers counted.
template <class Body>
void for_each_tile(const TileGrid& grid, const RenderSettings& settings, std::vector<std::unique_ptr<Worker>>& workers,
                   FrameStatistics& statistics, const Body& body) {
  while (workers.size() < static_cast<std::size_t>(thread_count())) workers.push_back(std::make_unique<Worker>());
  for (const auto& worker : workers) {
    worker->fragments = worker->pixels = worker->empty = 0;
    worker->tile.clock = {};
  }
  const std::vector<std::uint32_t> order = tile_order(grid.count(), settings.tile_order_seed);
  std::atomic<std::size_t> done{0};
  parallel_for(grid.count(), [&](std::size_t i) {
    body(*workers[thread_index()], grid.rect(order[i]));
    const std::size_t n = done.fetch_add(1, std::memory_order_relaxed) + 1;
    if (settings.progress && (n % 64 == 0 || n == grid.count())) settings.progress(n, grid.count());
  });
  statistics.tiles = grid.count();
  statistics.tile_stage_ms = {};
  statistics.fragments = statistics.pixels_shaded = statistics.tiles_empty = 0;
  for (const auto& worker : workers) {
    statistics.fragments += worker->fragments;
    statistics.pixels_shaded += worker->pixels;
    statistics.tiles_empty += worker->empty;
    statistics.working_bytes += worker->tile.bytes();
    for (std::size_t k = 0; k < statistics.tile_stage_ms.size(); ++k)
      statistics.tile_stage_ms[k] += worker->tile.clock.ms()[k];
  }
}

// Shaded fragments to pixels of the film; counts what there was.
void finish_tile(Worker& worker, const TileRect& rect, int samples, const BackgroundSource& background,
                 const View& view, const Kernels& kernels, Image& film) {
  StageClock& clock = worker.tile.clock;
  clock.start();
  const TileFragments& tile = worker.tile.fragments;
  composite_surfaces(tile, samples, worker.composite);
  clock.lap(TileStage::composite);
  composite_background(background, view, kernels, worker.composite,
                       {rect.x, rect.y, rect.width, rect.height, film.at(rect.x, rect.y), std::size_t(film.width) * 4});
  clock.lap(TileStage::background);
  worker.fragments += tile.fragments.size();
  worker.empty += tile.fragments.empty();
  for (std::size_t i = 0; i < tile.fragments.size(); ++i)
    worker.pixels += i == 0 || tile.fragments[i].pixel != tile.fragments[i - 1].pixel;
}

void resize_film(Image& film, int width, int height) {
  if (film.width != width || film.height != height || film.channels != 4) film = Image(width, height, 4);
}

// Rows are hashed by themselves, so that threads share the work; then the rows' hashes in order.
std::uint64_t hash_of(const Image& film) {
  std::vector<std::uint64_t> rows(film.height);
  parallel_for(rows.size(), [&](std::size_t y) {
    PixelHash hash;
    hash.add(film.at(0, static_cast<int>(y)), std::size_t(film.width) * film.channels);
    rows[y] = hash.value();
  });
  PixelHash hash;
  for (const std::uint64_t row : rows) {
    hash.add(static_cast<std::uint32_t>(row));
    hash.add(static_cast<std::uint32_t>(row >> 32));
  }
  return hash.value();
}

}  // namespace

struct Renderer::State {
  const Scene& scene;
  const Kernels& kernels;
  Lighting lighting;
  TextureSet textures;
  std::vector<MaterialView> materials;
  std::vector<std::uint8_t> double_sided;
  std::vector<AlphaMode> alpha_modes;
  double prepare_ms = 0;

  GeometryStage geometry;
  std::vector<std::unique_ptr<Worker>> workers;

  State(const Scene& s, const Environment* environment, const Kernels& k)
      : scene(s), kernels(k), lighting(s.lights, environment, k) {}
};

Renderer::Renderer(const Scene& scene, const Environment* environment, const Kernels& kernels) {
  const Clock::time_point start = Clock::now();
  state_ = std::make_unique<State>(scene, environment, kernels);
  state_->materials = compile_materials(scene, state_->textures, kernels);
  for (const MaterialView& material : state_->materials) {
    state_->double_sided.push_back(material.double_sided);
    state_->alpha_modes.push_back(material.alpha_mode);
  }
  state_->prepare_ms = ms_since(start);
}

Renderer::~Renderer() = default;

void Renderer::render(const View& view, const RenderSettings& settings, const FrameRequest& request, Frame& frame) {
  validate(settings);
  State& s = *state_;
  resize_film(frame.rgba, settings.width, settings.height);
  frame.aovs = make_aov_layers(request.aovs, settings.width, settings.height);
  FrameStatistics& statistics = frame.statistics;
  statistics = {};
  statistics.isa = s.kernels.isa;
  statistics.prepare_ms = s.prepare_ms;
  statistics.texture_bytes = s.textures.bytes();
  statistics.table_bytes = s.lighting.table_bytes();
  std::optional<GBufferCapture> capture;
  if (request.gbuffer) capture.emplace(settings.width, settings.height, settings.samples);

  run_with_threads(settings.threads, [&] {
    statistics.threads = thread_count();
    const Clock::time_point start = Clock::now();
    s.geometry.run(s.scene.geometry(), view.transform, settings.samples, s.double_sided, s.alpha_modes, s.kernels);
    statistics.geometry_ms = ms_since(start);
    statistics.geometry = s.geometry.counters();
    statistics.binned = s.geometry.binned();
    statistics.working_bytes = s.geometry.bytes();

    const Clock::time_point tiles_start = Clock::now();
    TileInputs in{};
    in.kernels = &s.kernels;
    in.geometry = s.scene.geometry();
    in.view = view.transform;
    in.pattern = s.kernels.sample_pattern(settings.samples);
    in.materials = s.materials;
    in.setup = s.geometry.setup();
    s.lighting.apply(in);
    in.environment_shading = settings.environment_shading;
    const BackgroundSource background = s.lighting.background(settings);
    for_each_tile(TileGrid(settings.width, settings.height), settings, s.workers, statistics,
                  [&](Worker& worker, const TileRect& rect) {
                    worker.tile.render(in, rect.x, rect.y, rect.width, rect.height,
                                       s.geometry.lists(rect.x / tile_size, rect.y / tile_size));
                    finish_tile(worker, rect, settings.samples, background, view, s.kernels, frame.rgba);
                    if (!frame.aovs.empty())
                      capture_aovs(frame.aovs, worker.tile.fragments, rect, settings.width, s.scene, view.transform,
                                   settings.samples);
                    if (capture) capture->add(worker.tile.fragments, rect);
                  });
    statistics.tiles_ms = ms_since(tiles_start);
    statistics.total_ms = ms_since(start);
    statistics.pixel_hash = hash_of(frame.rgba);
  });
  if (capture) capture->finish(frame.gbuffer);
}

void shade_gbuffer(const GBufferImage& gbuffer, const View& view, const std::vector<Light>& lights,
                   const Environment* environment, const RenderSettings& settings, const Kernels& kernels,
                   Frame& frame) {
  const Clock::time_point start = Clock::now();
  const Lighting lighting(lights, environment, kernels);
  resize_film(frame.rgba, gbuffer.width, gbuffer.height);
  FrameStatistics& statistics = frame.statistics;
  statistics = {};
  statistics.isa = kernels.isa;
  statistics.prepare_ms = ms_since(start);
  statistics.table_bytes = lighting.table_bytes();
  std::vector<std::size_t> first(gbuffer.counts.size() + 1, 0);
  for (std::size_t i = 0; i < gbuffer.counts.size(); ++i) first[i + 1] = first[i] + gbuffer.counts[i];

  run_with_threads(settings.threads, [&] {
    statistics.threads = thread_count();
    const Clock::time_point tiles_start = Clock::now();
    TileInputs in{};
    in.kernels = &kernels;
    in.view = view.transform;
    in.pattern = kernels.sample_pattern(gbuffer.samples);
    lighting.apply(in);
    in.environment_shading = settings.environment_shading;
    const BackgroundSource background = lighting.background(settings);
    std::vector<std::unique_ptr<Worker>> workers;
    for_each_tile(TileGrid(gbuffer.width, gbuffer.height), settings, workers, statistics,
                  [&](Worker& worker, const TileRect& rect) {
                    TileFragments& tile = worker.tile.fragments;
                    worker.tile.clock.start();
                    load_tile(gbuffer, first, rect, tile);
                    worker.tile.clock.lap(TileStage::collect);
                    const auto count = static_cast<std::uint32_t>(tile.fragments.size());
                    if (count != 0) shade_run(in, tile, 0, count, classify(tile.gbuffer(), count, in.frame_features));
                    worker.tile.clock.lap(TileStage::shade);
                    finish_tile(worker, rect, gbuffer.samples, background, view, kernels, frame.rgba);
                  });
    statistics.tiles_ms = ms_since(tiles_start);
    statistics.total_ms = statistics.tiles_ms;
    statistics.pixel_hash = hash_of(frame.rgba);
  });
}

}  // namespace tessera

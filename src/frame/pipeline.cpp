#include "frame/pipeline.hpp"

#include "base/stopwatch.hpp"

namespace tessera {

void FramePipeline::render(const PreparedScene& scene, const View& view, const RenderSettings& settings,
                           const BackgroundSource& background, const Kernels& kernels, const FilmView& film,
                           FrameStatistics& statistics, const TileVisitor& visit) {
  statistics.isa = kernels.isa;
  statistics.threads = thread_count();
  const ProfileScope profile(statistics);
  const Stopwatch total;
  geometry_.run(scene.geometry, view.transform, settings.samples, scene.double_sided, scene.alpha_modes, kernels,
                settings.trace);
  add_profile(statistics, geometry_.clocks(), [](const StageClock& clock) -> const StageClock& { return clock; });
  statistics.geometry_ms = total.ms();
  statistics.geometry = geometry_.counters();
  statistics.binned = geometry_.binned();
  statistics.working_bytes = geometry_.bytes();

  const Stopwatch tiles;
  TileInputs in{};
  in.kernels = &kernels;
  in.geometry = scene.geometry;
  in.view = view.transform;
  in.pattern = kernels.sample_pattern(settings.samples);
  in.materials = scene.materials;
  in.setup = geometry_.setup();
  in.lighting = scene.lighting;
  in.environment_shading = settings.environment_shading;
  in.all_planes = static_cast<bool>(visit);
  tiles_.run(TileGrid(settings.width, settings.height), settings, statistics,
             [&](FrameWorker& worker, const TileRect& rect) {
               worker.tile.render(in, rect, geometry_.lists(rect.x / tile_size, rect.y / tile_size), film);
               finish_tile(worker, rect, settings.samples, background, view, kernels, film);
               if (visit) visit(worker.tile.fragments, rect);
             });
  statistics.tiles_ms = tiles.ms();
  statistics.total_ms = total.ms();
  statistics.pixel_hash = settings.hash ? hash_of(film, row_hashes_) : 0;
}

}  // namespace tessera

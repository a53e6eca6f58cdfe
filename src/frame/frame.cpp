#include "frame/frame.hpp"

#include <map>
#include <optional>

#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "frame/capture.hpp"
#include "frame/classify.hpp"
#include "frame/material_sets.hpp"
#include "frame/pipeline.hpp"
#include "frame/tables.hpp"

namespace tessera {
namespace {

FilmView resized(Image& film, int width, int height) {
  if (film.width != width || film.height != height || film.channels != 4) film = Image(width, height, 4);
  return {film.pixels.data(), width, height};
}

}  // namespace

struct Renderer::State {
  const Scene& scene;
  const Kernels& kernels;
  MaterialSets materials;
  std::vector<std::uint8_t> double_sided;
  std::vector<AlphaMode> alpha_modes;
  std::map<const Environment*, Lighting> lightings;  // of every environment so far
  Lighting* lighting = nullptr;                      // the current one
  double prepare_ms = 0;

  FramePipeline pipeline;

  State(const Scene& s, const Kernels& k) : scene(s), kernels(k), materials(s, k) {}

  void light_with(const Environment* environment) {
    lighting = &lightings.try_emplace(environment, scene.lights, environment, kernels).first->second;
  }
};

Renderer::Renderer(const Scene& scene, const Environment* environment, const Kernels& kernels,
                   const RenderSettings& first) {
  const Stopwatch watch;
  state_ = std::make_unique<State>(scene, kernels);
  state_->light_with(environment);
  static_cast<void>(state_->lighting->view(first));
  for (const MaterialView& material : state_->materials.get(first.color_texels, first.texture_filter)) {
    state_->double_sided.push_back(material.double_sided);
    state_->alpha_modes.push_back(material.alpha_mode);
  }
  state_->prepare_ms = watch.ms();
}

void Renderer::set_environment(const Environment* environment) { state_->light_with(environment); }

Renderer::~Renderer() = default;

void Renderer::render(const View& view, const RenderSettings& settings, const FrameRequest& request, Frame& frame) {
  validate(settings);
  State& s = *state_;
  const FilmView film = resized(frame.rgba, settings.width, settings.height);
  frame.aovs = make_aov_layers(request.aovs, settings.width, settings.height);
  FrameStatistics& statistics = frame.statistics;
  statistics.clear();
  statistics.prepare_ms = s.prepare_ms;
  std::optional<GBufferCapture> capture;
  if (request.gbuffer) capture.emplace(settings.width, settings.height, settings.samples);

  const auto visit = [&](const TileFragments& tile, const TileRect& rect) {
    if (!frame.aovs.empty())
      capture_aovs(frame.aovs, tile, rect, settings.width, s.scene, view.transform, settings.samples);
    if (capture) capture->add(tile, rect);
  };
  const bool visited = capture || !frame.aovs.empty();
  run_with_threads(settings.threads, [&] {
    const std::vector<MaterialView>& materials = s.materials.get(settings.color_texels, settings.texture_filter);
    const LightingView lighting = s.lighting->view(settings);
    statistics.texture_bytes = s.materials.texture_bytes(settings.color_texels);
    statistics.table_bytes = s.lighting->table_bytes(settings);
    s.pipeline.render({s.scene.geometry(), materials, s.double_sided, s.alpha_modes, lighting}, view, settings,
                      s.lighting->background(settings), s.kernels, film, statistics,
                      visited ? FramePipeline::TileVisitor(visit) : nullptr);
  });
  if (capture) capture->finish(frame.gbuffer);
}

void shade_gbuffer(const GBufferImage& gbuffer, const View& view, const std::vector<Light>& lights,
                   const Environment* environment, const RenderSettings& settings, const Kernels& kernels,
                   Frame& frame) {
  const Stopwatch watch;
  Lighting lighting(lights, environment, kernels);
  LightingView light;
  run_with_threads(settings.threads, [&] { light = lighting.view(settings); });
  const FilmView film = resized(frame.rgba, gbuffer.width, gbuffer.height);
  FrameStatistics& statistics = frame.statistics;
  statistics.clear();
  statistics.isa = kernels.isa;
  statistics.prepare_ms = watch.ms();
  statistics.table_bytes = lighting.table_bytes(settings);
  std::vector<std::size_t> first(gbuffer.counts.size() + 1, 0);
  for (std::size_t i = 0; i < gbuffer.counts.size(); ++i) first[i + 1] = first[i] + gbuffer.counts[i];

  run_with_threads(settings.threads, [&] {
    statistics.threads = thread_count();
    const ProfileScope profile(statistics);
    const Stopwatch tiles;
    std::vector<std::uint64_t> row_hashes;
    TileInputs in{};
    in.kernels = &kernels;
    in.view = view.transform;
    in.pattern = kernels.sample_pattern(gbuffer.samples);
    in.lighting = light;
    in.environment_shading = settings.environment_shading;
    const BackgroundSource background = lighting.background(settings);
    TileLoop loop;
    loop.run(TileGrid(gbuffer.width, gbuffer.height), settings, statistics,
             [&](FrameWorker& worker, const TileRect& rect) {
               TileFragments& tile = worker.tile.fragments;
               load_tile(gbuffer, first, rect, tile);
               worker.tile.clock.lap(Stage::collect);
               const auto count = static_cast<std::uint32_t>(tile.fragments.size());
               kernels.clamp_surfaces(tile.gbuffer(), count);  // a file may hold anything
               if (count != 0) shade_run(in, tile, 0, count, classify(tile.gbuffer(), count, in.lighting.features));
               worker.tile.clock.lap(Stage::shade);
               finish_tile(worker, rect, gbuffer.samples, background, view, kernels, film);
             });
    statistics.tiles_ms = tiles.ms();
    statistics.total_ms = statistics.tiles_ms;
    statistics.pixel_hash = settings.hash ? hash_of(film, row_hashes) : 0;
  });
}

}  // namespace tessera

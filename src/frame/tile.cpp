#include "frame/tile.hpp"

#include <algorithm>
#include <bit>

#include "frame/classify.hpp"

namespace tessera {

namespace {

// One opaque fragment for each pixel, in order, and whole blocks of 4 x 4: what FilmBlocks take.
bool is_whole(const TileFragments& tile, std::size_t opaque, int width, int height, int samples) {
  if (!tile.in_order || width % 4 != 0 || height % 4 != 0) return false;
  if (opaque != tile.fragments.size() || opaque != static_cast<std::size_t>(width * height)) return false;
  if (samples == 1) return true;
  std::uint32_t covered = (1u << samples) - 1;  // as many fragments as pixels: one each, if each covers its pixel
  for (const Fragment& f : tile.fragments) covered &= f.samples;
  return covered == (1u << samples) - 1;
}

}  // namespace

std::size_t TileWorker::bytes() const {
  return fragments.bytes() + depth_.capacity() * 4 + ids_.capacity() * 4 +
         (candidates_.capacity() + grouped_.capacity()) * sizeof(Fragment) + sorter_.bytes();
}

void TileWorker::render(const TileInputs& in, const TileRect& rect, const TileLists& lists, const FilmView& film) {
  fragments.clear();
  opaque_count_ = 0;
  if (lists.opaque.empty() && lists.mask.empty() && lists.blend.empty()) return;
  const std::size_t samples = in.pattern.count;
  depth_.resize(samples * tile_pixels);
  ids_.resize(samples * tile_pixels);
  const VisibilityTile tile{rect.x, rect.y, rect.width, rect.height, in.pattern.count, depth_.data(), ids_.data()};
  in.kernels->clear_visibility(tile);
  if (!lists.opaque.empty()) {
    in.kernels->rasterize_opaque(
        {tile, in.setup.data(), lists.opaque.data(), static_cast<std::uint32_t>(lists.opaque.size()), &in.geometry},
        nullptr);
  }
  clock.lap(Stage::coverage);
  if (!lists.mask.empty()) {
    draw_masked(in, tile, lists.mask);
    clock.lap(Stage::alpha_mask);
  }
  collect(in, tile, lists.blend);
  if (fragments.fragments.empty()) {
    clock.lap(Stage::collect);
    return;
  }
  group_by_binding(in);
  fragments.whole = is_whole(fragments, opaque_count_, rect.width, rect.height, in.pattern.count);
  clock.lap(Stage::collect);
  shade_runs(in, rect, film);
  if (fragments.fragments.size() > opaque_count_) sorter_.sort(fragments, opaque_count_);
  clock.lap(Stage::collect);
}

// Candidates are tested against what is drawn so far, their alpha is fetched a binding at a time, and the survivors are
// written, with the depth test done again: nearest wins whatever the order.
void TileWorker::draw_masked(const TileInputs& in, const VisibilityTile& tile, std::span<const std::uint32_t> list) {
  const bool split = tile.samples > 1;
  const std::size_t most = std::size_t{tile_pixels} * (split ? tile.samples : 1);
  std::size_t next = 0;
  while (next < list.size()) {
    const auto binding_of = [&](std::size_t i) { return in.geometry.triangles[in.setup[list[i]].triangle].binding; };
    const std::uint32_t binding = binding_of(next);
    pieces_.clear();
    std::uint32_t count = 0;
    while (next < list.size() && binding_of(next) == binding && count < tile_pixels) {
      if (candidates_.size() < count + most) candidates_.resize(count + most);
      const std::uint32_t added =
          in.kernels->collect_triangle(tile, in.setup[list[next]], split, candidates_.data() + count);
      if (added != 0) pieces_.push_back({list[next], count, added});
      count += added;
      ++next;
    }
    if (count == 0) continue;
    const MaterialView& material = in.materials[binding];
    alpha_.resize(round_up_to_lanes(count));
    keep_.resize(count);
    in.kernels->resolve_alpha(
        {in.geometry, in.view, &material, in.pattern, tile.x, tile.y, candidates_.data(), count, alpha_.data()});
    for (std::uint32_t i = 0; i < count; ++i) keep_[i] = alpha_[i] >= material.alpha_cutoff;
    for (const Piece& p : pieces_)
      in.kernels->commit_fragments(tile, in.setup[p.setup], candidates_.data() + p.first, keep_.data() + p.first,
                                   p.count);
  }
}

void TileWorker::collect(const TileInputs& in, const VisibilityTile& tile, std::span<const std::uint32_t> blend) {
  ScratchVector<Fragment>& all = fragments.fragments;
  all.resize(std::size_t{tile_pixels} * tile.samples);
  opaque_count_ = in.kernels->collect_visible(tile, all.data());
  std::size_t count = opaque_count_;
  for (const std::uint32_t index : blend) {
    if (all.size() < count + tile_pixels) all.resize(count + count / 2 + tile_pixels);
    count += in.kernels->collect_triangle(tile, in.setup[index], false, all.data() + count);
  }
  all.resize(count);
}

// Whether all fragments have one binding, and which.
bool TileWorker::one_binding(const TileInputs& in, std::uint32_t& binding) const {
  const auto& all = fragments.fragments;
  if (all.empty()) return false;
  binding = in.geometry.triangles[all[0].triangle].binding;
  if (in.materials.size() == 1) return true;
  std::uint32_t last = all[0].triangle;
  for (const Fragment& f : all) {
    if (f.triangle == last) continue;
    last = f.triangle;
    if (in.geometry.triangles[last].binding != binding) return false;
  }
  return true;
}

// A stable counting sort. Each binding's run starts on a vector boundary.
void TileWorker::group_by_binding(const TileInputs& in) {
  constexpr std::uint32_t none = 0xffffffffu;
  const auto& all = fragments.fragments;
  const auto count = static_cast<std::uint32_t>(all.size());
  runs_.clear();
  if (std::uint32_t binding = 0; one_binding(in, binding)) {
    runs_.push_back({binding, 0, count});
    fragments.in_order = true;
    fragments.reserve_planes(count);
    return;
  }
  run_of_binding_.resize(in.materials.size(), none);
  fragment_run_.resize(count);
  fragments.slots.resize(count);
  std::uint32_t last_triangle = no_triangle, last_run = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (all[i].triangle != last_triangle) {
      last_triangle = all[i].triangle;
      const std::uint32_t binding = in.geometry.triangles[last_triangle].binding;
      if (run_of_binding_[binding] == none) {
        run_of_binding_[binding] = static_cast<std::uint32_t>(runs_.size());
        runs_.push_back({binding, 0, 0});
      }
      last_run = run_of_binding_[binding];
    }
    fragment_run_[i] = last_run;
    ++runs_[last_run].count;
  }
  std::uint32_t slots = 0;
  for (Run& run : runs_) {
    run_of_binding_[run.binding] = none;
    run.first = slots;
    slots += round_up_to_lanes(run.count);
    run.count = 0;
  }
  grouped_.resize(slots);
  fragments.reserve_planes(slots);
  for (std::size_t i = 0; i < count; ++i) {
    Run& run = runs_[fragment_run_[i]];
    const std::uint32_t slot = run.first + run.count++;
    fragments.slots[i] = slot;
    grouped_[slot] = all[i];
  }
}

void shade_run(const TileInputs& in, TileFragments& fragments, std::uint32_t first, std::uint32_t count,
               std::uint32_t features, const FilmBlocks& film) {
  ShadeArgs args{};
  args.gbuffer = fragments.gbuffer(first);
  args.count = count;
  args.features = features;
  std::copy(std::begin(in.view.eye), std::end(in.view.eye), args.eye);
  args.lights = in.lighting.lights.data();
  args.light_count = static_cast<std::uint32_t>(in.lighting.lights.size());
  if (const LightBoundsView& bounds = in.lighting.bounds; bounds.count != 0 && (features & feature_lights) != 0) {
    fragments.reached.resize(round_up_to_lanes(bounds.count));
    args.light_count =
        in.kernels->cull_lights({{args.gbuffer.position[0], args.gbuffer.position[1], args.gbuffer.position[2]},
                                 count,
                                 bounds,
                                 fragments.reached.data()});
    args.light_list = fragments.reached.data();
  }
  args.environment = in.lighting.environment;
  args.dfg = in.lighting.dfg;
  args.environment_shading = in.environment_shading;
  const std::array<float*, 3> radiance = fragments.radiance(first);
  std::copy(radiance.begin(), radiance.end(), args.radiance);
  args.film = film;
  in.kernels->shade(args);
}

void TileWorker::shade_runs(const TileInputs& in, const TileRect& rect, const FilmView& film) {
  const Fragment* grouped = fragments.in_order ? fragments.fragments.data() : grouped_.data();
  const bool sorted = fragments.fragments.size() > opaque_count_;
  for (const Run& run : runs_) {
    GBufferView out = fragments.gbuffer(run.first);
    if (!in.all_planes) {
      constexpr std::uint32_t own_light = feature_emissive | feature_unlit;
      if ((classify(in.materials[run.binding], in.lighting.features) & own_light) == 0)
        out.emissive[0] = out.emissive[1] = out.emissive[2] = out.unlit = nullptr;
      if (fragments.whole) out.alpha = nullptr;
      if (!sorted) out.depth = nullptr;
    }
    in.kernels->resolve({in.geometry, in.view, &in.materials[run.binding], in.pattern, rect.x, rect.y,
                         grouped + run.first, run.count, out});
  }
  clock.lap(Stage::resolve);
  FilmBlocks pixels{};
  if (fragments.whole)
    pixels = {film.at(rect.x, rect.y), std::size_t(film.width) * 4, static_cast<std::uint32_t>(rect.width / 4)};
  for (const Run& run : runs_)
    shade_run(in, fragments, run.first, run.count, classify(in.materials[run.binding], in.lighting.features), pixels);
  clock.lap(Stage::shade);
}

}  // namespace tessera

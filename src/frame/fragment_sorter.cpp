#include "frame/fragment_sorter.hpp"

#include <algorithm>

namespace tessera {

// Front to back; at equal depths by triangle, pieces of one clipped triangle by their samples. Few layers lie over most
// pixels, and those nearly in order: inserting is the fastest there is, until there are many.
void FragmentSorter::sort_pixel(const TileFragments& tile, std::uint32_t begin, std::uint32_t end) {
  const auto before = [&](const Key& a, const Key& b) {
    if (a.depth != b.depth) return a.depth > b.depth;
    if (a.triangle != b.triangle) return a.triangle < b.triangle;
    return tile.fragments[a.index].samples < tile.fragments[b.index].samples;
  };
  constexpr std::uint32_t most_inserted = 32;
  if (end - begin > most_inserted) {
    std::sort(keys_.begin() + begin, keys_.begin() + end, before);
    return;
  }
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    const Key key = keys_[i];
    std::uint32_t at = i;
    for (; at > begin && before(key, keys_[at - 1]); --at) keys_[at] = keys_[at - 1];
    keys_[at] = key;
  }
}

void FragmentSorter::sort(TileFragments& tile, std::size_t opaque_count) {
  const ScratchVector<Fragment>& all = tile.fragments;
  const auto count = static_cast<std::uint32_t>(all.size());
  const float* const depth = tile.gbuffer().depth;
  // A stable counting sort by pixel: opaque fragments stay in order.
  next_.fill(0);
  transparent_.fill(false);
  for (const Fragment& f : all) ++next_[f.pixel + 1u];
  for (std::uint32_t i = static_cast<std::uint32_t>(opaque_count); i < count; ++i) transparent_[all[i].pixel] = true;
  for (std::size_t pixel = 0; pixel < tile_pixels; ++pixel) next_[pixel + 1] += next_[pixel];
  keys_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Fragment& f = all[i];
    const float d = transparent_[f.pixel] ? depth[tile.slot(i)] : 0;
    keys_[next_[f.pixel]++] = {d, f.triangle, i};
  }
  // Each pixel's now end where the next one's began.
  for (std::size_t pixel = 0; pixel < tile_pixels; ++pixel)
    if (transparent_[pixel]) sort_pixel(tile, pixel == 0 ? 0 : next_[pixel - 1], next_[pixel]);

  sorted_.resize(count);
  sorted_slots_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    sorted_[i] = all[keys_[i].index];
    sorted_slots_[i] = tile.slot(keys_[i].index);
  }
  tile.fragments.swap(sorted_);
  tile.slots.swap(sorted_slots_);
  tile.in_order = false;
}

}  // namespace tessera

#include "frame/material_sets.hpp"

#include "frame/material.hpp"

namespace tessera {
namespace {

TextureView filtered_by(TextureView view, TextureFilter filter) {
  if (filter == TextureFilter::no_mips) view.mipmapped = false;
  if (filter == TextureFilter::nearest_mip || filter == TextureFilter::nearest) view.mip = FilterMode::nearest;
  if (filter == TextureFilter::nearest) view.magnify = view.minify = FilterMode::nearest;
  return view;
}

}  // namespace

MaterialSets::Stored& MaterialSets::stored(ColorTexels colors) {
  std::unique_ptr<Stored>& stored = stored_[colors];
  if (stored == nullptr) {
    auto made = std::make_unique<Stored>(colors);
    made->filtered[TextureFilter::file].materials = compile_materials(scene_, made->textures, kernels_);
    stored = std::move(made);
  }
  return *stored;
}

const std::vector<MaterialView>& MaterialSets::get(ColorTexels colors, TextureFilter filter) {
  Stored& set = stored(colors);
  if (const auto found = set.filtered.find(filter); found != set.filtered.end()) return found->second.materials;
  Filtered made;
  made.materials = set.filtered.at(TextureFilter::file).materials;
  for (MaterialView& material : made.materials)
    for (TextureSlotView* slot : {&material.base_color_texture, &material.metallic_roughness_texture,
                                  &material.normal_texture, &material.occlusion_texture, &material.emissive_texture}) {
      if (slot->texture == nullptr) continue;
      // Slots that share a texture go on sharing it: kernels look at it once.
      slot->texture = &made.textures.try_emplace(slot->texture, filtered_by(*slot->texture, filter)).first->second;
    }
  // Moving a map keeps its elements where they are.
  return (set.filtered[filter] = std::move(made)).materials;
}

}  // namespace tessera

#include "frame/material.hpp"

#include <algorithm>

namespace tessera {
namespace {

struct SlotUse {
  const TextureSlot* slot;
  Encoding encoding;
  bool shows;
  TextureSlotView MaterialView::*view;
};

std::vector<SlotUse> slots_of(const Material& m) {
  const bool colored = m.base_color[0] != 0 || m.base_color[1] != 0 || m.base_color[2] != 0;
  const bool translucent = m.alpha_mode != AlphaMode::opaque && m.base_color[3] != 0;
  const bool glows = m.emissive_strength != 0 && (m.emissive[0] != 0 || m.emissive[1] != 0 || m.emissive[2] != 0);
  const bool lit = !m.unlit;
  return {
      {&m.base_color_texture, Encoding::srgb, colored || translucent, &MaterialView::base_color_texture},
      {&m.metallic_roughness_texture, Encoding::linear, lit && (m.metallic != 0 || m.roughness != 0),
       &MaterialView::metallic_roughness_texture},
      {&m.normal_texture, Encoding::linear, lit && m.normal_scale != 0, &MaterialView::normal_texture},
      {&m.occlusion_texture, Encoding::linear, lit && m.occlusion_strength != 0, &MaterialView::occlusion_texture},
      {&m.emissive_texture, Encoding::srgb, lit && glows, &MaterialView::emissive_texture},
  };
}

MaterialView view_of(const Material& m, const MaterialBinding& binding) {
  MaterialView v{};
  std::copy_n(m.base_color, 4, v.base_color);
  v.metallic = m.metallic;
  v.roughness = m.roughness;
  v.normal_scale = m.normal_scale;
  v.occlusion_strength = m.occlusion_strength;
  for (int c = 0; c < 3; ++c) v.emissive[c] = m.unlit ? 0.0f : m.emissive[c] * m.emissive_strength;
  v.alpha_cutoff = m.alpha_cutoff;
  v.alpha_mode = m.alpha_mode;
  v.double_sided = m.double_sided;
  v.unlit = m.unlit;
  v.has_tangents = binding.has_tangents;
  v.has_colors = binding.has_colors;
  return v;
}

}  // namespace

void texture_transform(const TextureSlot& slot, const Kernels& kernels, float (&rows)[6]) {
  float cosine = 1, sine = 0;
  if (slot.rotation != 0) {
    kernels.evaluate(MathFunction::cos, &slot.rotation, nullptr, &cosine, 1);
    kernels.evaluate(MathFunction::sin, &slot.rotation, nullptr, &sine, 1);
  }
  rows[0] = cosine * slot.scale[0];
  rows[1] = sine * slot.scale[1];
  rows[2] = slot.offset[0];
  rows[3] = -sine * slot.scale[0];
  rows[4] = cosine * slot.scale[1];
  rows[5] = slot.offset[1];
}

std::vector<MaterialView> compile_materials(const Scene& scene, TextureSet& textures, const Kernels& kernels) {
  std::vector<TextureSet::Use> uses;
  for (const MaterialBinding& binding : scene.bindings)
    for (const SlotUse& use : slots_of(scene.materials[binding.material]))
      if (use.shows && use.slot->texture >= 0) uses.push_back({use.slot->texture, use.encoding});
  textures.build(scene, uses, kernels);

  std::vector<MaterialView> views;
  views.reserve(scene.bindings.size());
  for (const MaterialBinding& binding : scene.bindings) {
    const Material& material = scene.materials[binding.material];
    MaterialView view = view_of(material, binding);
    for (const SlotUse& use : slots_of(material)) {
      if (!use.shows || use.slot->texture < 0) continue;
      TextureSlotView& slot = view.*use.view;
      slot.texture = textures.find({use.slot->texture, use.encoding});
      slot.uv_set = use.slot->uv_set;
      texture_transform(*use.slot, kernels, slot.transform);
    }
    views.push_back(view);
  }
  return views;
}

}  // namespace tessera

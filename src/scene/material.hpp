// glTF 2.0's metallic-roughness material.
#pragma once
#include <string>

#include "scene/texture.hpp"

namespace tessera {

struct Material {
  std::string name;
  float base_color[4] = {1, 1, 1, 1};
  float metallic = 1, roughness = 1;
  float normal_scale = 1, occlusion_strength = 1;
  float emissive[3] = {0, 0, 0};
  float emissive_strength = 1;  // KHR_materials_emissive_strength
  float alpha_cutoff = 0.5f;
  AlphaMode alpha_mode = AlphaMode::opaque;
  bool double_sided = false;
  bool unlit = false;  // KHR_materials_unlit
  TextureSlot base_color_texture, metallic_roughness_texture, normal_texture, occlusion_texture, emissive_texture;
};

/// A material together with what its vertices carry: all that is the same for a run of fragments.
struct MaterialBinding {
  int material = 0;
  bool has_tangents = false, has_colors = false;
  bool operator==(const MaterialBinding&) const = default;
};

}  // namespace tessera

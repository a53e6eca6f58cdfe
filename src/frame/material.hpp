// Materials as a scene describes them -> parameters and textures as kernels read them.
#pragma once
#include <vector>

#include "kernels/interface.hpp"
#include "precompute/texture.hpp"
#include "scene/scene.hpp"

namespace tessera {

/// One view per MaterialBinding, in order. Builds into `textures` those that can show: of bound materials, and not
/// behind a factor of zero. The views point into `textures`. Throws Error(input) for an image that cannot be used.
std::vector<MaterialView> compile_materials(const Scene& scene, TextureSet& textures, const Kernels& kernels);

/// The rows of KHR_texture_transform's matrix, translation * rotation * scale. A positive rotation turns UVs
/// counter-clockwise as seen with v pointing down, so u' = x + cos sx u + sin sy v, v' = y - sin sx u + cos sy v.
void texture_transform(const TextureSlot& slot, const Kernels& kernels, float (&rows)[6]);

}  // namespace tessera

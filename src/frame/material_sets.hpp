// A scene's materials in the forms that frames ask for: how colours are stored, how textures are filtered.
#pragma once
#include <map>
#include <memory>
#include <vector>

#include "frame/settings.hpp"
#include "kernels/interface.hpp"
#include "precompute/texture.hpp"
#include "scene/scene.hpp"

namespace tessera {

class MaterialSets {
 public:
  MaterialSets(const Scene& scene, const Kernels& kernels) : scene_(scene), kernels_(kernels) {}

  /// One per MaterialBinding. Built when first asked for, and kept. Throws Error(input) for an image that cannot be
  /// used.
  const std::vector<MaterialView>& get(ColorTexels colors, TextureFilter filter);
  /// Memory of the textures of a form that was asked for.
  [[nodiscard]] std::size_t texture_bytes(ColorTexels colors) const { return stored_.at(colors)->textures.bytes(); }

 private:
  struct Filtered {
    std::map<const TextureView*, TextureView> textures;  // what stands for what
    std::vector<MaterialView> materials;
  };
  struct Stored {
    explicit Stored(ColorTexels colors) : textures(colors) {}
    TextureSet textures;
    std::map<TextureFilter, Filtered> filtered;
  };
  Stored& stored(ColorTexels colors);

  const Scene& scene_;
  const Kernels& kernels_;
  std::map<ColorTexels, std::unique_ptr<Stored>> stored_;
};

}  // namespace tessera

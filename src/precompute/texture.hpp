// Images as files hold them -> mip-mapped textures as kernels sample them.
#pragma once
#include <cstddef>
#include <map>
#include <span>
#include <utility>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"
#include "scene/scene.hpp"

namespace tessera {

/// What the numbers of an image mean. Images of half and float pixels are linear in either case.
enum class Encoding { linear, srgb };

/// What sRGB images of 8 and 16 bits become: half floats; or the square root of linear light in 8 bits: half the
/// memory, and within 0.75 of a display step (1/255 of an sRGB channel).
enum class ColorTexels { halves, bytes };

/// A mip chain in linear light. sRGB images become what ColorTexels says (8 bits of linear light would band in the
/// dark), everything else that is deeper than 8 bits becomes half floats; 8-bit data (normals, roughness ...) stay
/// 8-bit. Values outside [0, 65504] are clamped, NaN is 0.
struct TextureData {
  TexelFormat format = TexelFormat::rgba8_unorm;
  int width = 0, height = 0, levels = 0;
  ScratchVector<std::byte> texels;  // level 0 first
};

/// Grey becomes (g, g, g), a missing alpha 1. Throws Error(input), naming the image, for one that is empty, too large,
/// or whose pixels do not match its size.
TextureData build_texture(const SourceImage& image, Encoding encoding, bool mipmapped, const Kernels& kernels,
                          ColorTexels colors = ColorTexels::halves);

/// The textures of one scene, and their memory. Addresses of views stay valid as long as the set.
class TextureSet {
 public:
  explicit TextureSet(ColorTexels colors = ColorTexels::halves) : colors_(colors) {}

  struct Use {
    int texture;  // index into Scene::textures
    Encoding encoding;
  };

  /// Builds what is used and not built yet, several images at a time. An image used in both encodings is built twice;
  /// textures that differ by their sampler alone share texels.
  void build(const Scene& scene, std::span<const Use> uses, const Kernels& kernels);

  /// Null if that was not built.
  [[nodiscard]] const TextureView* find(Use use) const;

  [[nodiscard]] std::size_t bytes() const;

 private:
  ColorTexels colors_;
  std::map<std::pair<int, Encoding>, TextureData> images_;    // by image
  std::map<std::pair<int, Encoding>, TextureView> textures_;  // by texture
};

}  // namespace tessera

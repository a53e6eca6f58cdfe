#include <algorithm>
#include <cmath>

#include "io/gltf_build.hpp"

namespace tessera {
namespace {

float clamped(GltfDocument& document, const std::string& part, double value, double low, double high) {
  if (value >= low && value <= high) return float(value);
  document.warn(fmt::format("{}: {} clamped to [{}, {}]", part, value, low, high));
  return float(std::clamp(value, low, high));
}

constexpr double most = 1e15;  // emissive factor times strength must stay a float

bool finite_float(double value) { return std::isfinite(float(value)); }

WrapMode wrap_mode(int value, GltfDocument& document, const std::string& part) {
  switch (value) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return WrapMode::repeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return WrapMode::mirrored_repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return WrapMode::clamp_to_edge;
    default:
      throw document.wrong(part, "is {}, expected 10497, 33071 or 33648", value);
  }
}

Sampler read_sampler(GltfDocument& document, int index) {
  Sampler sampler;
  if (index < 0) return sampler;
  const tinygltf::Sampler& in = document.model.samplers[std::size_t(index)];
  const std::string part = fmt::format("samplers[{}]", index);
  sampler.wrap_u = wrap_mode(in.wrapS, document, part + ".wrapS");
  sampler.wrap_v = wrap_mode(in.wrapT, document, part + ".wrapT");
  if (in.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) sampler.magnify = FilterMode::nearest;
  switch (in.minFilter) {
    case -1:
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      sampler.minify = FilterMode::nearest;
      sampler.mipmapped = false;
      break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
      sampler.mipmapped = false;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
      sampler.minify = sampler.mip = FilterMode::nearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
      sampler.mip = FilterMode::nearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
      sampler.minify = FilterMode::nearest;
      break;
    default:
      throw document.wrong(part + ".minFilter", "is {}, expected 9728, 9729 or 9984 to 9987", in.minFilter);
  }
  return sampler;
}

}  // namespace

int MaterialBuilder::binding(int index, bool has_tangents, bool has_colors) {
  const MaterialBinding wanted{material(index), has_tangents, has_colors};
  const auto [place, fresh] =
      bindings_.try_emplace({wanted.material, has_tangents, has_colors}, int(scene_.bindings.size()));
  if (fresh) scene_.bindings.push_back(wanted);
  return place->second;
}

int MaterialBuilder::material(int index) {
  if (materials_.empty()) materials_.assign(document_.model.materials.size(), -1);
  int& known = index < 0 ? default_material_ : materials_[std::size_t(index)];
  if (known < 0) {
    Material made = index < 0 ? Material{} : read_material(index);
    if (index < 0) made.name = "default";
    known = int(scene_.materials.size());
    scene_.materials.push_back(std::move(made));
  }
  return known;
}

Material MaterialBuilder::read_material(int index) {
  const tinygltf::Material& in = document_.model.materials[std::size_t(index)];
  const std::string part = fmt::format("materials[{}]", index);
  Material out;
  out.name = in.name;
  const auto& pbr = in.pbrMetallicRoughness;
  const std::string pbr_part = part + ".pbrMetallicRoughness";
  for (std::size_t c = 0; c < 4; ++c) {
    out.base_color[c] = clamped(document_, pbr_part + ".baseColorFactor", pbr.baseColorFactor[c], 0, 1);
  }
  out.metallic = clamped(document_, pbr_part + ".metallicFactor", pbr.metallicFactor, 0, 1);
  out.roughness = clamped(document_, pbr_part + ".roughnessFactor", pbr.roughnessFactor, 0, 1);
  out.base_color_texture = read_slot(pbr_part + ".baseColorTexture", pbr.baseColorTexture.index,
                                     pbr.baseColorTexture.texCoord, pbr.baseColorTexture.extensions);
  out.metallic_roughness_texture =
      read_slot(pbr_part + ".metallicRoughnessTexture", pbr.metallicRoughnessTexture.index,
                pbr.metallicRoughnessTexture.texCoord, pbr.metallicRoughnessTexture.extensions);
  out.normal_texture = read_slot(part + ".normalTexture", in.normalTexture.index, in.normalTexture.texCoord,
                                 in.normalTexture.extensions);
  out.normal_scale = clamped(document_, part + ".normalTexture.scale", in.normalTexture.scale, -1e6, 1e6);
  out.occlusion_texture = read_slot(part + ".occlusionTexture", in.occlusionTexture.index, in.occlusionTexture.texCoord,
                                    in.occlusionTexture.extensions);
  out.occlusion_strength = clamped(document_, part + ".occlusionTexture.strength", in.occlusionTexture.strength, 0, 1);
  out.emissive_texture = read_slot(part + ".emissiveTexture", in.emissiveTexture.index, in.emissiveTexture.texCoord,
                                   in.emissiveTexture.extensions);
  for (std::size_t c = 0; c < in.emissiveFactor.size(); ++c) {
    out.emissive[c] = clamped(document_, part + ".emissiveFactor", in.emissiveFactor[c], 0, most);
  }
  if (const auto* strength = extension_of(in.extensions, "KHR_materials_emissive_strength")) {
    out.emissive_strength = clamped(document_, part + ".extensions.KHR_materials_emissive_strength",
                                    number_in(*strength, "emissiveStrength", 1), 0, most);
  }
  out.unlit = extension_of(in.extensions, "KHR_materials_unlit") != nullptr;
  out.double_sided = in.doubleSided;
  out.alpha_cutoff = clamped(document_, part + ".alphaCutoff", in.alphaCutoff, 0, most);
  if (in.alphaMode == "MASK") {
    out.alpha_mode = AlphaMode::mask;
  } else if (in.alphaMode == "BLEND") {
    out.alpha_mode = AlphaMode::blend;
  } else if (in.alphaMode != "OPAQUE") {
    throw document_.wrong(part + ".alphaMode", "is '{}', expected OPAQUE, MASK or BLEND", in.alphaMode);
  }
  return out;
}

TextureSlot MaterialBuilder::read_slot(const std::string& part, int index, int uv_set,
                                       const tinygltf::ExtensionMap& extensions) {
  TextureSlot slot;
  if (index < 0) return slot;
  slot.uv_set = uv_set;
  if (const auto* transform = extension_of(extensions, "KHR_texture_transform")) {
    slot.uv_set = int(number_in(*transform, "texCoord", uv_set));
    slot.rotation = float(number_in(*transform, "rotation", 0));
    for (int i = 0; i < 2; ++i) {
      if (transform->Has("offset")) slot.offset[i] = float(transform->Get("offset").Get(i).GetNumberAsDouble());
      if (transform->Has("scale")) slot.scale[i] = float(transform->Get("scale").Get(i).GetNumberAsDouble());
    }
    const float values[] = {slot.rotation, slot.offset[0], slot.offset[1], slot.scale[0], slot.scale[1]};
    for (const float value : values) {
      if (!finite_float(value)) throw document_.wrong(part + ".extensions.KHR_texture_transform", "overflows a float");
    }
  }
  if (slot.uv_set > 1) {
    document_.warn(
        fmt::format("{}: UV set {} is not supported, only 0 and 1: the texture is left out", part, slot.uv_set));
    return TextureSlot{};
  }
  slot.texture = texture(index);
  return slot;
}

int MaterialBuilder::texture(int index) {
  if (textures_.empty()) textures_.assign(document_.model.textures.size(), -1);
  int& known = textures_[std::size_t(index)];
  if (known >= 0) return known;
  const tinygltf::Texture& in = document_.model.textures[std::size_t(index)];
  Texture out;
  out.image = in.source;
  if (const auto* webp = extension_of(in.extensions, "EXT_texture_webp")) {
    out.image = int(number_in(*webp, "source", in.source));
  }
  if (out.image < 0) {
    throw document_.wrong(fmt::format("textures[{}]", index), "has no image of a kind that can be read{}",
                          document_.report.extensions_unsupported.empty()
                              ? ""
                              : " (unsupported: " + document_.report.extensions_unsupported.front() + ")");
  }
  out.sampler = read_sampler(document_, in.sampler);
  known = int(scene_.textures.size());
  scene_.textures.push_back(out);
  return known;
}

}  // namespace tessera

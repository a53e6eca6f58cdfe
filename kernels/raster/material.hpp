// A material's parameters at a point: factors, vertex colours and textures put together.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/raster/attributes.hpp"
#include "kernels/simd.hpp"
#include "kernels/texture/sample.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// A difference of UVs, from vertex 0 to another one.
struct UvStep {
  Float du, dv;
};

struct UvSet {
  TextureCoordinates at;
  UvStep step1, step2;
};

struct UvSets {
  UvSet set[2];
};

/// What a run's material reads from, prepared once. Samplers of empty slots are not initialised.
struct MaterialSamplers {
  TextureSampler base_color, metallic_roughness, normal, occlusion, emissive;
  bool uses_set[2];
  bool packed_occlusion;  // occlusion lies in the red channel of the metallic-roughness texture, sampled alike
};

inline bool has_texture(const MaterialView& m) {
  return m.base_color_texture.texture != nullptr || m.metallic_roughness_texture.texture != nullptr ||
         m.normal_texture.texture != nullptr || m.occlusion_texture.texture != nullptr ||
         m.emissive_texture.texture != nullptr;
}

inline bool same_slot(const TextureSlotView& a, const TextureSlotView& b) {
  bool same = a.texture == b.texture && a.uv_set == b.uv_set;
  for (int i = 0; i < 6; ++i) same = same && a.transform[i] == b.transform[i];
  return same;
}

inline void prepare_slot(const TextureSlotView& slot, TextureSampler& sampler, MaterialSamplers& samplers) {
  if (slot.texture == nullptr) return;
  prepare_sampler(*slot.texture, sampler);
  samplers.uses_set[slot.uv_set & 1] = true;
}

/// For base_color alone.
inline void prepare_base_color(const MaterialView& m, MaterialSamplers& samplers) {
  samplers.uses_set[0] = samplers.uses_set[1] = false;
  prepare_slot(m.base_color_texture, samplers.base_color, samplers);
}

inline void prepare_samplers(const MaterialView& m, MaterialSamplers& samplers) {
  prepare_base_color(m, samplers);
  prepare_slot(m.metallic_roughness_texture, samplers.metallic_roughness, samplers);
  prepare_slot(m.normal_texture, samplers.normal, samplers);
  prepare_slot(m.emissive_texture, samplers.emissive, samplers);
  samplers.packed_occlusion = same_slot(m.occlusion_texture, m.metallic_roughness_texture);
  if (!samplers.packed_occlusion) prepare_slot(m.occlusion_texture, samplers.occlusion, samplers);
}

/// The UV sets that the material's textures use.
inline void fetch_uv_sets(const GeometryView& geometry, const FragmentLanes& f, const Barycentrics<Float>& b,
                          const MaterialSamplers& samplers, UvSets& uv) {
  for (int s = 0; s < 2; ++s) {
    if (!samplers.uses_set[s]) continue;
    Float corners[2][3];
    fetch_attribute(geometry, f, uv_offset + 2 * s, corners);
    UvSet& set = uv.set[s];
    set.step1 = {corners[0][1] - corners[0][0], corners[1][1] - corners[1][0]};
    set.step2 = {corners[0][2] - corners[0][0], corners[1][2] - corners[1][0]};
    set.at.u = interpolate(b, corners[0][0], corners[0][1], corners[0][2]);
    set.at.v = interpolate(b, corners[1][0], corners[1][1], corners[1][2]);
    set.at.du_dx = mul_add(set.step1.du, b.b1_dx, set.step2.du * b.b2_dx);
    set.at.dv_dx = mul_add(set.step1.dv, b.b1_dx, set.step2.dv * b.b2_dx);
    set.at.du_dy = mul_add(set.step1.du, b.b1_dy, set.step2.du * b.b2_dy);
    set.at.dv_dy = mul_add(set.step1.dv, b.b1_dy, set.step2.dv * b.b2_dy);
  }
}

/// A slot's transform, applied to a difference.
inline UvStep transform_step(const TextureSlotView& slot, const UvStep& step) {
  const float(&t)[6] = slot.transform;
  return {mul_add(Float(t[0]), step.du, Float(t[1]) * step.dv), mul_add(Float(t[3]), step.du, Float(t[4]) * step.dv)};
}

/// A slot's coordinates: those of its UV set, transformed (KHR_texture_transform).
inline TextureCoordinates transform_uv(const TextureSlotView& slot, const UvSets& uv) {
  const TextureCoordinates& c = uv.set[slot.uv_set & 1].at;
  const float(&t)[6] = slot.transform;
  const UvStep dx = transform_step(slot, {c.du_dx, c.dv_dx});
  const UvStep dy = transform_step(slot, {c.du_dy, c.dv_dy});
  return {mul_add(Float(t[0]), c.u, mul_add(Float(t[1]), c.v, Float(t[2]))),
          mul_add(Float(t[3]), c.u, mul_add(Float(t[4]), c.v, Float(t[5]))),
          dx.du,
          dy.du,
          dx.dv,
          dy.dv};
}

/// Base colour and alpha: factor x vertex colour x texture. Only the wanted channels of out are written.
template <bool textured, unsigned channels>
inline void base_color(const MaterialView& m, const MaterialSamplers& samplers, const GeometryView& geometry,
                       const FragmentLanes& f, const Barycentrics<Float>& b, const UvSets& uv, Float (&out)[4]) {
  Float vertex[4] = {Float(1), Float(1), Float(1), Float(1)};
  if (m.has_colors) interpolate_attribute(geometry, f, b, color_offset, vertex);
  for (int c = 0; c < 4; ++c)
    if (channels >> c & 1) out[c] = Float(m.base_color[c]) * vertex[c];
  if constexpr (textured) {
    if (m.base_color_texture.texture != nullptr) {
      Float texel[4];
      sample<channels>(samplers.base_color, transform_uv(m.base_color_texture, uv), texel);
      for (int c = 0; c < 4; ++c)
        if (channels >> c & 1) out[c] = out[c] * texel[c];
    }
  }
}

struct SurfaceScalars {
  Float metallic, roughness, occlusion;
};

/// Metallic (B), roughness (G) and occlusion (R: 1 + strength (texel - 1)).
template <bool textured>
inline SurfaceScalars surface_scalars(const MaterialView& m, const MaterialSamplers& samplers, const UvSets& uv) {
  SurfaceScalars s{Float(m.metallic), Float(m.roughness), Float(1)};
  if constexpr (textured) {
    Float open(1);
    if (m.metallic_roughness_texture.texture != nullptr) {
      Float texel[4];
      const TextureCoordinates at = transform_uv(m.metallic_roughness_texture, uv);
      if (samplers.packed_occlusion) {
        sample<channel_r | channel_g | channel_b>(samplers.metallic_roughness, at, texel);
        open = texel[0];
      } else {
        sample<channel_g | channel_b>(samplers.metallic_roughness, at, texel);
      }
      s.roughness = s.roughness * texel[1];
      s.metallic = s.metallic * texel[2];
    }
    if (m.occlusion_texture.texture != nullptr && !samplers.packed_occlusion) {
      Float texel[4];
      sample<channel_r>(samplers.occlusion, transform_uv(m.occlusion_texture, uv), texel);
      open = texel[0];
    }
    s.occlusion = mul_add(Float(m.occlusion_strength), open - Float(1), Float(1));
  }
  return s;
}

template <bool textured>
inline void emissive(const MaterialView& m, const MaterialSamplers& samplers, const UvSets& uv, Float (&out)[3]) {
  for (int c = 0; c < 3; ++c) out[c] = Float(m.emissive[c]);
  if constexpr (textured) {
    if (m.emissive_texture.texture != nullptr) {
      Float texel[4];
      sample<channel_r | channel_g | channel_b>(samplers.emissive, transform_uv(m.emissive_texture, uv), texel);
      for (int c = 0; c < 3; ++c) out[c] = out[c] * texel[c];
    }
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

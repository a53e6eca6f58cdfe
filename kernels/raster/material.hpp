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

enum Slot { base_color_slot, metallic_roughness_slot, normal_slot, occlusion_slot, emissive_slot, slot_count };

inline const TextureSlotView& slot_of(const MaterialView& m, int slot) {
  switch (slot) {
    case base_color_slot:
      return m.base_color_texture;
    case metallic_roughness_slot:
      return m.metallic_roughness_texture;
    case normal_slot:
      return m.normal_texture;
    case occlusion_slot:
      return m.occlusion_texture;
    default:
      return m.emissive_texture;
  }
}

/// What a run's material reads from, prepared once.
struct MaterialSamplers {
  TextureSampler sampler[slot_count];  // of slots with footprints of their own
  int footprint[slot_count];           // whose footprint the slot uses: its own or an earlier slot's; -1: no texture
  bool uses_set[2];
  bool packed_occlusion;  // occlusion lies in the red channel of the metallic-roughness texture, sampled alike
};

/// What it reads at a vector of fragments.
struct MaterialSamples {
  UvSet uv[2];
  Footprint footprint[slot_count];
};

inline bool has_texture(const MaterialView& m) {
  bool any = false;
  for (int s = 0; s < slot_count; ++s) any = any || slot_of(m, s).texture != nullptr;
  return any;
}

inline bool same_coordinates(const TextureSlotView& a, const TextureSlotView& b) {
  bool same = a.uv_set == b.uv_set;
  for (int i = 0; i < 6; ++i) same = same && a.transform[i] == b.transform[i];
  return same;
}

/// Prepares the slots before `end`.
inline void prepare_samplers(const MaterialView& m, int end, MaterialSamplers& samplers) {
  samplers.uses_set[0] = samplers.uses_set[1] = false;
  for (int s = 0; s < end; ++s) {
    const TextureSlotView& slot = slot_of(m, s);
    samplers.footprint[s] = slot.texture == nullptr ? -1 : s;
    if (slot.texture == nullptr) continue;
    samplers.uses_set[slot.uv_set & 1] = true;
    for (int earlier = 0; earlier < s && samplers.footprint[s] == s; ++earlier) {
      const TextureSlotView& other = slot_of(m, earlier);
      if (other.texture != nullptr && same_coordinates(slot, other) && sampled_alike(*slot.texture, *other.texture))
        samplers.footprint[s] = earlier;
    }
    if (samplers.footprint[s] == s) prepare_sampler(*slot.texture, samplers.sampler[s]);
  }
  samplers.packed_occlusion = m.occlusion_texture.texture == m.metallic_roughness_texture.texture &&
                              same_coordinates(m.occlusion_texture, m.metallic_roughness_texture);
}

/// A slot's transform, applied to a difference.
inline UvStep transform_step(const TextureSlotView& slot, const UvStep& step) {
  const float(&t)[6] = slot.transform;
  return {mul_add(Float(t[0]), step.du, Float(t[1]) * step.dv), mul_add(Float(t[3]), step.du, Float(t[4]) * step.dv)};
}

/// A slot's coordinates: those of its UV set, transformed (KHR_texture_transform).
inline TextureCoordinates transform_uv(const TextureSlotView& slot, const UvSet (&uv)[2]) {
  const TextureCoordinates& c = uv[slot.uv_set & 1].at;
  const float(&t)[6] = slot.transform;
  const UvStep dx = transform_step(slot, {c.du_dx, c.dv_dx});
  const UvStep dy = transform_step(slot, {c.du_dy, c.dv_dy});
  const Float u = mul_add(Float(t[0]), c.u, mul_add(Float(t[1]), c.v, Float(t[2])));
  const Float v = mul_add(Float(t[3]), c.u, mul_add(Float(t[4]), c.v, Float(t[5])));
  return {u, v, dx.du, dy.du, dx.dv, dy.dv};
}

inline void fetch_uv_set(const GeometryView& geometry, const FragmentLanes& f, const Barycentrics<Float>& b, int s,
                         UvSet& set) {
  Float corners[2][3];
  fetch_attribute(geometry, f, uv_offset + 2 * s, corners);
  set.step1 = {corners[0][1] - corners[0][0], corners[1][1] - corners[1][0]};
  set.step2 = {corners[0][2] - corners[0][0], corners[1][2] - corners[1][0]};
  set.at.u = interpolate(b, corners[0][0], corners[0][1], corners[0][2]);
  set.at.v = interpolate(b, corners[1][0], corners[1][1], corners[1][2]);
  set.at.du_dx = mul_add(set.step1.du, b.b1_dx, set.step2.du * b.b2_dx);
  set.at.dv_dx = mul_add(set.step1.dv, b.b1_dx, set.step2.dv * b.b2_dx);
  set.at.du_dy = mul_add(set.step1.du, b.b1_dy, set.step2.du * b.b2_dy);
  set.at.dv_dy = mul_add(set.step1.dv, b.b1_dy, set.step2.dv * b.b2_dy);
}

/// UV sets and footprints of the slots before `end`, those that are used.
inline void find_samples(const MaterialView& m, const MaterialSamplers& samplers, int end, const GeometryView& geometry,
                         const FragmentLanes& f, const Barycentrics<Float>& b, MaterialSamples& samples) {
  for (int s = 0; s < 2; ++s)
    if (samplers.uses_set[s]) fetch_uv_set(geometry, f, b, s, samples.uv[s]);
  for (int s = 0; s < end; ++s)
    if (samplers.footprint[s] == s)
      find_footprint(samplers.sampler[s], transform_uv(slot_of(m, s), samples.uv), samples.footprint[s]);
}

/// One slot's texel; false if it has no texture.
template <unsigned channels>
inline bool sample_slot(const MaterialView& m, const MaterialSamplers& samplers, const MaterialSamples& samples,
                        int slot, Float (&texel)[4]) {
  const int from = samplers.footprint[slot];
  if (from < 0) return false;
  sample<channels>(*slot_of(m, slot).texture, samples.footprint[from], texel);
  return true;
}

/// Base colour and alpha: factor x vertex colour x texture. Only the wanted channels of out are written.
template <bool textured, unsigned channels>
inline void base_color(const MaterialView& m, const MaterialSamplers& samplers, const MaterialSamples& samples,
                       const GeometryView& geometry, const FragmentLanes& f, const Barycentrics<Float>& b,
                       Float (&out)[4]) {
  Float vertex[4] = {Float(1), Float(1), Float(1), Float(1)};
  if (m.has_colors) interpolate_attribute(geometry, f, b, color_offset, vertex);
  for (int c = 0; c < 4; ++c)
    if (channels >> c & 1) out[c] = Float(m.base_color[c]) * vertex[c];
  if constexpr (textured) {
    Float texel[4];
    if (!sample_slot<channels>(m, samplers, samples, base_color_slot, texel)) return;
    for (int c = 0; c < 4; ++c)
      if (channels >> c & 1) out[c] = out[c] * texel[c];
  }
}

struct SurfaceScalars {
  Float metallic, roughness, occlusion;
};

/// Metallic (B), roughness (G) and occlusion (R: 1 + strength (texel - 1)).
template <bool textured>
inline SurfaceScalars surface_scalars(const MaterialView& m, const MaterialSamplers& samplers,
                                      const MaterialSamples& samples) {
  SurfaceScalars s{Float(m.metallic), Float(m.roughness), Float(1)};
  if constexpr (textured) {
    Float texel[4], open[4] = {Float(1), Float(1), Float(1), Float(1)};
    bool has_metal;
    if (samplers.packed_occlusion) {
      has_metal = sample_slot<channel_r | channel_g | channel_b>(m, samplers, samples, metallic_roughness_slot, texel);
      if (has_metal) open[0] = texel[0];
    } else {
      has_metal = sample_slot<channel_g | channel_b>(m, samplers, samples, metallic_roughness_slot, texel);
      sample_slot<channel_r>(m, samplers, samples, occlusion_slot, open);
    }
    if (has_metal) {
      s.roughness = s.roughness * texel[1];
      s.metallic = s.metallic * texel[2];
    }
    s.occlusion = mul_add(Float(m.occlusion_strength), open[0] - Float(1), Float(1));
  }
  return s;
}

template <bool textured>
inline void emissive(const MaterialView& m, const MaterialSamplers& samplers, const MaterialSamples& samples,
                     Float (&out)[3]) {
  for (int c = 0; c < 3; ++c) out[c] = Float(m.emissive[c]);
  if constexpr (textured) {
    Float texel[4];
    if (!sample_slot<channel_r | channel_g | channel_b>(m, samplers, samples, emissive_slot, texel)) return;
    for (int c = 0; c < 3; ++c) out[c] = out[c] * texel[c];
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

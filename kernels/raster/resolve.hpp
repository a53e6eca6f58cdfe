// Fragments -> G-buffer: surface attributes at the shaded point, textures included.
//
// Domain: indices are within their arrays, vertex_count < 2^27 and triangle_count < 2^29 (gathers have 32-bit indices),
// textures as sample.hpp says. All numbers may be anything: what comes out is in GBufferView's ranges.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/raster/attributes.hpp"
#include "kernels/raster/barycentric.hpp"
#include "kernels/raster/material.hpp"
#include "kernels/raster/normal_map.hpp"
#include "kernels/simd.hpp"
#include "kernels/texture/sample.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// GBufferView's ranges.
TESSERA_INLINE Float clamp_coordinate(Float x) { return clamp(x, Float(-max_coordinate), Float(max_coordinate)); }
TESSERA_INLINE Float clamp_emitted(Float x) { return clamp(x, Float(0), Float(max_radiance)); }

TESSERA_INLINE void store_vector(float* const (&planes)[3], std::uint32_t at, Float x, Float y, Float z) {
  store(planes[0] + at, x);
  store(planes[1] + at, y);
  store(planes[2] + at, z);
}

/// World position and reversed depth.
TESSERA_INLINE void resolve_position(const ResolveArgs& args, const Barycentrics<Float>& b,
                                     const Vec3<Float> (&corners)[3], std::uint32_t at) {
  const Vec3<Float> p = interpolate(b, corners);
  store_vector(args.out.position, at, clamp_coordinate(p.x), clamp_coordinate(p.y), clamp_coordinate(p.z));
  if (args.out.depth != nullptr)
    store(args.out.depth + at, saturate(transform_row(args.view.z, p) / transform_row(args.view.w, p)));
}

/// The tangent frame at the shaded point. `interpolated` is not normalised, `normal` is.
inline TangentFrame<Float> resolve_frame(const ResolveArgs& args, const FragmentLanes& f, const Barycentrics<Float>& b,
                                         const UvSet (&uv)[2], const Vec3<Float>& edge1, const Vec3<Float>& edge2,
                                         const Vec3<Float>& interpolated, const Vec3<Float>& normal) {
  if (args.material->has_tangents) {
    Float tangent[4];
    interpolate_attribute(args.geometry, f, b, tangent_offset, tangent);
    return frame_from_tangent(interpolated, Vec3<Float>{tangent[0], tangent[1], tangent[2]}, tangent[3]);
  }
  const TextureSlotView& slot = args.material->normal_texture;
  const UvSet& set = uv[slot.uv_set & 1];
  const UvStep step1 = transform_step(slot, set.step1);
  const UvStep step2 = transform_step(slot, set.step2);
  return frame_from_uv(normal, edge1, edge2, step1.du, step1.dv, step2.du, step2.dv);
}

/// The unit shading normal of an interpolated one.
TESSERA_INLINE Vec3<Float> unit_normal(const Vec3<Float>& interpolated, const Vec3<Float> (&corners)[3]) {
  const Float squared = dot(interpolated, interpolated);
  // As normalize() decides; the plane's normal is needed only where vertices' normals cancel out.
  if (all((squared > Float(0x1p-126)) & (squared < Float(3e38)))) return interpolated * (Float(1) / sqrt(squared));
  return normalize(interpolated, geometric_normal(corners[1] - corners[0], corners[2] - corners[0]));
}

/// A surface seen from behind is the front's mirror image: the whole frame turns round.
TESSERA_INLINE void store_normal(const ResolveArgs& args, const Vec3<Float>& normal, const Barycentrics<Float>& b,
                                 std::uint32_t at) {
  const Float side = args.material->double_sided ? select(b.back, Float(-1), Float(1)) : Float(1);
  store_vector(args.out.normal, at, normal.x * side, normal.y * side, normal.z * side);
}

template <bool textured>
inline Vec3<Float> resolve_normal(const ResolveArgs& args, const MaterialSamplers& samplers,
                                  const MaterialSamples& samples, const FragmentLanes& f, const Barycentrics<Float>& b,
                                  const Vec3<Float> (&corners)[3]) {
  const MaterialView& material = *args.material;
  Float interpolated[3];
  interpolate_attribute(args.geometry, f, b, normal_offset, interpolated);
  const Vec3<Float> raw{interpolated[0], interpolated[1], interpolated[2]};
  const Vec3<Float> normal = unit_normal(raw, corners);
  if constexpr (textured) {
    Float texel[4];
    if (sample_slot<channel_r | channel_g | channel_b>(material, samplers, samples, normal_slot, texel)) {
      const TangentFrame<Float> frame =
          resolve_frame(args, f, b, samples.uv, corners[1] - corners[0], corners[2] - corners[0], raw, normal);
      return perturb_normal(frame, texel[0], texel[1], texel[2], Float(material.normal_scale), normal);
    }
  }
  return normal;
}

TESSERA_INLINE void store_material(const ResolveArgs& args, const Float (&color)[4], const SurfaceScalars& s,
                                   const Float (&glow)[3], std::uint32_t at) {
  const GBufferView& out = args.out;
  store_vector(out.base_color, at, saturate(color[0]), saturate(color[1]), saturate(color[2]));
  if (out.alpha != nullptr)
    store(out.alpha + at, args.material->alpha_mode == AlphaMode::blend ? saturate(color[3]) : Float(1));
  store(out.metallic + at, saturate(s.metallic));
  store(out.roughness + at, saturate(s.roughness));
  store(out.occlusion + at, saturate(s.occlusion));
  if (out.emissive[0] != nullptr)
    store_vector(out.emissive, at, clamp_emitted(glow[0]), clamp_emitted(glow[1]), clamp_emitted(glow[2]));
  if (out.unlit != nullptr) store(out.unlit + at, Float(args.material->unlit ? 1 : 0));
}

/// A run of fragments on vertices with VertexAttributes.
template <bool textured>
inline void resolve_run(const ResolveArgs& args) {
  const MaterialView& material = *args.material;
  const SampleMeans means = sample_means(args.pattern);
  MaterialSamplers samplers;
  if constexpr (textured) prepare_samplers(material, slot_count, samplers);
  for (std::uint32_t at = 0; at < args.count; at += Float::lanes) {
    const FragmentLanes f = load_fragments(args, means, at);
    Vec3<Float> corners[3];
    fetch_positions(args.geometry, f, corners);
    const Barycentrics<Float> b = barycentrics(args.view, corners, f.x, f.y);
    MaterialSamples samples;
    if constexpr (textured) find_samples(material, samplers, slot_count, args.geometry, f, b, samples);

    resolve_position(args, b, corners, at);
    store_normal(args, resolve_normal<textured>(args, samplers, samples, f, b, corners), b, at);
    Float color[4], glow[3];
    base_color<textured, channel_r | channel_g | channel_b | channel_a>(material, samplers, samples, args.geometry, f,
                                                                        b, color);
    emissive<textured>(material, samplers, samples, glow);
    store_material(args, color, surface_scalars<textured>(material, samplers, samples), glow, at);
  }
}

/// A vector of fragments on SurfaceVertex; registers: as in FragmentLanes. The vertices' thirty-six floats would not
/// stay in registers: the position's quad comes first, then the rest, a vertex at a time.
template <int registers>
TESSERA_INLINE void resolve_surface(const ResolveArgs& args, const FragmentLanes& f, std::uint32_t at) {
  constexpr int stride = sizeof(SurfaceVertex) / sizeof(float), first = 4;
  const float* const base = args.geometry.surfaces->position;
  Float quad[3][first];
  for (int i = 0; i < 3; ++i) fetch_words<registers, stride>(f, base, 0, i, quad[i]);
  Vec3<Float> corners[3];
  for (int i = 0; i < 3; ++i) corners[i] = {quad[i][0], quad[i][1], quad[i][2]};
  const Barycentrics<Float> b = barycentrics(args.view, corners, f.x, f.y);
  resolve_position(args, b, corners, at);

  Float word[stride] = {};
  word[3] = interpolate(b, quad[0][3], quad[1][3], quad[2][3]);
  const Float weight[3] = {b.b0, b.b1, b.b2};
  for (int i = 0; i < 3; ++i) {  // as interpolate()
    Float rest[stride - first];
    fetch_words<registers, stride>(f, base, first, i, rest);
    for (int k = 0; k < stride - first; ++k) {
      if (i == 0)
        word[first + k] = weight[0] * rest[k];
      else
        word[first + k] = mul_add(weight[i], rest[k], word[first + k]);
    }
  }
  store_normal(args, unit_normal({word[3], word[4], word[5]}, corners), b, at);
  const MaterialView& m = *args.material;
  const Float color[4] = {Float(m.base_color[0]) * word[6], Float(m.base_color[1]) * word[7],
                          Float(m.base_color[2]) * word[8], Float(m.base_color[3])};
  const Float glow[3] = {Float(m.emissive[0]), Float(m.emissive[1]), Float(m.emissive[2])};
  const Float open = word[11] - Float(1);
  const SurfaceScalars scalars{Float(m.metallic) * word[9], Float(m.roughness) * word[10],
                               mul_add(Float(m.occlusion_strength), open, Float(1))};
  store_material(args, color, scalars, glow, at);
}
static_assert(offsetof(SurfaceVertex, normal) == 3 * sizeof(float));
static_assert(offsetof(SurfaceVertex, base_color) == 6 * sizeof(float));
static_assert(offsetof(SurfaceVertex, metallic) == 9 * sizeof(float));

/// A run of fragments on SurfaceVertex.
inline void resolve_surface_run(const ResolveArgs& args) {
  const SampleMeans means = sample_means(args.pattern);
  for (std::uint32_t at = 0; at < args.count; at += Float::lanes) {
    const FragmentLanes f = load_fragments(args, means, at);
    if (f.registers == 1)
      resolve_surface<1>(args, f, at);
    else if (f.registers == 2)
      resolve_surface<2>(args, f, at);
    else
      resolve_surface<0>(args, f, at);
  }
}

template <bool textured>
inline void resolve_alpha_run(const ResolveAlphaArgs& args) {
  constexpr int slots = base_color_slot + 1;
  const SampleMeans means = sample_means(args.pattern);
  MaterialSamplers samplers;
  if constexpr (textured) prepare_samplers(*args.material, slots, samplers);
  for (std::uint32_t at = 0; at < args.count; at += Float::lanes) {
    const FragmentLanes f = load_fragments(args, means, at);
    Vec3<Float> corners[3];
    fetch_positions(args.geometry, f, corners);
    const Barycentrics<Float> b = barycentrics(args.view, corners, f.x, f.y);
    MaterialSamples samples;
    if constexpr (textured) find_samples(*args.material, samplers, slots, args.geometry, f, b, samples);
    Float color[4];
    base_color<textured, channel_a>(*args.material, samplers, samples, args.geometry, f, b, color);
    store(args.alpha + at, saturate(color[3]));
  }
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

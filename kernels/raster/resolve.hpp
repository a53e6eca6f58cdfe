// Fragments -> G-buffer: surface attributes at the shaded point, textures included.
//
// Domain: indices are within their arrays, vertex_count < 2^27 and triangle_count < 2^29 (gathers have 32-bit indices),
// textures as sample.hpp says. All numbers may be anything: every plane is finite, normals are unit vectors.
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

inline Float finite_or_zero(Float x) { return select(abs(x) <= Float(3.402823466e38f), x, Float(0)); }
inline Float non_negative(Float x) { return finite_or_zero(max(x, Float(0))); }

inline void store_vector(float* const (&planes)[3], std::uint32_t at, Float x, Float y, Float z) {
  store(planes[0] + at, x);
  store(planes[1] + at, y);
  store(planes[2] + at, z);
}

/// World position and reversed depth.
inline void resolve_position(const ResolveArgs& args, const Barycentrics<Float>& b, const Vec3<Float> (&corners)[3],
                             std::uint32_t at) {
  const Vec3<Float> p = interpolate(b, corners);
  store_vector(args.out.position, at, finite_or_zero(p.x), finite_or_zero(p.y), finite_or_zero(p.z));
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

template <bool textured>
inline void resolve_normal(const ResolveArgs& args, const MaterialSamplers& samplers, const MaterialSamples& samples,
                           const FragmentLanes& f, const Barycentrics<Float>& b, const Vec3<Float> (&corners)[3],
                           std::uint32_t at) {
  const MaterialView& material = *args.material;
  Float interpolated[3];
  interpolate_attribute(args.geometry, f, b, normal_offset, interpolated);
  const Vec3<Float> raw{interpolated[0], interpolated[1], interpolated[2]};
  const Vec3<Float> edge1 = corners[1] - corners[0];
  const Vec3<Float> edge2 = corners[2] - corners[0];
  Vec3<Float> normal = normalize(raw, geometric_normal(edge1, edge2));
  if constexpr (textured) {
    Float texel[4];
    if (sample_slot<channel_r | channel_g | channel_b>(material, samplers, samples, normal_slot, texel)) {
      const TangentFrame<Float> frame = resolve_frame(args, f, b, samples.uv, edge1, edge2, raw, normal);
      normal = perturb_normal(frame, texel[0], texel[1], texel[2], Float(material.normal_scale), normal);
    }
  }
  // A surface seen from behind is the front's mirror image: the whole frame turns round.
  const Float side = material.double_sided ? select(b.back, Float(-1), Float(1)) : Float(1);
  store_vector(args.out.normal, at, normal.x * side, normal.y * side, normal.z * side);
}

template <bool textured>
inline void resolve_run(const ResolveArgs& args) {
  const MaterialView& material = *args.material;
  const SampleMeans means = sample_means(args.pattern);
  MaterialSamplers samplers;
  if constexpr (textured) prepare_samplers(material, slot_count, samplers);
  const GBufferView& out = args.out;
  for (std::uint32_t at = 0; at < args.count; at += Float::lanes) {
    const FragmentLanes f = load_fragments(args, means, at);
    Vec3<Float> corners[3];
    fetch_positions(args.geometry, f, corners);
    const Barycentrics<Float> b = barycentrics(args.view, corners, f.x, f.y);
    MaterialSamples samples;
    if constexpr (textured) find_samples(material, samplers, slot_count, args.geometry, f, b, samples);

    resolve_position(args, b, corners, at);
    resolve_normal<textured>(args, samplers, samples, f, b, corners, at);
    Float color[4];
    base_color<textured, channel_r | channel_g | channel_b | channel_a>(material, samplers, samples, args.geometry, f,
                                                                        b, color);
    store_vector(out.base_color, at, non_negative(color[0]), non_negative(color[1]), non_negative(color[2]));
    store(out.alpha + at, material.alpha_mode == AlphaMode::blend ? saturate(color[3]) : Float(1));
    const SurfaceScalars s = surface_scalars<textured>(material, samplers, samples);
    store(out.metallic + at, saturate(s.metallic));
    store(out.roughness + at, saturate(s.roughness));
    store(out.occlusion + at, saturate(s.occlusion));
    Float glow[3];
    emissive<textured>(material, samplers, samples, glow);
    store_vector(out.emissive, at, non_negative(glow[0]), non_negative(glow[1]), non_negative(glow[2]));
    store(out.unlit + at, Float(material.unlit ? 1 : 0));
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

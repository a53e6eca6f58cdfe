// Texture sampling: nearest, bilinear and trilinear, with per-lane mip levels. Isotropic: the level is that of the
// longer axis of the pixel's footprint.
//
// Texel bits of any value give finite, non-negative results. UVs may be anything (address.hpp). A TextureView must
// describe memory that exists, hold at most max_texture_texels texels with its mips, and have max_texture_levels at
// most: TextureSet (src/precompute) sees to it.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/simd.hpp"
#include "kernels/texture/address.hpp"

namespace tessera::TESSERA_ISA {
namespace {

enum Channels : unsigned { channel_r = 1, channel_g = 2, channel_b = 4, channel_a = 8 };

/// A point of a texture and how it changes per pixel, to the right (dx) and down (dy).
struct TextureCoordinates {
  Float u, v, du_dx, du_dy, dv_dx, dv_dy;
};

/// What one slot's texture is, prepared once per run of fragments.
struct TextureSampler {
  const void* texels;
  TexelFormat format;
  WrapMode wrap_u, wrap_v;
  bool magnify_nearest, minify_nearest, mip_nearest;
  int levels;  // 1: no mips, or not used
  alignas(64) std::int32_t width[max_texture_levels];
  alignas(64) std::int32_t height[max_texture_levels];
  alignas(64) std::int32_t first[max_texture_levels];  // index of the level's first texel
};

inline void prepare_sampler(const TextureView& view, TextureSampler& sampler) {
  sampler.texels = view.texels;
  sampler.format = view.format;
  sampler.wrap_u = view.wrap_u;
  sampler.wrap_v = view.wrap_v;
  sampler.magnify_nearest = view.magnify == FilterMode::nearest;
  sampler.minify_nearest = view.minify == FilterMode::nearest;
  sampler.mip_nearest = view.mip == FilterMode::nearest;
  sampler.levels = !view.mipmapped ? 1 : view.levels < max_texture_levels ? view.levels : max_texture_levels;
  std::int32_t first = 0;
  for (int k = 0; k < sampler.levels; ++k) {
    sampler.width[k] = view.width >> k > 1 ? view.width >> k : 1;
    sampler.height[k] = view.height >> k > 1 ? view.height >> k : 1;
    sampler.first[k] = first;
    first += sampler.width[k] * sampler.height[k];
  }
}

/// log2 of a positive normal number, within 1.2e-4: all that a mip level needs. Exact for powers of two, and without
/// steps between them. The quartic is a minimax fit of log2(1 + t) on [0, 1] (Lawson iteration), 0 at 0 and 1 at 1.
inline Float log2_coarse(Float x) {
  const Float exponent = to_float((bits(x) >> 23) - Int(127));
  const Float t = from_bits((bits(x) & Int(0x7fffff)) | Int(0x3f800000)) - Float(1);
  const Float c32 = mul_add(t, Float(-0x1.50682ap-4), Float(0x1.48e5b0p-2));
  const Float c321 = mul_add(t, c32, Float(-0x1.5b067ap-1));
  return mul_add(t, mul_add(t, c321, Float(0x1.705054p+0)), exponent);
}

/// Level of detail: log2 of the longer axis of a pixel's footprint, in texels of level 0. Within [-50, 50]; NaN: -50.
/// Williams 1983, "Pyramidal Parametrics"; the OpenGL 4.6 specification, section 8.14.1, defines the footprint so.
inline Float level_of_detail(const TextureCoordinates& c, Float width, Float height) {
  const Float ux = c.du_dx * width, vx = c.dv_dx * height;
  const Float uy = c.du_dy * width, vy = c.dv_dy * height;
  const Float squared = max(mul_add(ux, ux, vx * vx), mul_add(uy, uy, vy * vy));
  return Float(0.5) * log2_coarse(clamp(squared, Float(0x1p-100), Float(0x1p100)));
}

/// The wanted channels of one texel per lane: unorm as 0..255, half floats as they are.
template <TexelFormat format, unsigned channels>
inline void fetch_texel(const void* texels, Int index, Float (&out)[4]) {
  if constexpr (format == TexelFormat::rgba8_unorm) {
    const Int rgba = gather_bytes(texels, index << 2);
    if constexpr (channels & channel_r) out[0] = to_float(rgba & Int(255));
    if constexpr (channels & channel_g) out[1] = to_float((rgba >> 8) & Int(255));
    if constexpr (channels & channel_b) out[2] = to_float((rgba >> 16) & Int(255));
    if constexpr (channels & channel_a) out[3] = to_float(shift_right_logical(rgba, 24));
  } else {
    // Exponent and mantissa moved into place, then rebiased by 2^(127 - 15): exact for every half in [0, 65504], its
    // denormals too, and finite for all other bits.
    const Float rebias(0x1p112);
    const Int field(0x1fffe000);
    const Int offset = index << 3;
    if constexpr ((channels & (channel_r | channel_g)) != 0) {
      const Int rg = gather_bytes(texels, offset);
      if constexpr (channels & channel_r) out[0] = from_bits((rg << 13) & field) * rebias;
      if constexpr (channels & channel_g) out[1] = from_bits(shift_right_logical(rg, 3) & field) * rebias;
    }
    if constexpr ((channels & (channel_b | channel_a)) != 0) {
      const Int ba = gather_bytes(static_cast<const char*>(texels) + 4, offset);
      if constexpr (channels & channel_b) out[2] = from_bits((ba << 13) & field) * rebias;
      if constexpr (channels & channel_a) out[3] = from_bits(shift_right_logical(ba, 3) & field) * rebias;
    }
  }
}

template <unsigned channels>
inline void lerp_channels(const Float (&a)[4], const Float (&b)[4], Float t, Float (&out)[4]) {
  for (int c = 0; c < 4; ++c)
    if (channels >> c & 1) out[c] = mul_add(t, b[c] - a[c], a[c]);
}

/// One level per lane, in the texel's own scale.
template <TexelFormat format, unsigned channels>
inline void sample_level(const TextureSampler& t, Float u, Float v, Int level, Mask nearest, Float (&out)[4]) {
  const Int width = gather(t.width, level);
  const Int height = gather(t.height, level);
  const Int first = gather(t.first, level);
  if (all(nearest)) {
    const Int x = nearest_texel(u, t.wrap_u, width);
    const Int y = nearest_texel(v, t.wrap_v, height);
    fetch_texel<format, channels>(t.texels, first + y * width + x, out);
    return;
  }
  const Taps<Float> x = linear_taps(u, t.wrap_u, width, nearest);
  const Taps<Float> y = linear_taps(v, t.wrap_v, height, nearest);
  const Int upper = first + y.first * width;
  const Int lower = first + y.second * width;
  Float a[4], b[4], c[4], d[4], top[4], bottom[4];
  fetch_texel<format, channels>(t.texels, upper + x.first, a);
  fetch_texel<format, channels>(t.texels, upper + x.second, b);
  fetch_texel<format, channels>(t.texels, lower + x.first, c);
  fetch_texel<format, channels>(t.texels, lower + x.second, d);
  lerp_channels<channels>(a, b, x.fraction, top);
  lerp_channels<channels>(c, d, x.fraction, bottom);
  lerp_channels<channels>(top, bottom, y.fraction, out);
}

template <TexelFormat format, unsigned channels>
inline void sample_format(const TextureSampler& t, const TextureCoordinates& at, Float (&out)[4]) {
  Mask nearest = Int(t.magnify_nearest) != Int(0);
  Int level(0);
  Float blend(0);
  if (t.levels > 1 || t.magnify_nearest != t.minify_nearest) {
    const Float lod = level_of_detail(at, Float(t.width[0]), Float(t.height[0]));
    if (t.magnify_nearest != t.minify_nearest) nearest = (lod > Float(0)) ^ nearest;
    const Float fine = clamp(lod, Float(0), Float(t.levels - 1));
    const Float whole = floor(t.mip_nearest ? fine + Float(0.5) : fine);
    level = truncate_to_int(whole);
    if (!t.mip_nearest) blend = fine - whole;
  }
  sample_level<format, channels>(t, at.u, at.v, level, nearest, out);
  if (any(blend > Float(0))) {
    const Int last(t.levels - 1);
    const Int next = level + Int(1);
    Float coarser[4], finer[4];
    for (int c = 0; c < 4; ++c)
      if (channels >> c & 1) finer[c] = out[c];
    sample_level<format, channels>(t, at.u, at.v, select(next > last, last, next), nearest, coarser);
    lerp_channels<channels>(finer, coarser, blend, out);
  }
  if constexpr (format == TexelFormat::rgba8_unorm) {
    static_assert(255.0f * (1.0f / 255.0f) == 1.0f);
    for (int c = 0; c < 4; ++c)
      if (channels >> c & 1) out[c] = out[c] * Float(1.0f / 255.0f);
  }
}

/// Filters the wanted channels into out[0..3] = R, G, B, A; the others are left alone.
template <unsigned channels>
[[gnu::noinline]] void sample(const TextureSampler& t, const TextureCoordinates& at, Float (&out)[4]) {
  if (t.format == TexelFormat::rgba8_unorm)
    sample_format<TexelFormat::rgba8_unorm, channels>(t, at, out);
  else
    sample_format<TexelFormat::rgba16_float, channels>(t, at, out);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

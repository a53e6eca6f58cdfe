// Which texels a pixel's footprint takes, and with what weights: nearest, bilinear and trilinear, with per-lane mip
// levels. Isotropic: the level is that of the longer axis of the footprint. Textures of the same size that are sampled
// alike share one footprint, which costs as much as reading the texels.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/simd.hpp"
#include "kernels/texture/address.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// A point of a texture and how it changes per pixel, to the right (dx) and down (dy).
struct TextureCoordinates {
  Float u, v, du_dx, du_dy, dv_dx, dv_dy;
};

/// How a texture is addressed, prepared once per run of fragments.
struct TextureSampler {
  WrapMode wrap_u, wrap_v;
  bool magnify_nearest, minify_nearest, mip_nearest;
  int levels;  // 1: no mips, or not used
  alignas(64) std::int32_t width[max_texture_levels];
  alignas(64) std::int32_t height[max_texture_levels];
  alignas(64) std::int32_t first[max_texture_levels];  // index of the level's first texel
};

inline void prepare_sampler(const TextureView& view, TextureSampler& sampler) {
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

/// Whether equal coordinates have equal footprints in both.
inline bool sampled_alike(const TextureView& a, const TextureView& b) {
  return a.width == b.width && a.height == b.height && a.levels == b.levels && a.mipmapped == b.mipmapped &&
         a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v && a.magnify == b.magnify && a.minify == b.minify &&
         a.mip == b.mip;
}

/// Texels of one level, by index from the texture's first: upper left, upper right, lower left, lower right; and the
/// weights of the right and of the lower ones.
struct LevelTaps {
  Int texel[4];
  Float right, lower;
  bool side_by_side;  // in every lane a right texel comes after the left one: nowhere between two edges
};

struct Footprint {
  LevelTaps fine, coarse;
  Float blend;      // weight of coarse
  bool one_tap;     // every lane takes texel[0] alone; the rest is not set
  bool two_levels;  // some lane's blend is not 0; otherwise coarse is not set
};

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

inline void level_taps(const TextureSampler& t, Float u, Float v, Int level, Mask nearest, bool one_tap,
                       LevelTaps& taps) {
  Int width, height, first;
  const int k = lane(level, 0);
  if (all(level == Int(k))) {
    width = Int(t.width[k]);
    height = Int(t.height[k]);
    first = Int(t.first[k]);
  } else {
    width = gather(t.width, level);
    height = gather(t.height, level);
    first = gather(t.first, level);
  }
  if (one_tap) {
    taps.texel[0] = first + nearest_texel(v, t.wrap_v, height) * width + nearest_texel(u, t.wrap_u, width);
    return;
  }
  const Taps<Float> x = linear_taps(u, t.wrap_u, width, nearest);
  const Taps<Float> y = linear_taps(v, t.wrap_v, height, nearest);
  taps.side_by_side = all(x.second == x.first + Int(1));
  const Int upper = first + y.first * width;
  const Int lower = first + y.second * width;
  taps.texel[0] = upper + x.first;
  taps.texel[1] = upper + x.second;
  taps.texel[2] = lower + x.first;
  taps.texel[3] = lower + x.second;
  taps.right = x.fraction;
  taps.lower = y.fraction;
}

[[gnu::noinline]] inline void find_footprint(const TextureSampler& t, const TextureCoordinates& at, Footprint& f) {
  Mask nearest = Mask(t.magnify_nearest);
  Int level(0);
  f.blend = Float(0);
  if (t.levels > 1 || t.magnify_nearest != t.minify_nearest) {
    const Float lod = level_of_detail(at, Float(t.width[0]), Float(t.height[0]));
    if (t.magnify_nearest != t.minify_nearest) nearest = (lod > Float(0)) ^ nearest;
    const Float fine = clamp(lod, Float(0), Float(t.levels - 1));
    const Float whole = floor(t.mip_nearest ? fine + Float(0.5) : fine);
    level = truncate_to_int(whole);
    if (!t.mip_nearest) f.blend = fine - whole;
  }
  f.one_tap = all(nearest);
  f.two_levels = any(f.blend > Float(0));
  level_taps(t, at.u, at.v, level, nearest, f.one_tap, f.fine);
  if (f.two_levels) level_taps(t, at.u, at.v, min(level + Int(1), Int(t.levels - 1)), nearest, f.one_tap, f.coarse);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

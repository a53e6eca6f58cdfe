// Tone curves: linear scene colour, exposure applied -> linear display colour. Inputs 0 to 1e18 (beyond, squares
// overflow); `none` and `khronos_neutral` pass values above 1, or round them towards it: clamp afterwards.
#pragma once
#include "kernels/math/vector.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// c / (1 + c) per channel. Reinhard, Stark, Shirley and Ferwerda 2002, "Photographic Tone Reproduction for Digital
// Images", eq. 3.
template <class F>
TESSERA_INLINE Vec3<F> tone_reinhard(Vec3<F> c) {
  return {c.x / (F(1) + c.x), c.y / (F(1) + c.y), c.z / (F(1) + c.z)};
}

// Narkowicz 2016, "ACES Filmic Tone Mapping Curve": a rational fit of the ACES reference transform, per channel,
// without the 0.6 exposure that would match ACES' own middle grey.
template <class F>
TESSERA_INLINE F tone_aces(F c) {
  const F numerator = c * mul_add(c, F(2.51), F(0.03));
  const F denominator = mul_add(c, mul_add(c, F(2.43), F(0.59)), F(0.14));
  return numerator / denominator;
}
template <class F>
TESSERA_INLINE Vec3<F> tone_aces(Vec3<F> c) {
  return {tone_aces(c.x), tone_aces(c.y), tone_aces(c.z)};
}

// Khronos PBR Neutral: base colours below 0.8 come out as they are under a white light; highlights are compressed and
// desaturated. Khronos 3D Formats working group 2024, "PBR Neutral Tone Mapping Specification".
template <class F>
inline Vec3<F> tone_khronos_neutral(Vec3<F> c) {
  const F compression_start = F(0.8 - 0.04), desaturation = F(0.15);
  // Section "Fresnel": take away what a dielectric of F90 = 1, F0 = 0.04 reflects.
  const F least = min(c.x, min(c.y, c.z));
  const F offset = select(least < F(0.08), neg_mul_add(F(6.25) * least, least, least), F(0.04));
  const Vec3<F> base{c.x - offset, c.y - offset, c.z - offset};
  const F peak = max(base.x, max(base.y, base.z));
  const MaskOf<F> plain = peak < compression_start;
  // Compress the peak into [0.76, 1), then blend towards it.
  const F d = F(1 - (0.8 - 0.04));
  const F new_peak = F(1) - (d * d) / ((peak + d) - compression_start);
  const Vec3<F> compressed = base * (new_peak / peak);
  const F blend = F(1) - F(1) / mul_add(desaturation, peak - new_peak, F(1));
  const Vec3<F> white{new_peak, new_peak, new_peak};
  return select<F>(plain, base, lerp(compressed, white, blend));
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

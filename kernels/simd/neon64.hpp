// What xsimd lacks or does inexactly on AArch64, on raw registers. Included by kernels/simd.hpp alone.
#pragma once
#include "kernels/simd/compress_four.hpp"

namespace tessera::TESSERA_ISA {
namespace {
namespace native {

using Arch = xsimd::neon64;
using FloatRegister = float32x4_t;
using IntRegister = int32x4_t;
using MaskRegister = uint32x4_t;

TESSERA_INLINE float32x4_t mul_add(float32x4_t a, float32x4_t b, float32x4_t c) { return vfmaq_f32(c, a, b); }
TESSERA_INLINE float32x4_t mul_sub(float32x4_t a, float32x4_t b, float32x4_t c) {
  return vfmaq_f32(vnegq_f32(c), a, b);
}
TESSERA_INLINE float32x4_t neg_mul_add(float32x4_t a, float32x4_t b, float32x4_t c) { return vfmsq_f32(c, a, b); }
TESSERA_INLINE float32x4_t divide(float32x4_t a, float32x4_t b) { return vdivq_f32(a, b); }
TESSERA_INLINE float32x4_t sqrt(float32x4_t x) { return vsqrtq_f32(x); }
TESSERA_INLINE float32x4_t floor(float32x4_t x) { return vrndmq_f32(x); }
TESSERA_INLINE uint32x4_t not_equal(float32x4_t a, float32x4_t b) { return vmvnq_u32(vceqq_f32(a, b)); }
// FMIN and FMAX treat NaN and signed zeros differently from x86: compare and select instead.
TESSERA_INLINE float32x4_t min(float32x4_t a, float32x4_t b) { return vbslq_f32(vcltq_f32(a, b), a, b); }
TESSERA_INLINE float32x4_t max(float32x4_t a, float32x4_t b) { return vbslq_f32(vcgtq_f32(a, b), a, b); }
TESSERA_INLINE int32x4_t min(int32x4_t a, int32x4_t b) { return vminq_s32(a, b); }
TESSERA_INLINE int32x4_t max(int32x4_t a, int32x4_t b) { return vmaxq_s32(a, b); }

TESSERA_INLINE int32x4_t truncate_to_int(float32x4_t x) { return vcvtq_s32_f32(x); }
TESSERA_INLINE int32x4_t round_to_int(float32x4_t x) { return vcvtnq_s32_f32(x); }
TESSERA_INLINE float32x4_t to_float(int32x4_t x) { return vcvtq_f32_s32(x); }
TESSERA_INLINE int32x4_t bits(float32x4_t x) { return vreinterpretq_s32_f32(x); }
TESSERA_INLINE float32x4_t from_bits(int32x4_t x) { return vreinterpretq_f32_s32(x); }
// Written with the compilers' vector types: constant counts become immediates.
TESSERA_INLINE int32x4_t shift_left(int32x4_t x, int n) { return x << n; }
TESSERA_INLINE int32x4_t shift_right(int32x4_t x, int n) { return x >> n; }
TESSERA_INLINE int32x4_t shift_right_logical(int32x4_t x, int n) {
  return vreinterpretq_s32_u32(vreinterpretq_u32_s32(x) >> static_cast<unsigned>(n));
}
template <int n>
TESSERA_INLINE int32x4_t low_half_shifted(int32x4_t x) {
  return vshrq_n_s32(vshlq_n_s32(x, 16), 16 - n);
}
template <int n>
TESSERA_INLINE int32x4_t high_half_shifted(int32x4_t x) {
  return vshlq_n_s32(vshrq_n_s32(x, 16), n);
}
TESSERA_INLINE int32x4_t dot_halves(int32x4_t a, int32x4_t b) {
  const int16x8_t x = vreinterpretq_s16_s32(a), y = vreinterpretq_s16_s32(b);
  return vpaddq_s32(vmull_s16(vget_low_s16(x), vget_low_s16(y)), vmull_high_s16(x, y));
}

TESSERA_INLINE std::uint32_t mask_bits(uint32x4_t m) {
  const uint32x4_t bit = {1, 2, 4, 8};
  return vaddvq_u32(vandq_u32(m, bit));
}
TESSERA_INLINE uint32x4_t mask_from_bits(std::uint32_t b) {
  const uint32x4_t bit = {1, 2, 4, 8};
  return vtstq_u32(vdupq_n_u32(b), bit);
}
TESSERA_INLINE uint32x4_t mask_from_int(uint32x4_t m) { return m; }
TESSERA_INLINE uint32x4_t mask_to_int(uint32x4_t m) { return m; }

template <int scale>
TESSERA_INLINE int gather_one(const void* base, int index) {
  int value;
  __builtin_memcpy(&value, static_cast<const char*>(base) + std::int64_t{index} * scale, 4);
  return value;
}
template <int scale>
TESSERA_INLINE float32x4_t gather(const void* base, int32x4_t index) {
  const int32x4_t values = {gather_one<scale>(base, index[0]), gather_one<scale>(base, index[1]),
                            gather_one<scale>(base, index[2]), gather_one<scale>(base, index[3])};
  return vreinterpretq_f32_s32(values);
}
template <int scale>
TESSERA_INLINE float32x4_t gather(const void* base, int32x4_t index, uint32x4_t active) {
  int32x4_t values = vdupq_n_s32(0);
  for (int i = 0; i < 4; ++i)
    if (active[i]) values[i] = gather_one<scale>(base, index[i]);
  return vreinterpretq_f32_s32(values);
}

// 64 bits per lane, by bytes.
TESSERA_INLINE void gather_pairs(const void* base, int32x4_t offset, int32x4_t& low, int32x4_t& high) {
  const auto load = [&](int byte) {
    return vreinterpret_s32_u8(vld1_u8(static_cast<const std::uint8_t*>(base) + byte));
  };
  const int32x4_t a = vcombine_s32(load(offset[0]), load(offset[1])),
                  b = vcombine_s32(load(offset[2]), load(offset[3]));
  low = vuzp1q_s32(a, b);
  high = vuzp2q_s32(a, b);
}

// Sixteen bits in the low half of each lane.
TESSERA_INLINE float32x4_t half_to_float(int32x4_t x) {
  return vcvt_f32_f16(vreinterpret_f16_u16(vmovn_u32(vreinterpretq_u32_s32(x))));
}
TESSERA_INLINE int32x4_t float_to_half(float32x4_t x) {
  return vreinterpretq_s32_u32(vmovl_u16(vreinterpret_u16_f16(vcvt_f16_f32(x))));
}
TESSERA_INLINE float32x4_t load_half(const std::uint16_t* p) { return vcvt_f32_f16(vreinterpret_f16_u16(vld1_u16(p))); }
TESSERA_INLINE void store_half(std::uint16_t* p, float32x4_t x) { vst1_u16(p, vreinterpret_u16_f16(vcvt_f16_f32(x))); }

TESSERA_INLINE void store_masked(float* p, float32x4_t x, uint32x4_t m) {
  for (int i = 0; i < 4; ++i)
    if (m[i]) p[i] = x[i];
}
TESSERA_INLINE void store_masked(std::int32_t* p, int32x4_t x, uint32x4_t m) {
  for (int i = 0; i < 4; ++i)
    if (m[i]) p[i] = x[i];
}
TESSERA_INLINE float32x4_t compress(float32x4_t x, uint32x4_t m) {
  return vreinterpretq_f32_u8(vqtbl1q_u8(vreinterpretq_u8_f32(x), vld1q_u8(compress_table.bytes[mask_bits(m)])));
}
TESSERA_INLINE int compress_store(std::int32_t* p, int32x4_t x, uint32x4_t m) {
  int count = 0;
  for (int i = 0; i < 4; ++i)
    if (m[i]) p[count++] = x[i];
  return count;
}

// Records of four words, lane by lane -> one vector per word.
TESSERA_INLINE void transpose_quads(float32x4_t a, float32x4_t b, float32x4_t c, float32x4_t d, float32x4_t (&out)[4]) {
  // a0 c0 a1 c1 and b0 d0 b1 d1, zipped once more.
  const float32x4_t ac_low = vzip1q_f32(a, c), ac_high = vzip2q_f32(a, c);
  const float32x4_t bd_low = vzip1q_f32(b, d), bd_high = vzip2q_f32(b, d);
  out[0] = vzip1q_f32(ac_low, bd_low);
  out[1] = vzip2q_f32(ac_low, bd_low);
  out[2] = vzip1q_f32(ac_high, bd_high);
  out[3] = vzip2q_f32(ac_high, bd_high);
}
TESSERA_INLINE float32x4_t load_quad(const float* p) { return vld1q_f32(p); }
TESSERA_INLINE float32x4_t load_triple(const float* p) {
  return vcombine_f32(vld1_f32(p), vld1_lane_f32(p + 2, vdup_n_f32(0), 0));
}
// The different values in order of first appearance, if there are at most two, and each lane's place among them.
inline constexpr int most_distinct = 2;
TESSERA_INLINE int distinct(int32x4_t x, std::int32_t* values, int32x4_t& place) {
  const uint32x4_t same = vceqq_s32(x, vdupq_laneq_s32(x, 0));
  const std::uint32_t others = ~mask_bits(same) & 15;
  place = vreinterpretq_s32_u32(vbicq_u32(vdupq_n_u32(1), same));
  std::int32_t lanes[4];
  vst1q_s32(lanes, x);
  values[0] = lanes[0];
  values[1] = others == 0 ? 0 : lanes[__builtin_ctz(others)];
  if (others == 0) return 1;
  return mask_bits(vorrq_u32(same, vceqq_s32(x, vdupq_n_s32(values[1])))) == 15 ? 2 : 3;
}
// Records of four words, one or two of them -> one vector per word; place4: four times the lane's record.
inline constexpr int records_per_register = 1;
template <class Load>
TESSERA_INLINE void spread_one(const float* const* record, int32x4_t, const Load& load, float32x4_t (&out)[4]) {
  const float32x4_t r = load(record[0]);
  out[0] = vdupq_laneq_f32(r, 0);
  out[1] = vdupq_laneq_f32(r, 1);
  out[2] = vdupq_laneq_f32(r, 2);
  out[3] = vdupq_laneq_f32(r, 3);
}
template <class Load>
TESSERA_INLINE void spread_two(const float* const* record, int32x4_t place4, const Load& load, float32x4_t (&out)[4]) {
  const uint32x4_t second = vtstq_s32(place4, place4);
  float32x4_t high[4];
  spread_one(record, place4, load, out);
  spread_one(record + 1, place4, load, high);
  for (int i = 0; i < 4; ++i) out[i] = vbslq_f32(second, high[i], out[i]);
}
// Each record's quads lie `stride` apart.
template <int quads>
TESSERA_INLINE void gather_records(const float* const (&p)[4], std::ptrdiff_t stride, float32x4_t* out) {
  for (int q = 0; q < quads; ++q) {
    const std::ptrdiff_t at = stride * q;
    float32x4_t words_of_quad[4];
    transpose_quads(vld1q_f32(p[0] + at), vld1q_f32(p[1] + at), vld1q_f32(p[2] + at), vld1q_f32(p[3] + at),
                    words_of_quad);
    for (int i = 0; i < 4; ++i) out[4 * q + i] = words_of_quad[i];
  }
}
template <int quads>
TESSERA_INLINE void gather_quads(const float* base, int32x4_t words, float32x4_t* out) {
  gather_records<quads>({base + words[0], base + words[1], base + words[2], base + words[3]}, 4, out);
}
template <int quads>
TESSERA_INLINE void gather_quads(const float* base, const std::int32_t* pair, std::ptrdiff_t stride, float32x4_t* out) {
  const auto record = [&](int lane) { return base + std::ptrdiff_t{2} * pair[lane]; };
  gather_records<quads>({record(0), record(1), record(2), record(3)}, stride, out);
}
TESSERA_INLINE void gather_triples(const float* base, int32x4_t words, float32x4_t* out) {
  float32x4_t triple[4];
  transpose_quads(load_triple(base + words[0]), load_triple(base + words[1]), load_triple(base + words[2]),
                  load_triple(base + words[3]), triple);
  for (int i = 0; i < 3; ++i) out[i] = triple[i];
}
TESSERA_INLINE void load_quads(const float* p, float32x4_t (&out)[4]) {
  const float32x4x4_t records = vld4q_f32(p);
  for (int i = 0; i < 4; ++i) out[i] = records.val[i];
}
TESSERA_INLINE void store_quads(float* p, std::size_t, const float32x4_t (&in)[4]) {
  const float32x4x4_t records = {{in[0], in[1], in[2], in[3]}};
  vst4q_f32(p, records);
}
TESSERA_INLINE void stream_quads(float* p, std::size_t, const float32x4_t (&in)[4]) { store_quads(p, 0, in); }
TESSERA_INLINE void scatter_quads(float* p, int stride, const float32x4_t (&in)[4]) {
  float32x4_t record[4];
  transpose_quads(in[0], in[1], in[2], in[3], record);
  for (int i = 0; i < 4; ++i) vst1q_f32(p + stride * i, record[i]);
}
TESSERA_INLINE void load_pairs(const std::int32_t* p, int32x4_t& low, int32x4_t& high) {
  const int32x4x2_t pairs = vld2q_s32(p);
  low = pairs.val[0];
  high = pairs.val[1];
}
TESSERA_INLINE void store_pairs(std::int32_t* p, int32x4_t low, int32x4_t high) {
  const int32x4x2_t pairs = {{low, high}};
  vst2q_s32(p, pairs);
}

}  // namespace native
}  // namespace
}  // namespace tessera::TESSERA_ISA

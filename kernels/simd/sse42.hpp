// What xsimd lacks or does inexactly on SSE4.2, on raw registers. Included by kernels/simd.hpp alone.
#pragma once
#include "kernels/simd/compress_four.hpp"

namespace tessera::TESSERA_ISA {
namespace {
namespace native {

using Arch = xsimd::sse4_2;
using FloatRegister = __m128;
using IntRegister = __m128i;
using MaskRegister = __m128;

// p + c rounded to odd: truncated, with the last bit set if anything was cut off. Rounding that to float, which has
// more than two bits less, is rounding the exact sum once. Boldo and Melquiond 2008, "Emulation of FMA and
// correctly rounded sums: proved algorithms using rounding to odd".
TESSERA_INLINE __m128d add_round_to_odd(__m128d p, __m128d c) {
  const __m128d sum = _mm_add_pd(p, c);
  // Knuth's two-sum: error = exact sum - sum. No overflow: |p| < 2^257.
  const __m128d c_part = _mm_sub_pd(sum, p);
  const __m128d p_part = _mm_sub_pd(sum, c_part);
  const __m128d error = _mm_add_pd(_mm_sub_pd(p, p_part), _mm_sub_pd(c, c_part));
  // False for a NaN, which is what the error of an infinite sum is: that sum stays as it is.
  const __m128d size = _mm_andnot_pd(_mm_set1_pd(-0.0), error);
  const __m128i inexact = _mm_castpd_si128(_mm_cmpgt_pd(size, _mm_setzero_pd()));
  const __m128i rounded_away = _mm_srli_epi64(_mm_castpd_si128(_mm_xor_pd(sum, error)), 63);
  const __m128i truncated = _mm_sub_epi64(_mm_castpd_si128(sum), _mm_and_si128(inexact, rounded_away));
  return _mm_castsi128_pd(_mm_or_si128(truncated, _mm_srli_epi64(inexact, 63)));
}

// The product of two floats is exact in double, so one rounding to odd and one to float are one rounding. Out of line:
// hardly ever needed.
[[gnu::noinline, gnu::cold]] inline __m128 mul_add_rounding_to_odd(__m128 a, __m128 b, __m128 c) {
  const __m128d low = add_round_to_odd(_mm_mul_pd(_mm_cvtps_pd(a), _mm_cvtps_pd(b)), _mm_cvtps_pd(c));
  const __m128d high =
      add_round_to_odd(_mm_mul_pd(_mm_cvtps_pd(_mm_movehl_ps(a, a)), _mm_cvtps_pd(_mm_movehl_ps(b, b))),
                       _mm_cvtps_pd(_mm_movehl_ps(c, c)));
  return _mm_movelh_ps(_mm_cvtpd_ps(low), _mm_cvtpd_ps(high));
}

// Rounding to double and then to float errs only if the double lies half-way between two floats: for a normal result,
// if its last 29 bits are a one and zeros. Such lanes, and subnormal results, are done again with care.
TESSERA_INLINE __m128 mul_add(__m128 a, __m128 b, __m128 c) {
  const __m128d low = _mm_add_pd(_mm_mul_pd(_mm_cvtps_pd(a), _mm_cvtps_pd(b)), _mm_cvtps_pd(c));
  const __m128d high = _mm_add_pd(_mm_mul_pd(_mm_cvtps_pd(_mm_movehl_ps(a, a)), _mm_cvtps_pd(_mm_movehl_ps(b, b))),
                                  _mm_cvtps_pd(_mm_movehl_ps(c, c)));
  const __m128 low_words = _mm_shuffle_ps(_mm_castpd_ps(low), _mm_castpd_ps(high), _MM_SHUFFLE(2, 0, 2, 0));
  const __m128 high_words = _mm_shuffle_ps(_mm_castpd_ps(low), _mm_castpd_ps(high), _MM_SHUFFLE(3, 1, 3, 1));
  const __m128i last_bits = _mm_and_si128(_mm_castps_si128(low_words), _mm_set1_epi32(0x1fffffff));
  const __m128i half_way = _mm_cmpeq_epi32(last_bits, _mm_set1_epi32(0x10000000));
  const __m128i size = _mm_and_si128(_mm_castps_si128(high_words), _mm_set1_epi32(0x7fffffff));
  const __m128i below_normal = _mm_cmplt_epi32(size, _mm_set1_epi32(0x38100000));  // 2^-126
  const __m128i not_zero = _mm_cmpgt_epi32(size, _mm_setzero_si128());
  const __m128i doubtful = _mm_or_si128(half_way, _mm_and_si128(below_normal, not_zero));
  if (__builtin_expect(_mm_movemask_epi8(doubtful) != 0, 0)) return mul_add_rounding_to_odd(a, b, c);
  return _mm_movelh_ps(_mm_cvtpd_ps(low), _mm_cvtpd_ps(high));
}
TESSERA_INLINE __m128 mul_sub(__m128 a, __m128 b, __m128 c) { return mul_add(a, b, _mm_xor_ps(c, _mm_set1_ps(-0.0f))); }
TESSERA_INLINE __m128 neg_mul_add(__m128 a, __m128 b, __m128 c) {
  return mul_add(_mm_xor_ps(a, _mm_set1_ps(-0.0f)), b, c);
}
TESSERA_INLINE __m128 divide(__m128 a, __m128 b) { return _mm_div_ps(a, b); }
TESSERA_INLINE __m128 sqrt(__m128 x) { return _mm_sqrt_ps(x); }
TESSERA_INLINE __m128 floor(__m128 x) { return _mm_round_ps(x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); }
TESSERA_INLINE __m128 not_equal(__m128 a, __m128 b) { return _mm_cmpneq_ps(a, b); }
// MINPS and MAXPS are a < b ? a : b and a > b ? a : b exactly: the second operand if either is NaN or both are zero.
TESSERA_INLINE __m128 min(__m128 a, __m128 b) { return _mm_min_ps(a, b); }
TESSERA_INLINE __m128 max(__m128 a, __m128 b) { return _mm_max_ps(a, b); }
TESSERA_INLINE __m128i min(__m128i a, __m128i b) { return _mm_min_epi32(a, b); }
TESSERA_INLINE __m128i max(__m128i a, __m128i b) { return _mm_max_epi32(a, b); }

TESSERA_INLINE __m128i truncate_to_int(__m128 x) { return _mm_cvttps_epi32(x); }
TESSERA_INLINE __m128i round_to_int(__m128 x) { return _mm_cvtps_epi32(x); }
TESSERA_INLINE __m128 to_float(__m128i x) { return _mm_cvtepi32_ps(x); }
TESSERA_INLINE __m128i bits(__m128 x) { return _mm_castps_si128(x); }
TESSERA_INLINE __m128 from_bits(__m128i x) { return _mm_castsi128_ps(x); }
// Written with the compilers' vector types: constant counts become immediates.
TESSERA_INLINE __m128i shift_left(__m128i x, int n) { return (__m128i)((__v4si)x << n); }
TESSERA_INLINE __m128i shift_right(__m128i x, int n) { return (__m128i)((__v4si)x >> n); }
TESSERA_INLINE __m128i shift_right_logical(__m128i x, int n) { return (__m128i)((__v4su)x >> n); }
template <int n>
TESSERA_INLINE __m128i low_half_shifted(__m128i x) {
  return _mm_madd_epi16(x, _mm_set1_epi32(1 << n));
}
template <int n>
TESSERA_INLINE __m128i high_half_shifted(__m128i x) {
  return _mm_madd_epi16(x, _mm_set1_epi32(1 << (16 + n)));
}
TESSERA_INLINE __m128i dot_halves(__m128i a, __m128i b) { return _mm_madd_epi16(a, b); }

TESSERA_INLINE std::uint32_t mask_bits(__m128 m) { return static_cast<std::uint32_t>(_mm_movemask_ps(m)); }
TESSERA_INLINE __m128 mask_from_bits(std::uint32_t b) {
  const __m128i bit = _mm_setr_epi32(1, 2, 4, 8);
  return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(b)), bit), bit));
}
TESSERA_INLINE __m128 mask_from_int(__m128i m) { return _mm_castsi128_ps(m); }
TESSERA_INLINE __m128i mask_to_int(__m128 m) { return _mm_castps_si128(m); }

template <int scale>
TESSERA_INLINE int gather_one(const void* base, int index) {
  int value;
  __builtin_memcpy(&value, static_cast<const char*>(base) + std::int64_t{index} * scale, 4);
  return value;
}
template <int scale>
TESSERA_INLINE __m128 gather(const void* base, __m128i index) {
  return _mm_castsi128_ps(_mm_setr_epi32(
      gather_one<scale>(base, _mm_extract_epi32(index, 0)), gather_one<scale>(base, _mm_extract_epi32(index, 1)),
      gather_one<scale>(base, _mm_extract_epi32(index, 2)), gather_one<scale>(base, _mm_extract_epi32(index, 3))));
}
template <int scale>
TESSERA_INLINE __m128 gather(const void* base, __m128i index, __m128 active) {
  const std::uint32_t set = mask_bits(active);
  const int x = set & 1 ? gather_one<scale>(base, _mm_extract_epi32(index, 0)) : 0;
  const int y = set & 2 ? gather_one<scale>(base, _mm_extract_epi32(index, 1)) : 0;
  const int z = set & 4 ? gather_one<scale>(base, _mm_extract_epi32(index, 2)) : 0;
  const int w = set & 8 ? gather_one<scale>(base, _mm_extract_epi32(index, 3)) : 0;
  return _mm_castsi128_ps(_mm_setr_epi32(x, y, z, w));
}

// 64 bits per lane, by bytes.
TESSERA_INLINE void gather_pairs(const void* base, __m128i offset, __m128i& low, __m128i& high) {
  const auto load = [&](int byte) {
    return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(static_cast<const char*>(base) + byte));
  };
  const __m128i a = _mm_unpacklo_epi32(load(_mm_extract_epi32(offset, 0)), load(_mm_extract_epi32(offset, 1)));
  const __m128i b = _mm_unpacklo_epi32(load(_mm_extract_epi32(offset, 2)), load(_mm_extract_epi32(offset, 3)));
  low = _mm_unpacklo_epi64(a, b);
  high = _mm_unpackhi_epi64(a, b);
}

// Sixteen bits in the low half of each lane. As F16C: a signalling NaN turns quiet and keeps its other bits.
TESSERA_INLINE __m128 half_to_float(__m128i x) {
  const __m128i magnitude = _mm_and_si128(x, _mm_set1_epi32(0x7fff));
  const __m128i sign = _mm_slli_epi32(_mm_and_si128(x, _mm_set1_epi32(0x8000)), 16);
  // Read as a float, magnitude << 13 is the value times 2^-112; the product is exact, subnormals included.
  const __m128i finite =
      _mm_castps_si128(_mm_mul_ps(_mm_castsi128_ps(_mm_slli_epi32(magnitude, 13)), _mm_set1_ps(0x1p112f)));
  const __m128i quiet = _mm_and_si128(_mm_cmpgt_epi32(magnitude, _mm_set1_epi32(0x7c00)), _mm_set1_epi32(0x400000));
  const __m128i special = _mm_or_si128(_mm_or_si128(_mm_slli_epi32(magnitude, 13), _mm_set1_epi32(0x7f800000)), quiet);
  const __m128i is_special = _mm_cmpgt_epi32(magnitude, _mm_set1_epi32(0x7bff));
  return _mm_castsi128_ps(_mm_or_si128(_mm_blendv_epi8(finite, special, is_special), sign));
}
TESSERA_INLINE __m128i float_to_half(__m128 x) {
  const __m128i all = _mm_castps_si128(x);
  const __m128i magnitude = _mm_and_si128(all, _mm_set1_epi32(0x7fffffff));
  const __m128i sign = _mm_and_si128(_mm_srli_epi32(all, 16), _mm_set1_epi32(0x8000));
  // Normal halves: rebias the exponent by -112, round the low 13 bits to nearest even by adding 0xfff + (bit 13); a
  // carry runs into the exponent, and at the top into infinity.
  const __m128i odd = _mm_and_si128(_mm_srli_epi32(magnitude, 13), _mm_set1_epi32(1));
  const __m128i rebiased = _mm_add_epi32(magnitude, _mm_set1_epi32(0xfff - (112 << 23)));
  const __m128i normal = _mm_srli_epi32(_mm_add_epi32(rebiased, odd), 13);
  // Below 2^-14: adding 0.5, whose ulp 2^-24 is the step of subnormal halves, makes the addition round to that step.
  const __m128 shifted = _mm_add_ps(_mm_castsi128_ps(magnitude), _mm_set1_ps(0.5f));
  const __m128i subnormal = _mm_sub_epi32(_mm_castps_si128(shifted), _mm_set1_epi32(0x3f000000));
  const __m128i payload = _mm_and_si128(_mm_srli_epi32(magnitude, 13), _mm_set1_epi32(0x3ff));
  const __m128i nan = _mm_or_si128(payload, _mm_set1_epi32(0x7e00));
  __m128i half = _mm_blendv_epi8(normal, subnormal, _mm_cmplt_epi32(magnitude, _mm_set1_epi32(0x38800000)));
  half = _mm_blendv_epi8(half, _mm_set1_epi32(0x7c00), _mm_cmpgt_epi32(magnitude, _mm_set1_epi32(0x477fffff)));
  half = _mm_blendv_epi8(half, nan, _mm_cmpgt_epi32(magnitude, _mm_set1_epi32(0x7f800000)));
  return _mm_or_si128(half, sign);
}
TESSERA_INLINE __m128 load_half(const std::uint16_t* p) {
  return half_to_float(_mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p))));
}
TESSERA_INLINE void store_half(std::uint16_t* p, __m128 x) {
  const __m128i half = float_to_half(x);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_packus_epi32(half, half));
}

TESSERA_INLINE void store_masked(std::int32_t* p, __m128i x, __m128 m) {
  const std::uint32_t set = mask_bits(m);
  if (set & 1) p[0] = _mm_extract_epi32(x, 0);
  if (set & 2) p[1] = _mm_extract_epi32(x, 1);
  if (set & 4) p[2] = _mm_extract_epi32(x, 2);
  if (set & 8) p[3] = _mm_extract_epi32(x, 3);
}
TESSERA_INLINE void store_masked(float* p, __m128 x, __m128 m) {
  const std::uint32_t set = mask_bits(m);
  alignas(16) float lanes[4];
  _mm_store_ps(lanes, x);
  for (int i = 0; i < 4; ++i)
    if (set >> i & 1) p[i] = lanes[i];
}
TESSERA_INLINE __m128 compress(__m128 x, __m128 m) {
  const __m128i order = _mm_loadu_si128(reinterpret_cast<const __m128i*>(compress_table.bytes[mask_bits(m)]));
  return _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(x), order));
}
TESSERA_INLINE int compress_store(std::int32_t* p, __m128i x, __m128 m) {
  const std::uint32_t set = mask_bits(m);
  int count = 0;
  if (set & 1) p[count++] = _mm_extract_epi32(x, 0);
  if (set & 2) p[count++] = _mm_extract_epi32(x, 1);
  if (set & 4) p[count++] = _mm_extract_epi32(x, 2);
  if (set & 8) p[count++] = _mm_extract_epi32(x, 3);
  return count;
}

// Records of four words, lane by lane -> one vector per word.
TESSERA_INLINE void transpose_quads(__m128 a, __m128 b, __m128 c, __m128 d, __m128 (&out)[4]) {
  const __m128 ab_low = _mm_unpacklo_ps(a, b), ab_high = _mm_unpackhi_ps(a, b);
  const __m128 cd_low = _mm_unpacklo_ps(c, d), cd_high = _mm_unpackhi_ps(c, d);
  out[0] = _mm_movelh_ps(ab_low, cd_low);
  out[1] = _mm_movehl_ps(cd_low, ab_low);
  out[2] = _mm_movelh_ps(ab_high, cd_high);
  out[3] = _mm_movehl_ps(cd_high, ab_high);
}
TESSERA_INLINE __m128 load_quad(const float* p) { return _mm_loadu_ps(p); }
TESSERA_INLINE __m128 load_triple(const float* p) {
  const __m128i pair = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
  return _mm_movelh_ps(_mm_castsi128_ps(pair), _mm_load_ss(p + 2));
}
// The different values in order of first appearance, if there are at most two, and each lane's place among them.
inline constexpr int most_distinct = 2;
TESSERA_INLINE int distinct(__m128i x, std::int32_t* values, __m128i& place) {
  const __m128i first = _mm_shuffle_epi32(x, 0), same = _mm_cmpeq_epi32(x, first);
  const std::uint32_t others = ~mask_bits(_mm_castsi128_ps(same)) & 15;
  place = _mm_andnot_si128(same, _mm_set1_epi32(1));
  alignas(16) std::int32_t lanes[4];
  _mm_store_si128(reinterpret_cast<__m128i*>(lanes), x);
  values[0] = lanes[0];
  values[1] = others == 0 ? 0 : lanes[__builtin_ctz(others)];
  if (others == 0) return 1;
  const __m128i second = _mm_cmpeq_epi32(x, _mm_set1_epi32(values[1]));
  return mask_bits(_mm_castsi128_ps(_mm_or_si128(same, second))) == 15 ? 2 : 3;
}
// Records of four words, one or two of them -> one vector per word; place4: four times the lane's record.
inline constexpr int records_per_register = 1;
template <class Load>
TESSERA_INLINE void spread_one(const float* const* record, __m128i, const Load& load, __m128 (&out)[4]) {
  const __m128 r = load(record[0]);
  out[0] = _mm_shuffle_ps(r, r, 0x00);
  out[1] = _mm_shuffle_ps(r, r, 0x55);
  out[2] = _mm_shuffle_ps(r, r, 0xaa);
  out[3] = _mm_shuffle_ps(r, r, 0xff);
}
template <class Load>
TESSERA_INLINE void spread_two(const float* const* record, __m128i place4, const Load& load, __m128 (&out)[4]) {
  const __m128 second = _mm_castsi128_ps(_mm_slli_epi32(place4, 29));  // its sign
  __m128 high[4];
  spread_one(record, place4, load, out);
  spread_one(record + 1, place4, load, high);
  for (int i = 0; i < 4; ++i) out[i] = _mm_blendv_ps(out[i], high[i], second);
}
// Each record's quads lie `stride` apart.
template <int quads>
TESSERA_INLINE void gather_records(const float* const (&p)[4], std::ptrdiff_t stride, __m128* out) {
  for (int q = 0; q < quads; ++q) {
    const std::ptrdiff_t at = stride * q;
    __m128 words_of_quad[4];
    transpose_quads(_mm_loadu_ps(p[0] + at), _mm_loadu_ps(p[1] + at), _mm_loadu_ps(p[2] + at), _mm_loadu_ps(p[3] + at),
                    words_of_quad);
    for (int i = 0; i < 4; ++i) out[4 * q + i] = words_of_quad[i];
  }
}
template <int quads>
TESSERA_INLINE void gather_quads(const float* base, __m128i words, __m128* out) {
  gather_records<quads>({base + _mm_extract_epi32(words, 0), base + _mm_extract_epi32(words, 1),
                         base + _mm_extract_epi32(words, 2), base + _mm_extract_epi32(words, 3)},
                        4, out);
}
template <int quads>
TESSERA_INLINE void gather_quads(const float* base, const std::int32_t* pair, std::ptrdiff_t stride, __m128* out) {
  const auto record = [&](int lane) { return base + std::ptrdiff_t{2} * pair[lane]; };
  gather_records<quads>({record(0), record(1), record(2), record(3)}, stride, out);
}
TESSERA_INLINE void gather_triples(const float* base, __m128i words, __m128* out) {
  __m128 triple[4];
  transpose_quads(load_triple(base + _mm_extract_epi32(words, 0)), load_triple(base + _mm_extract_epi32(words, 1)),
                  load_triple(base + _mm_extract_epi32(words, 2)), load_triple(base + _mm_extract_epi32(words, 3)),
                  triple);
  for (int i = 0; i < 3; ++i) out[i] = triple[i];
}
TESSERA_INLINE void load_quads(const float* p, __m128 (&out)[4]) {
  transpose_quads(_mm_loadu_ps(p), _mm_loadu_ps(p + 4), _mm_loadu_ps(p + 8), _mm_loadu_ps(p + 12), out);
}
TESSERA_INLINE void store_quads(float* p, std::size_t, const __m128 (&in)[4]) {
  __m128 record[4];
  transpose_quads(in[0], in[1], in[2], in[3], record);
  for (int i = 0; i < 4; ++i) _mm_storeu_ps(p + 4 * i, record[i]);
}
// Past the caches; p on a multiple of 64 bytes.
TESSERA_INLINE void stream_quads(float* p, std::size_t, const __m128 (&in)[4]) {
  __m128 record[4];
  transpose_quads(in[0], in[1], in[2], in[3], record);
  for (int i = 0; i < 4; ++i) _mm_stream_ps(p + 4 * i, record[i]);
}
TESSERA_INLINE void scatter_quads(float* p, int stride, const __m128 (&in)[4]) {
  __m128 record[4];
  transpose_quads(in[0], in[1], in[2], in[3], record);
  for (int i = 0; i < 4; ++i) _mm_storeu_ps(p + stride * i, record[i]);
}
TESSERA_INLINE void load_pairs(const std::int32_t* p, __m128i& low, __m128i& high) {
  const __m128 a = _mm_loadu_ps(reinterpret_cast<const float*>(p));
  const __m128 b = _mm_loadu_ps(reinterpret_cast<const float*>(p + 4));
  low = _mm_castps_si128(_mm_shuffle_ps(a, b, 0x88));
  high = _mm_castps_si128(_mm_shuffle_ps(a, b, 0xdd));
}
TESSERA_INLINE void store_pairs(std::int32_t* p, __m128i low, __m128i high) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm_unpacklo_epi32(low, high));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p + 4), _mm_unpackhi_epi32(low, high));
}

}  // namespace native
}  // namespace
}  // namespace tessera::TESSERA_ISA

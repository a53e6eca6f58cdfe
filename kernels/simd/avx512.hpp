// What xsimd lacks or does inexactly on AVX-512 (F, BW, DQ, VL), on raw registers. Included by kernels/simd.hpp alone.
#pragma once

namespace tessera::TESSERA_ISA {
namespace {
namespace native {

using Arch = xsimd::avx512bw;
using FloatRegister = __m512;
using IntRegister = __m512i;
using MaskRegister = __mmask16;

TESSERA_INLINE __m512 mul_add(__m512 a, __m512 b, __m512 c) { return _mm512_fmadd_ps(a, b, c); }
TESSERA_INLINE __m512 mul_sub(__m512 a, __m512 b, __m512 c) { return _mm512_fmsub_ps(a, b, c); }
TESSERA_INLINE __m512 neg_mul_add(__m512 a, __m512 b, __m512 c) { return _mm512_fnmadd_ps(a, b, c); }
TESSERA_INLINE __m512 divide(__m512 a, __m512 b) { return _mm512_div_ps(a, b); }
// The zero-masked forms of this file mean the same as the plain ones, whose undefined source operand GCC 12 warns
// about.
TESSERA_INLINE __m512 sqrt(__m512 x) { return _mm512_maskz_sqrt_ps(0xffff, x); }
TESSERA_INLINE __m512 floor(__m512 x) {
  return _mm512_maskz_roundscale_ps(0xffff, x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}
// True for NaN; xsimd 8.1.0 has the ordered comparison on AVX and AVX-512, and misses them.
TESSERA_INLINE __mmask16 not_equal(__m512 a, __m512 b) { return _mm512_cmp_ps_mask(a, b, _CMP_NEQ_UQ); }
// MINPS and MAXPS are a < b ? a : b and a > b ? a : b exactly: the second operand if either is NaN or both are zero.
TESSERA_INLINE __m512 min(__m512 a, __m512 b) { return _mm512_maskz_min_ps(0xffff, a, b); }
TESSERA_INLINE __m512 max(__m512 a, __m512 b) { return _mm512_maskz_max_ps(0xffff, a, b); }
TESSERA_INLINE __m512i min(__m512i a, __m512i b) { return _mm512_maskz_min_epi32(0xffff, a, b); }
TESSERA_INLINE __m512i max(__m512i a, __m512i b) { return _mm512_maskz_max_epi32(0xffff, a, b); }

TESSERA_INLINE __m512i truncate_to_int(__m512 x) { return _mm512_maskz_cvttps_epi32(0xffff, x); }
TESSERA_INLINE __m512i round_to_int(__m512 x) { return _mm512_maskz_cvtps_epi32(0xffff, x); }
TESSERA_INLINE __m512 to_float(__m512i x) { return _mm512_maskz_cvtepi32_ps(0xffff, x); }
TESSERA_INLINE __m512i bits(__m512 x) { return _mm512_castps_si512(x); }
TESSERA_INLINE __m512 from_bits(__m512i x) { return _mm512_castsi512_ps(x); }
// Written with the compilers' vector types: constant counts become immediates.
TESSERA_INLINE __m512i shift_left(__m512i x, int n) { return (__m512i)((__v16si)x << n); }
TESSERA_INLINE __m512i shift_right(__m512i x, int n) { return (__m512i)((__v16si)x >> n); }
TESSERA_INLINE __m512i shift_right_logical(__m512i x, int n) { return (__m512i)((__v16su)x >> n); }
template <int n>
TESSERA_INLINE __m512i low_half_shifted(__m512i x) {
  return _mm512_madd_epi16(x, _mm512_set1_epi32(1 << n));
}
template <int n>
TESSERA_INLINE __m512i high_half_shifted(__m512i x) {
  return _mm512_madd_epi16(x, _mm512_set1_epi32(1 << (16 + n)));
}
TESSERA_INLINE __m512i dot_halves(__m512i a, __m512i b) { return _mm512_madd_epi16(a, b); }

template <int scale>
TESSERA_INLINE __m512 gather(const void* base, __m512i index, __mmask16 active) {
  return _mm512_mask_i32gather_ps(_mm512_setzero_ps(), active, index, base, scale);
}
template <int scale>
TESSERA_INLINE __m512 gather(const void* base, __m512i index) {
  return gather<scale>(base, index, 0xffff);
}

// 64 bits per lane, by bytes.
TESSERA_INLINE void gather_pairs(const void* base, __m512i offset, __m512i& low, __m512i& high) {
  alignas(64) std::int32_t at[16];
  _mm512_store_si512(at, offset);
  asm("" : "+m"(at));            // the compiler would take lanes out by shuffles
  const auto two = [&](int i) {  // lanes i and i + 1
    const auto pair = [&](int k) {
      return reinterpret_cast<const double*>(static_cast<const char*>(base) + at[i + k]);
    };
    return _mm_castpd_ps(_mm_loadh_pd(_mm_load_sd(pair(0)), pair(1)));
  };
  const auto join = [&](int i) {  // lanes i, i + 1, i + 4, i + 5, ..., i + 13
    const __m256 near = _mm256_insertf128_ps(_mm256_castps128_ps256(two(i)), two(i + 4), 1);
    const __m256 far = _mm256_insertf128_ps(_mm256_castps128_ps256(two(i + 8)), two(i + 12), 1);
    return _mm512_insertf32x8(_mm512_castps256_ps512(near), far, 1);
  };
  const __m512 a = join(0), b = join(2);
  low = _mm512_castps_si512(_mm512_maskz_shuffle_ps(0xffff, a, b, 0x88));
  high = _mm512_castps_si512(_mm512_maskz_shuffle_ps(0xffff, a, b, 0xdd));
}

// Sixteen bits in the low half of each lane.
TESSERA_INLINE __m512 half_to_float(__m512i x) {
  return _mm512_maskz_cvtph_ps(0xffff, _mm512_maskz_cvtepi32_epi16(0xffff, x));
}
TESSERA_INLINE __m512i float_to_half(__m512 x) {
  return _mm512_maskz_cvtepu16_epi32(0xffff, _mm512_maskz_cvtps_ph(0xffff, x, _MM_FROUND_TO_NEAREST_INT));
}
TESSERA_INLINE __m512 load_half(const std::uint16_t* p) {
  return _mm512_maskz_cvtph_ps(0xffff, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
}
TESSERA_INLINE void store_half(std::uint16_t* p, __m512 x) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm512_maskz_cvtps_ph(0xffff, x, _MM_FROUND_TO_NEAREST_INT));
}

TESSERA_INLINE std::uint32_t mask_bits(__mmask16 m) { return _cvtmask16_u32(m); }
TESSERA_INLINE __mmask16 mask_from_bits(std::uint32_t b) { return static_cast<__mmask16>(b); }
TESSERA_INLINE __mmask16 mask_from_int(__mmask16 m) { return m; }
TESSERA_INLINE __mmask16 mask_to_int(__mmask16 m) { return m; }

TESSERA_INLINE void store_masked(float* p, __m512 x, __mmask16 m) { _mm512_mask_storeu_ps(p, m, x); }
TESSERA_INLINE void store_masked(std::int32_t* p, __m512i x, __mmask16 m) { _mm512_mask_storeu_epi32(p, m, x); }
TESSERA_INLINE __m512 compress(__m512 x, __mmask16 m) { return _mm512_maskz_compress_ps(m, x); }
TESSERA_INLINE int compress_store(std::int32_t* p, __m512i x, __mmask16 m) {
  const int count = __builtin_popcount(mask_bits(m));
  // Compressing into a register first: the instruction that compresses to memory is microcoded on Zen 4.
  _mm512_mask_storeu_epi32(p, static_cast<__mmask16>((1u << count) - 1), _mm512_maskz_compress_epi32(m, x));
  return count;
}

// Records of four words, lane by lane -> one vector per word. a to d hold the records of lanes 4k to 4k + 3 in their
// k-th quarter.
TESSERA_INLINE void transpose_quads(__m512 a, __m512 b, __m512 c, __m512 d, __m512 (&out)[4]) {
  const __m512 ab_low = _mm512_maskz_unpacklo_ps(0xffff, a, b), ab_high = _mm512_maskz_unpackhi_ps(0xffff, a, b);
  const __m512 cd_low = _mm512_maskz_unpacklo_ps(0xffff, c, d), cd_high = _mm512_maskz_unpackhi_ps(0xffff, c, d);
  out[0] = _mm512_maskz_shuffle_ps(0xffff, ab_low, cd_low, 0x44);
  out[1] = _mm512_maskz_shuffle_ps(0xffff, ab_low, cd_low, 0xee);
  out[2] = _mm512_maskz_shuffle_ps(0xffff, ab_high, cd_high, 0x44);
  out[3] = _mm512_maskz_shuffle_ps(0xffff, ab_high, cd_high, 0xee);
}
TESSERA_INLINE __m128 load_quad(const float* p) { return _mm_loadu_ps(p); }
TESSERA_INLINE __m128 load_triple(const float* p) { return _mm_maskz_loadu_ps(7, p); }
template <class Load>
TESSERA_INLINE __m512 four_records(const float* const (&p)[4], std::ptrdiff_t word, const Load& load) {
  const __m256 low = _mm256_insertf128_ps(_mm256_castps128_ps256(load(p[0] + word)), load(p[1] + word), 1);
  const __m256 high = _mm256_insertf128_ps(_mm256_castps128_ps256(load(p[2] + word)), load(p[3] + word), 1);
  return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
}
// Records begin at multiples of `unit` words; each one's quads lie `stride` apart.
template <int quads, int unit, class Load>
TESSERA_INLINE void gather_records(const float* base, const std::int32_t* index, std::ptrdiff_t stride,
                                   const Load& load, __m512* out) {
  __m512 records[quads][4];
  for (int i = 0; i < 4; ++i) {
    const auto record = [&](int lane) { return base + std::ptrdiff_t{unit} * index[lane]; };
    const float* const p[4] = {record(i), record(i + 4), record(i + 8), record(i + 12)};
    for (int q = 0; q < quads; ++q) records[q][i] = four_records(p, stride * q, load);
  }
  for (int q = 0; q < quads; ++q) {
    __m512 words_of_quad[4];
    transpose_quads(records[q][0], records[q][1], records[q][2], records[q][3], words_of_quad);
    for (int i = 0; i < 4; ++i) out[4 * q + i] = words_of_quad[i];
  }
}
template <int quads, class Load>
TESSERA_INLINE void gather_records(const float* base, __m512i words, const Load& load, __m512* out) {
  alignas(64) std::int32_t word[16];
  _mm512_store_si512(word, words);
  asm("" : "+m"(word));  // the compiler would take lanes out by shuffles, which are what the transposition needs
  gather_records<quads, 1>(base, word, 4, load, out);
}
template <int quads>
TESSERA_INLINE void gather_quads(const float* base, const std::int32_t* pair, std::ptrdiff_t stride, __m512* out) {
  gather_records<quads, 2>(
      base, pair, stride, [](const float* p) { return load_quad(p); }, out);
}
template <int quads>
TESSERA_INLINE void gather_quads(const float* base, __m512i words, __m512* out) {
  gather_records<quads>(
      base, words, [](const float* p) { return load_quad(p); }, out);
}
TESSERA_INLINE void gather_triples(const float* base, __m512i words, __m512* out) {
  gather_records<1>(
      base, words, [](const float* p) { return load_triple(p); }, out);
}
// Lane 4a + b <-> lane 4b + a.
TESSERA_INLINE __m512 swap_quarters(__m512 x) {
  const __m512i lane = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
  return _mm512_maskz_permutexvar_ps(0xffff, lane, x);
}
TESSERA_INLINE void load_quads(const float* p, __m512 (&out)[4]) {
  transpose_quads(_mm512_loadu_ps(p), _mm512_loadu_ps(p + 16), _mm512_loadu_ps(p + 32), _mm512_loadu_ps(p + 48), out);
  for (__m512& x : out) x = swap_quarters(x);
}
TESSERA_INLINE void store_quads(float* p, std::size_t row_stride, const __m512 (&in)[4]) {
  __m512 record[4];
  transpose_quads(swap_quarters(in[0]), swap_quarters(in[1]), swap_quarters(in[2]), swap_quarters(in[3]), record);
  for (int i = 0; i < 4; ++i) _mm512_storeu_ps(p + row_stride * std::size_t(i), record[i]);
}
// Past the caches; p on a multiple of 64 bytes.
TESSERA_INLINE void stream_quads(float* p, std::size_t row_stride, const __m512 (&in)[4]) {
  __m512 record[4];
  transpose_quads(swap_quarters(in[0]), swap_quarters(in[1]), swap_quarters(in[2]), swap_quarters(in[3]), record);
  for (int i = 0; i < 4; ++i) _mm512_stream_ps(p + row_stride * std::size_t(i), record[i]);
}
TESSERA_INLINE void scatter_quads(float* p, int stride, const __m512 (&in)[4]) {
  __m512 record[4];
  transpose_quads(in[0], in[1], in[2], in[3], record);
  for (int i = 0; i < 4; ++i) {
    const __m512 r = record[i];
    _mm_storeu_ps(p + stride * i, __builtin_shufflevector(r, r, 0, 1, 2, 3));
    _mm_storeu_ps(p + stride * (4 + i), __builtin_shufflevector(r, r, 4, 5, 6, 7));
    _mm_storeu_ps(p + stride * (8 + i), __builtin_shufflevector(r, r, 8, 9, 10, 11));
    _mm_storeu_ps(p + stride * (12 + i), __builtin_shufflevector(r, r, 12, 13, 14, 15));
  }
}
// The different values in order of first appearance, zeros after them, and each lane's place among them.
inline constexpr int most_distinct = 16;
TESSERA_INLINE int distinct(__m512i x, std::int32_t* values, __m512i& place) {
  const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i earlier = _mm512_maskz_conflict_epi32(0xffff, x);  // bit i: equals lane i, which comes before
  const __mmask16 first = _mm512_testn_epi32_mask(earlier, earlier);
  _mm512_store_si512(values, _mm512_maskz_compress_epi32(first, x));
  // The lowest set bit of `earlier` is the lane that a repeated value appeared in first.
  const __m512i lowest = _mm512_and_si512(earlier, _mm512_sub_epi32(_mm512_setzero_si512(), earlier));
  const __m512i source = _mm512_mask_sub_epi32(lane, static_cast<__mmask16>(~first), _mm512_set1_epi32(31),
                                               _mm512_maskz_lzcnt_epi32(0xffff, lowest));
  place = _mm512_maskz_permutexvar_epi32(0xffff, source, _mm512_maskz_expand_epi32(first, lane));
  return __builtin_popcount(mask_bits(first));
}
// Records of four words, at most four or eight of them -> one vector per word; place4: four times the lane's record.
inline constexpr int records_per_register = 4;
template <class Load>
TESSERA_INLINE void spread_one(const float* const* record, __m512i place4, const Load& load, __m512 (&out)[4]) {
  const float* const p[4] = {record[0], record[1], record[2], record[3]};
  const __m512 records = four_records(p, 0, load);
  for (int i = 0; i < 4; ++i)
    out[i] = _mm512_maskz_permutexvar_ps(0xffff, _mm512_add_epi32(place4, _mm512_set1_epi32(i)), records);
}
template <class Load>
TESSERA_INLINE void spread_two(const float* const* record, __m512i place4, const Load& load, __m512 (&out)[4]) {
  const float* const p[4] = {record[0], record[1], record[2], record[3]};
  const float* const q[4] = {record[4], record[5], record[6], record[7]};
  const __m512 low = four_records(p, 0, load), high = four_records(q, 0, load);
  for (int i = 0; i < 4; ++i)
    out[i] = _mm512_permutex2var_ps(low, _mm512_add_epi32(place4, _mm512_set1_epi32(i)), high);
}
TESSERA_INLINE void load_pairs(const std::int32_t* p, __m512i& low, __m512i& high) {
  const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  const __m512i a = _mm512_loadu_si512(p), b = _mm512_loadu_si512(p + 16);
  low = _mm512_permutex2var_epi32(a, even, b);
  high = _mm512_permutex2var_epi32(a, _mm512_add_epi32(even, _mm512_set1_epi32(1)), b);
}
TESSERA_INLINE void store_pairs(std::int32_t* p, __m512i low, __m512i high) {
  const __m512i front = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
  _mm512_storeu_si512(p, _mm512_permutex2var_epi32(low, front, high));
  _mm512_storeu_si512(p + 16, _mm512_permutex2var_epi32(low, _mm512_add_epi32(front, _mm512_set1_epi32(8)), high));
}

}  // namespace native
}  // namespace
}  // namespace tessera::TESSERA_ISA

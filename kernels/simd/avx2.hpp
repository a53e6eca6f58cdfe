// What xsimd lacks or does inexactly on AVX2 with FMA and F16C, on raw registers. Included by kernels/simd.hpp alone.
#pragma once

namespace tessera::TESSERA_ISA {
namespace {
namespace native {

using Arch = xsimd::avx2;
using FloatRegister = __m256;
using IntRegister = __m256i;
using MaskRegister = __m256;

TESSERA_INLINE __m256 mul_add(__m256 a, __m256 b, __m256 c) { return _mm256_fmadd_ps(a, b, c); }
TESSERA_INLINE __m256 mul_sub(__m256 a, __m256 b, __m256 c) { return _mm256_fmsub_ps(a, b, c); }
TESSERA_INLINE __m256 neg_mul_add(__m256 a, __m256 b, __m256 c) { return _mm256_fnmadd_ps(a, b, c); }
TESSERA_INLINE __m256 divide(__m256 a, __m256 b) { return _mm256_div_ps(a, b); }
TESSERA_INLINE __m256 sqrt(__m256 x) { return _mm256_sqrt_ps(x); }
TESSERA_INLINE __m256 floor(__m256 x) { return _mm256_round_ps(x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); }
// True for NaN; xsimd 8.1.0 has the ordered comparison on AVX and AVX-512, and misses them.
TESSERA_INLINE __m256 not_equal(__m256 a, __m256 b) { return _mm256_cmp_ps(a, b, _CMP_NEQ_UQ); }
// MINPS and MAXPS are a < b ? a : b and a > b ? a : b exactly: the second operand if either is NaN or both are zero.
TESSERA_INLINE __m256 min(__m256 a, __m256 b) { return _mm256_min_ps(a, b); }
TESSERA_INLINE __m256 max(__m256 a, __m256 b) { return _mm256_max_ps(a, b); }
TESSERA_INLINE __m256i min(__m256i a, __m256i b) { return _mm256_min_epi32(a, b); }
TESSERA_INLINE __m256i max(__m256i a, __m256i b) { return _mm256_max_epi32(a, b); }

TESSERA_INLINE __m256i truncate_to_int(__m256 x) { return _mm256_cvttps_epi32(x); }
TESSERA_INLINE __m256i round_to_int(__m256 x) { return _mm256_cvtps_epi32(x); }
TESSERA_INLINE __m256 to_float(__m256i x) { return _mm256_cvtepi32_ps(x); }
TESSERA_INLINE __m256i bits(__m256 x) { return _mm256_castps_si256(x); }
TESSERA_INLINE __m256 from_bits(__m256i x) { return _mm256_castsi256_ps(x); }
// Written with the compilers' vector types: constant counts become immediates.
TESSERA_INLINE __m256i shift_left(__m256i x, int n) { return (__m256i)((__v8si)x << n); }
TESSERA_INLINE __m256i shift_right(__m256i x, int n) { return (__m256i)((__v8si)x >> n); }
TESSERA_INLINE __m256i shift_right_logical(__m256i x, int n) { return (__m256i)((__v8su)x >> n); }
template <int n>
TESSERA_INLINE __m256i low_half_shifted(__m256i x) {
  return _mm256_madd_epi16(x, _mm256_set1_epi32(1 << n));
}
template <int n>
TESSERA_INLINE __m256i high_half_shifted(__m256i x) {
  return _mm256_madd_epi16(x, _mm256_set1_epi32(1 << (16 + n)));
}
TESSERA_INLINE __m256i dot_halves(__m256i a, __m256i b) { return _mm256_madd_epi16(a, b); }

template <int scale>
TESSERA_INLINE __m256 gather(const void* base, __m256i index, __m256 active) {
  return _mm256_mask_i32gather_ps(_mm256_setzero_ps(), static_cast<const float*>(base), index, active, scale);
}
template <int scale>
TESSERA_INLINE __m256 gather(const void* base, __m256i index) {
  return gather<scale>(base, index, _mm256_castsi256_ps(_mm256_set1_epi32(-1)));
}

// 64 bits per lane, by bytes.
TESSERA_INLINE void gather_pairs(const void* base, __m256i offset, __m256i& low, __m256i& high) {
  alignas(32) std::int32_t at[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(at), offset);
  asm("" : "+m"(at));            // the compiler would take lanes out by shuffles
  const auto two = [&](int i) {  // lanes i and i + 1
    const auto pair = [&](int k) {
      return reinterpret_cast<const double*>(static_cast<const char*>(base) + at[i + k]);
    };
    return _mm_castpd_si128(_mm_loadh_pd(_mm_load_sd(pair(0)), pair(1)));
  };
  const auto join = [](__m128i a, __m128i b) {
    return _mm256_castsi256_ps(_mm256_inserti128_si256(_mm256_castsi128_si256(a), b, 1));
  };
  const __m256 a = join(two(0), two(4)), b = join(two(2), two(6));
  low = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0x88));
  high = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0xdd));
}

// Sixteen bits in the low half of each lane.
TESSERA_INLINE __m256 half_to_float(__m256i x) {
  const __m256i low = _mm256_and_si256(x, _mm256_set1_epi32(0xffff));
  const __m256i packed = _mm256_permute4x64_epi64(_mm256_packus_epi32(low, low), 0x08);
  return _mm256_cvtph_ps(_mm256_castsi256_si128(packed));
}
TESSERA_INLINE __m256i float_to_half(__m256 x) {
  return _mm256_cvtepu16_epi32(_mm256_cvtps_ph(x, _MM_FROUND_TO_NEAREST_INT));
}
TESSERA_INLINE __m256 load_half(const std::uint16_t* p) {
  return _mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
}
TESSERA_INLINE void store_half(std::uint16_t* p, __m256 x) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm256_cvtps_ph(x, _MM_FROUND_TO_NEAREST_INT));
}

TESSERA_INLINE std::uint32_t mask_bits(__m256 m) { return static_cast<std::uint32_t>(_mm256_movemask_ps(m)); }
TESSERA_INLINE __m256 mask_from_bits(std::uint32_t b) {
  const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  return _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(b)), bit), bit));
}
TESSERA_INLINE __m256 mask_from_int(__m256i m) { return _mm256_castsi256_ps(m); }
TESSERA_INLINE __m256i mask_to_int(__m256 m) { return _mm256_castps_si256(m); }

TESSERA_INLINE void store_masked(float* p, __m256 x, __m256 m) { _mm256_maskstore_ps(p, _mm256_castps_si256(m), x); }
TESSERA_INLINE void store_masked(std::int32_t* p, __m256i x, __m256 m) {
  _mm256_maskstore_epi32(p, _mm256_castps_si256(m), x);
}

// For each of the 256 masks, the lanes that are set, ascending, one per byte.
struct CompressTable {
  std::uint64_t lanes[256];
  constexpr CompressTable() : lanes{} {
    for (int m = 0; m < 256; ++m)
      for (int lane = 0, count = 0; lane < 8; ++lane)
        if (m >> lane & 1) lanes[m] |= static_cast<std::uint64_t>(lane) << (8 * count++);
  }
};
constexpr CompressTable compress_table;

TESSERA_INLINE __m256 compress(__m256 x, __m256 m) {
  const __m128i packed = _mm_cvtsi64_si128(static_cast<long long>(compress_table.lanes[mask_bits(m)]));
  return _mm256_permutevar8x32_ps(x, _mm256_cvtepu8_epi32(packed));
}
TESSERA_INLINE int compress_store(std::int32_t* p, __m256i x, __m256 m) {
  const int count = __builtin_popcount(mask_bits(m));
  const __m256i front = _mm256_castps_si256(compress(_mm256_castsi256_ps(x), m));
  _mm256_maskstore_epi32(p, _mm256_castps_si256(mask_from_bits((1u << count) - 1)), front);
  return count;
}

TESSERA_INLINE __m128 load_quad(const float* p) { return _mm_loadu_ps(p); }
TESSERA_INLINE __m128 load_triple(const float* p) { return _mm_maskload_ps(p, _mm_setr_epi32(-1, -1, -1, 0)); }

// Records of four words, lane by lane -> one vector per word. a to d hold the records of lanes 4k to 4k + 3 in their
// k-th half.
TESSERA_INLINE void transpose_quads(__m256 a, __m256 b, __m256 c, __m256 d, __m256 (&out)[4]) {
  const __m256 ab_low = _mm256_unpacklo_ps(a, b), ab_high = _mm256_unpackhi_ps(a, b);
  const __m256 cd_low = _mm256_unpacklo_ps(c, d), cd_high = _mm256_unpackhi_ps(c, d);
  out[0] = _mm256_shuffle_ps(ab_low, cd_low, 0x44);
  out[1] = _mm256_shuffle_ps(ab_low, cd_low, 0xee);
  out[2] = _mm256_shuffle_ps(ab_high, cd_high, 0x44);
  out[3] = _mm256_shuffle_ps(ab_high, cd_high, 0xee);
}
// Records begin at multiples of `unit` words; each one's quads lie `stride` apart.
template <int quads, int unit, class Load>
TESSERA_INLINE void gather_records(const float* base, const std::int32_t* index, std::ptrdiff_t stride,
                                   const Load& load, __m256* out) {
  __m256 records[quads][4];
  for (int i = 0; i < 4; ++i) {
    const auto record = [&](int lane) { return base + std::ptrdiff_t{unit} * index[lane]; };
    const float *low = record(i), *high = record(i + 4);
    for (int q = 0; q < quads; ++q)
      records[q][i] = _mm256_insertf128_ps(_mm256_castps128_ps256(load(low + stride * q)), load(high + stride * q), 1);
  }
  for (int q = 0; q < quads; ++q) {
    __m256 words_of_quad[4];
    transpose_quads(records[q][0], records[q][1], records[q][2], records[q][3], words_of_quad);
    for (int i = 0; i < 4; ++i) out[4 * q + i] = words_of_quad[i];
  }
}
template <int quads, class Load>
TESSERA_INLINE void gather_records(const float* base, __m256i words, const Load& load, __m256* out) {
  alignas(32) std::int32_t word[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(word), words);
  asm("" : "+m"(word));  // the compiler would take lanes out by shuffles, which are what the transposition needs
  gather_records<quads, 1>(base, word, 4, load, out);
}
template <int quads>
TESSERA_INLINE void gather_quads(const float* base, const std::int32_t* pair, std::ptrdiff_t stride, __m256* out) {
  gather_records<quads, 2>(
      base, pair, stride, [](const float* p) { return load_quad(p); }, out);
}
template <int quads>
TESSERA_INLINE void gather_quads(const float* base, __m256i words, __m256* out) {
  gather_records<quads>(
      base, words, [](const float* p) { return load_quad(p); }, out);
}
TESSERA_INLINE void gather_triples(const float* base, __m256i words, __m256* out) {
  gather_records<1>(
      base, words, [](const float* p) { return load_triple(p); }, out);
}
// The different values in order of first appearance, if there are at most four, and each lane's place among them.
inline constexpr int most_distinct = 4;
TESSERA_INLINE int distinct(__m256i x, std::int32_t* values, __m256i& place) {
  alignas(32) std::int32_t lanes[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(lanes), x);
  std::uint32_t unseen = 0xff;
  int count = 0;
  place = _mm256_setzero_si256();
  for (int i = 0; i < most_distinct; ++i) values[i] = 0;
  for (; unseen != 0 && count < most_distinct; ++count) {
    values[count] = lanes[__builtin_ctz(unseen)];
    const __m256i same = _mm256_cmpeq_epi32(x, _mm256_set1_epi32(values[count]));
    place = _mm256_or_si256(place, _mm256_and_si256(same, _mm256_set1_epi32(count)));
    unseen &= ~static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(same)));
  }
  return unseen == 0 ? count : count + 1;
}
// Records of four words, at most two or four of them -> one vector per word; place4: four times the lane's record.
inline constexpr int records_per_register = 2;
template <class Load>
TESSERA_INLINE __m256 two_records(const float* const* record, const Load& load) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(load(record[0])), load(record[1]), 1);
}
template <class Load>
TESSERA_INLINE void spread_one(const float* const* record, __m256i place4, const Load& load, __m256 (&out)[4]) {
  const __m256 records = two_records(record, load);
  for (int i = 0; i < 4; ++i)
    out[i] = _mm256_permutevar8x32_ps(records, _mm256_add_epi32(place4, _mm256_set1_epi32(i)));
}
template <class Load>
TESSERA_INLINE void spread_two(const float* const* record, __m256i place4, const Load& load, __m256 (&out)[4]) {
  const __m256 low = two_records(record, load), high = two_records(record + 2, load);
  const __m256 second = _mm256_castsi256_ps(_mm256_slli_epi32(place4, 28));  // its sign: place 2 or 3
  for (int i = 0; i < 4; ++i) {
    const __m256i lane = _mm256_add_epi32(place4, _mm256_set1_epi32(i));
    out[i] = _mm256_blendv_ps(_mm256_permutevar8x32_ps(low, lane), _mm256_permutevar8x32_ps(high, lane), second);
  }
}
TESSERA_INLINE void load_quads(const float* p, __m256 (&out)[4]) {
  transpose_quads(_mm256_loadu_ps(p), _mm256_loadu_ps(p + 8), _mm256_loadu_ps(p + 16), _mm256_loadu_ps(p + 24), out);
  const __m256i lane = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
  for (__m256& x : out) x = _mm256_permutevar8x32_ps(x, lane);
}
TESSERA_INLINE void store_quads(float* p, std::size_t row_stride, const __m256 (&in)[4]) {
  const __m256i lane = _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7);
  __m256 mixed[4], record[4];
  for (int i = 0; i < 4; ++i) mixed[i] = _mm256_permutevar8x32_ps(in[i], lane);
  // Words and lanes change places: the k-th half of record[j] is lane 2j + k.
  transpose_quads(mixed[0], mixed[1], mixed[2], mixed[3], record);
  for (int i = 0; i < 4; ++i) _mm256_storeu_ps(p + row_stride * std::size_t(i / 2) + i % 2 * 8, record[i]);
}
// Past the caches; p on a multiple of 64 bytes.
TESSERA_INLINE void stream_quads(float* p, std::size_t row_stride, const __m256 (&in)[4]) {
  const __m256i lane = _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7);
  __m256 mixed[4], record[4];
  for (int i = 0; i < 4; ++i) mixed[i] = _mm256_permutevar8x32_ps(in[i], lane);
  // Words and lanes change places: the k-th half of record[j] is lane 2j + k.
  transpose_quads(mixed[0], mixed[1], mixed[2], mixed[3], record);
  for (int i = 0; i < 4; ++i) _mm256_stream_ps(p + row_stride * std::size_t(i / 2) + i % 2 * 8, record[i]);
}
TESSERA_INLINE void scatter_quads(float* p, int stride, const __m256 (&in)[4]) {
  __m256 record[4];
  transpose_quads(in[0], in[1], in[2], in[3], record);
  for (int i = 0; i < 4; ++i) {
    _mm_storeu_ps(p + stride * i, _mm256_castps256_ps128(record[i]));
    _mm_storeu_ps(p + stride * (4 + i), _mm256_extractf128_ps(record[i], 1));
  }
}
TESSERA_INLINE void load_pairs(const std::int32_t* p, __m256i& low, __m256i& high) {
  const __m256 a = _mm256_loadu_ps(reinterpret_cast<const float*>(p));
  const __m256 b = _mm256_loadu_ps(reinterpret_cast<const float*>(p + 8));
  low = _mm256_permute4x64_epi64(_mm256_castps_si256(_mm256_shuffle_ps(a, b, 0x88)), 0xd8);
  high = _mm256_permute4x64_epi64(_mm256_castps_si256(_mm256_shuffle_ps(a, b, 0xdd)), 0xd8);
}
TESSERA_INLINE void store_pairs(std::int32_t* p, __m256i low, __m256i high) {
  const __m256i a = _mm256_unpacklo_epi32(low, high), b = _mm256_unpackhi_epi32(low, high);  // by halves
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_permute2x128_si256(a, b, 0x20));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p + 8), _mm256_permute2x128_si256(a, b, 0x31));
}

}  // namespace native
}  // namespace
}  // namespace tessera::TESSERA_ISA

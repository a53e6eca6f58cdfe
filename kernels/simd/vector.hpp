// Operators and functions of Float, Int and Mask. Included by kernels/simd.hpp alone.
#pragma once

namespace tessera::TESSERA_ISA {
namespace {

// ------------------------------------------------------------------------------------------------------------ mask

TESSERA_INLINE Mask operator&(Mask a, Mask b) { return Mask(a.batch & b.batch); }
TESSERA_INLINE Mask operator|(Mask a, Mask b) { return Mask(a.batch | b.batch); }
// Not xsimd's ^: in 8.1.0, that of AVX-512 masks is an or.
TESSERA_INLINE Mask operator^(Mask a, Mask b) { return Mask((a.batch | b.batch) & ~(a.batch & b.batch)); }
TESSERA_INLINE Mask operator~(Mask a) { return Mask(~a.batch); }
TESSERA_INLINE Mask operator!(Mask a) { return Mask(~a.batch); }
TESSERA_INLINE Mask& operator&=(Mask& a, Mask b) { return a = a & b; }
TESSERA_INLINE Mask& operator|=(Mask& a, Mask b) { return a = a | b; }
TESSERA_INLINE Mask& operator^=(Mask& a, Mask b) { return a = a ^ b; }

// Bit i is lane i.
TESSERA_INLINE std::uint32_t to_bits(Mask m) { return native::mask_bits(m.raw()); }
TESSERA_INLINE Mask from_mask_bits(std::uint32_t bits) { return make_mask(native::mask_from_bits(bits)); }
TESSERA_INLINE bool any(Mask m) { return to_bits(m) != 0; }
TESSERA_INLINE bool none(Mask m) { return to_bits(m) == 0; }
TESSERA_INLINE bool all(Mask m) { return to_bits(m) == (1u << Float::lanes) - 1; }

// ------------------------------------------------------------------------------------------------------------- int

TESSERA_INLINE Int operator+(Int a, Int b) { return Int(a.batch + b.batch); }
TESSERA_INLINE Int operator-(Int a, Int b) { return Int(a.batch - b.batch); }
TESSERA_INLINE Int operator*(Int a, Int b) { return Int(a.batch * b.batch); }
TESSERA_INLINE Int operator-(Int a) { return Int(Int(0).batch - a.batch); }
TESSERA_INLINE Int operator&(Int a, Int b) { return Int(a.batch & b.batch); }
TESSERA_INLINE Int operator|(Int a, Int b) { return Int(a.batch | b.batch); }
TESSERA_INLINE Int operator^(Int a, Int b) { return Int(a.batch ^ b.batch); }
TESSERA_INLINE Int operator~(Int a) { return Int(a.batch ^ Int(-1).batch); }
// 0 <= n <= 31; >> keeps the sign.
TESSERA_INLINE Int operator<<(Int a, int n) { return make_int(native::shift_left(a.raw(), n)); }
TESSERA_INLINE Int operator>>(Int a, int n) { return make_int(native::shift_right(a.raw(), n)); }
TESSERA_INLINE Int shift_right_logical(Int a, int n) { return make_int(native::shift_right_logical(a.raw(), n)); }
// The low and the high sixteen bits of each lane as signed numbers, times 2^n; 0 <= n <= 14. On x86 one multiplication
// each, where a shift and a mask would be two instructions.
template <int n>
TESSERA_INLINE Int low_half_shifted(Int a) {
  return make_int(native::low_half_shifted<n>(a.raw()));
}
template <int n>
TESSERA_INLINE Int high_half_shifted(Int a) {
  return make_int(native::high_half_shifted<n>(a.raw()));
}
// Lane by lane the sum of two products: the low sixteen bits', and the high ones', all as signed numbers. The sum fits
// unless all four are -2^15.
TESSERA_INLINE Int dot_halves(Int a, Int b) { return make_int(native::dot_halves(a.raw(), b.raw())); }
TESSERA_INLINE Int& operator+=(Int& a, Int b) { return a = a + b; }
TESSERA_INLINE Int& operator-=(Int& a, Int b) { return a = a - b; }
TESSERA_INLINE Int& operator*=(Int& a, Int b) { return a = a * b; }
TESSERA_INLINE Int& operator&=(Int& a, Int b) { return a = a & b; }
TESSERA_INLINE Int& operator|=(Int& a, Int b) { return a = a | b; }
TESSERA_INLINE Int& operator^=(Int& a, Int b) { return a = a ^ b; }

TESSERA_INLINE Mask operator==(Int a, Int b) { return make_mask(a.batch == b.batch); }
TESSERA_INLINE Mask operator!=(Int a, Int b) { return !(a == b); }
TESSERA_INLINE Mask operator<(Int a, Int b) { return make_mask(a.batch < b.batch); }
TESSERA_INLINE Mask operator>(Int a, Int b) { return make_mask(b.batch < a.batch); }
TESSERA_INLINE Mask operator<=(Int a, Int b) { return !(b < a); }
TESSERA_INLINE Mask operator>=(Int a, Int b) { return !(a < b); }

TESSERA_INLINE Int min(Int a, Int b) { return make_int(native::min(a.raw(), b.raw())); }
TESSERA_INLINE Int max(Int a, Int b) { return make_int(native::max(a.raw(), b.raw())); }
TESSERA_INLINE Int clamp(Int x, Int low, Int high) { return min(max(x, low), high); }

// ----------------------------------------------------------------------------------------------------------- float

TESSERA_INLINE Int bits(Float x) { return make_int(native::bits(x.raw())); }
TESSERA_INLINE Float from_bits(Int x) { return make_float(native::from_bits(x.raw())); }

TESSERA_INLINE Float operator+(Float a, Float b) { return Float(a.batch + b.batch); }
TESSERA_INLINE Float operator-(Float a, Float b) { return Float(a.batch - b.batch); }
TESSERA_INLINE Float operator*(Float a, Float b) { return Float(a.batch * b.batch); }
TESSERA_INLINE Float operator/(Float a, Float b) { return make_float(native::divide(a.raw(), b.raw())); }
TESSERA_INLINE Float operator-(Float a) { return from_bits(bits(a) ^ Int(0x80000000u)); }
TESSERA_INLINE Float& operator+=(Float& a, Float b) { return a = a + b; }
TESSERA_INLINE Float& operator-=(Float& a, Float b) { return a = a - b; }
TESSERA_INLINE Float& operator*=(Float& a, Float b) { return a = a * b; }
TESSERA_INLINE Float& operator/=(Float& a, Float b) { return a = a / b; }

// As in C: all false for NaN, but != true.
TESSERA_INLINE Mask operator==(Float a, Float b) { return Mask(a.batch == b.batch); }
TESSERA_INLINE Mask operator!=(Float a, Float b) { return make_mask(native::not_equal(a.raw(), b.raw())); }
TESSERA_INLINE Mask operator<(Float a, Float b) { return Mask(a.batch < b.batch); }
TESSERA_INLINE Mask operator<=(Float a, Float b) { return Mask(a.batch <= b.batch); }
TESSERA_INLINE Mask operator>(Float a, Float b) { return Mask(b.batch < a.batch); }
TESSERA_INLINE Mask operator>=(Float a, Float b) { return Mask(b.batch <= a.batch); }

TESSERA_INLINE Float mul_add(Float a, Float b, Float c) {
  return make_float(native::mul_add(a.raw(), b.raw(), c.raw()));
}
TESSERA_INLINE Float mul_sub(Float a, Float b, Float c) {
  return make_float(native::mul_sub(a.raw(), b.raw(), c.raw()));
}
TESSERA_INLINE Float neg_mul_add(Float a, Float b, Float c) {
  return make_float(native::neg_mul_add(a.raw(), b.raw(), c.raw()));
}
TESSERA_INLINE Float sqrt(Float x) { return make_float(native::sqrt(x.raw())); }
TESSERA_INLINE Float floor(Float x) { return make_float(native::floor(x.raw())); }
TESSERA_INLINE Float min(Float a, Float b) { return make_float(native::min(a.raw(), b.raw())); }
TESSERA_INLINE Float max(Float a, Float b) { return make_float(native::max(a.raw(), b.raw())); }
TESSERA_INLINE Float abs(Float x) { return from_bits(bits(x) & Int(0x7fffffff)); }
TESSERA_INLINE Float copy_sign(Float magnitude, Float sign) {
  return from_bits((bits(magnitude) & Int(0x7fffffff)) | (bits(sign) & Int(0x80000000u)));
}
TESSERA_INLINE Mask is_nan(Float x) { return x != x; }

TESSERA_INLINE Float select(Mask m, Float a, Float b) { return Float(xsimd::select(m.batch, a.batch, b.batch)); }
TESSERA_INLINE Int select(Mask m, Int a, Int b) { return bits(select(m, from_bits(a), from_bits(b))); }

TESSERA_INLINE Int truncate_to_int(Float x) { return make_int(native::truncate_to_int(x.raw())); }
TESSERA_INLINE Int round_to_int(Float x) { return make_int(native::round_to_int(x.raw())); }
TESSERA_INLINE Float to_float(Int x) { return make_float(native::to_float(x.raw())); }
TESSERA_INLINE Float half_to_float(Int x) { return make_float(native::half_to_float(x.raw())); }
TESSERA_INLINE Int float_to_half(Float x) { return make_int(native::float_to_half(x.raw())); }

// ---------------------------------------------------------------------------------------------------------- memory

template <>
TESSERA_INLINE Float load<Float>(const float* p) {
  return Float(Float::Batch::load_unaligned(p));
}
template <>
TESSERA_INLINE Int load_int<Int>(const std::int32_t* p) {
  return Int(Int::Batch::load_unaligned(p));
}
template <>
TESSERA_INLINE Float load_half<Float>(const std::uint16_t* p) {
  return make_float(native::load_half(p));
}
TESSERA_INLINE void store(float* p, Float x) { x.batch.store_unaligned(p); }
TESSERA_INLINE void store(std::int32_t* p, Int x) { x.batch.store_unaligned(p); }
TESSERA_INLINE void store_half(std::uint16_t* p, Float x) { native::store_half(p, x.raw()); }

// Only lanes in the mask are written.
TESSERA_INLINE void store_masked(float* p, Float x, Mask m) { native::store_masked(p, x.raw(), m.raw()); }
TESSERA_INLINE void store_masked(std::int32_t* p, Int x, Mask m) { native::store_masked(p, x.raw(), m.raw()); }

// Asks for the cache line at p, into the second-level cache: there it does not push out what is in use. p may be any
// address.
TESSERA_INLINE void prefetch(const float* p) { __builtin_prefetch(p, 0, 2); }

// The lanes in the mask, one after another from lane 0 on; what is behind them may be anything.
TESSERA_INLINE Float compress(Float x, Mask m) { return make_float(native::compress(x.raw(), m.raw())); }
// Writes the lanes in the mask one after another, nothing beyond them, and says how many.
TESSERA_INLINE int compress_store(std::int32_t* out, Int x, Mask m) {
  return native::compress_store(out, x.raw(), m.raw());
}

// p[index] per lane; with a mask, inactive lanes are 0 and their memory is not touched.
TESSERA_INLINE Float gather(const float* p, Int index) { return make_float(native::gather<4>(p, index.raw())); }
TESSERA_INLINE Int gather(const std::int32_t* p, Int index) {
  return bits(make_float(native::gather<4>(p, index.raw())));
}
TESSERA_INLINE Float gather(const float* p, Int index, Mask active) {
  return make_float(native::gather<4>(p, index.raw(), active.raw()));
}
TESSERA_INLINE Int gather(const std::int32_t* p, Int index, Mask active) {
  return bits(make_float(native::gather<4>(p, index.raw(), active.raw())));
}
// The 32 bits at base + byte_offset (signed, any alignment).
TESSERA_INLINE Int gather_bytes(const void* base, Int byte_offset) {
  return bits(make_float(native::gather<1>(base, byte_offset.raw())));
}
TESSERA_INLINE Int gather_bytes(const void* base, Int byte_offset, Mask active) {
  return bits(make_float(native::gather<1>(base, byte_offset.raw(), active.raw())));
}

// The 64 bits there, as two numbers: half as many loads as two gathers.
struct IntPair {
  Int low, high;
};
TESSERA_INLINE IntPair gather_pairs(const void* base, Int byte_offset) {
  native::IntRegister low, high;
  native::gather_pairs(base, byte_offset.raw(), low, high);
  return {make_int(low), make_int(high)};
}

// Records, one per lane -> one vector per word. A lane's record starts at base[word], word signed, and has as many
// floats as `out` (a multiple of four), or three. Wide loads and shuffles cost a third of what gathers do.
template <int words>
TESSERA_INLINE void gather_quads(const float* base, Int word, Float (&out)[words]) {
  static_assert(words % 4 == 0);
  native::FloatRegister r[words];
  native::gather_quads<words / 4>(base, word.raw(), r);
  for (int i = 0; i < words; ++i) out[i] = make_float(r[i]);
}
// Four words of each record, from a multiple of two words on. The lanes' multiples are in memory.
TESSERA_INLINE void gather_quads(const float* base, const std::int32_t* pair, Float (&out)[4]) {
  native::FloatRegister r[4];
  native::gather_quads<1>(base, pair, 0, r);
  for (int i = 0; i < 4; ++i) out[i] = make_float(r[i]);
}
// And the four that lie `stride` words behind those.
TESSERA_INLINE void gather_quads(const float* base, const std::int32_t* pair, std::ptrdiff_t stride, Float (&first)[4],
                                 Float (&second)[4]) {
  native::FloatRegister r[8];
  native::gather_quads<2>(base, pair, stride, r);
  for (int i = 0; i < 4; ++i) {
    first[i] = make_float(r[i]);
    second[i] = make_float(r[4 + i]);
  }
}
TESSERA_INLINE void gather_triples(const float* base, Int word, Float (&out)[3]) {
  native::FloatRegister r[4];
  native::gather_triples(base, word.raw(), r);
  for (int i = 0; i < 3; ++i) out[i] = make_float(r[i]);
}

// The different values among the lanes, in order of first appearance, if they are few.
struct DistinctLanes {
  int count;                                    // more than most_distinct: too many, and the rest means nothing
  alignas(64) std::int32_t values[Int::lanes];  // at least most_distinct, zeros after the last
  Int place4;                                   // four times each lane's place among the values
};
inline constexpr int most_distinct = native::most_distinct;
TESSERA_INLINE void find_distinct(Int x, DistinctLanes& out) {
  native::IntRegister place;
  out.count = native::distinct(x.raw(), out.values, place);
  out.place4 = make_int(place) << 2;
}
// gather_quads() and gather_triples() of lanes that share few records: `registers` (1 or 2) * records_per_register of
// them, each read once. place4: as in DistinctLanes.
inline constexpr int records_per_register = native::records_per_register;
template <int registers, int words>
TESSERA_INLINE void spread_records(const float* const* record, Int place4, Float (&out)[words]) {
  static_assert(words == 3 || words % 4 == 0);
  const auto load = [](const float* p) { return words == 3 ? native::load_triple(p) : native::load_quad(p); };
  for (int first = 0; first < words; first += 4) {
    const float* from[registers * records_per_register];
    for (int n = 0; n < registers * records_per_register; ++n) from[n] = record[n] + first;
    native::FloatRegister r[4];
    if constexpr (registers == 1)
      native::spread_one(from, place4.raw(), load, r);
    else
      native::spread_two(from, place4.raw(), load, r);
    for (int i = first; i < words && i < first + 4; ++i) out[i] = make_float(r[i - first]);
  }
}
// Of consecutive records.
TESSERA_INLINE void load_quads(const float* p, Float (&out)[4]) {
  native::FloatRegister r[4];
  native::load_quads(p, r);
  for (int i = 0; i < 4; ++i) out[i] = make_float(r[i]);
}
// Four lanes' records to p, four to p + row_stride, and so on.
TESSERA_INLINE void store_quads(float* p, std::size_t row_stride, const Float (&in)[4]) {
  const native::FloatRegister r[4] = {in[0].raw(), in[1].raw(), in[2].raw(), in[3].raw()};
  native::store_quads(p, row_stride, r);
}
TESSERA_INLINE void store_quads(float* p, const Float (&in)[4]) { store_quads(p, 16, in); }
// Lane i's record to p + stride * i.
TESSERA_INLINE void scatter_quads(float* p, int stride, const Float (&in)[4]) {
  const native::FloatRegister r[4] = {in[0].raw(), in[1].raw(), in[2].raw(), in[3].raw()};
  native::scatter_quads(p, stride, r);
}
// Past the caches, where the machine can; p and rows on multiples of 64 bytes. Other threads see it only after
// end_streaming() of src/base.
TESSERA_INLINE void stream_quads(float* p, std::size_t row_stride, const Float (&in)[4]) {
  const native::FloatRegister r[4] = {in[0].raw(), in[1].raw(), in[2].raw(), in[3].raw()};
  native::stream_quads(p, row_stride, r);
}
TESSERA_INLINE IntPair load_pairs(const void* p) {
  native::IntRegister low, high;
  native::load_pairs(static_cast<const std::int32_t*>(p), low, high);
  return {make_int(low), make_int(high)};
}

// And back.
TESSERA_INLINE void store_pairs(void* p, Int low, Int high) {
  native::store_pairs(static_cast<std::int32_t*>(p), low.raw(), high.raw());
}

// ----------------------------------------------------------------------------------------------------------- lanes

alignas(64) constexpr std::int32_t lane_numbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

TESSERA_INLINE Int lane_index() { return load_int<Int>(lane_numbers); }
// Lanes 0 to n - 1; n may be anything.
TESSERA_INLINE Mask first_lanes(int n) { return lane_index() < Int(n); }

TESSERA_INLINE float lane(Float x, int i) {
  float lanes[Float::lanes];
  store(lanes, x);
  return lanes[i];
}
TESSERA_INLINE std::int32_t lane(Int x, int i) {
  std::int32_t lanes[Int::lanes];
  store(lanes, x);
  return lanes[i];
}
TESSERA_INLINE bool lane(Mask m, int i) { return to_bits(m) >> i & 1; }

// --------------------------------------------------------------------------------------------- for any number type

// x between low and high; NaN -> low.
template <class F>
TESSERA_INLINE F clamp(F x, F low, F high) {
  return min(max(x, low), high);
}
// x between 0 and 1; NaN -> 0.
template <class F>
TESSERA_INLINE F saturate(F x) {
  return clamp(x, F(0), F(1));
}
// ab - cd within 1.5 ulp, no cancellation. Kahan; Jeannerod, Louvet and Muller 2013, "Further analysis of Kahan's
// algorithm for the accurate computation of 2x2 determinants".
template <class F>
TESSERA_INLINE F difference_of_products(F a, F b, F c, F d) {
  const F cd = c * d;
  const F error = neg_mul_add(c, d, cd);
  const F difference = mul_sub(a, b, cd);
  return difference + error;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

#include "kernels/isa/vocabulary.hpp"

#include <algorithm>

#include "kernels/simd.hpp"

#define TESSERA_TEXT2(x) #x
#define TESSERA_TEXT(x) TESSERA_TEXT2(x)

namespace tessera::TESSERA_ISA {
namespace {

inline Float as_float(Int x) { return from_bits(x); }
inline float as_float(std::int32_t x) { return from_bits(x); }
inline Int as_bits(Float x) { return bits(x); }
inline std::int32_t as_bits(float x) { return bits(x); }
inline Int as_bits(Int x) { return x; }
inline std::int32_t as_bits(std::int32_t x) { return x; }
inline Int as_bits(Mask m) { return select(m, Int(-1), Int(0)); }
inline std::int32_t as_bits(bool m) { return m ? -1 : 0; }
inline std::int32_t float_to_half(float) { return 0; }  // of scalars, kernels need none

// x, y, z: the operands as numbers; i, j, k: as integers; p, q: as masks.
template <class F, class Function>
inline void for_each(const OperationArgs& args, Function function) {
  using I = IntOf<F>;
  constexpr std::size_t step = sizeof(I) / sizeof(std::int32_t);
  const auto* a = reinterpret_cast<const std::int32_t*>(args.a);
  const auto* b = reinterpret_cast<const std::int32_t*>(args.b);
  const auto* c = reinterpret_cast<const std::int32_t*>(args.c);
  auto* out = reinterpret_cast<std::int32_t*>(args.out);
  for (std::size_t n = 0; n < args.count; n += step)
    store(out + n, as_bits(function(load_int<I>(a + n), load_int<I>(b + n), load_int<I>(c + n))));
}

template <class F>
void apply(const OperationArgs& args) {
  using I = IntOf<F>;
  using M = MaskOf<F>;
  const auto floats = [&](auto f) {
    for_each<F>(args, [&](I i, I j, I k) { return f(as_float(i), as_float(j), as_float(k)); });
  };
  const auto ints = [&](auto f) { for_each<F>(args, [&](I i, I j, I) { return f(i, j); }); };
  const auto masks = [&](auto f) { for_each<F>(args, [&](I i, I j, I) { return f(M(i < I(0)), M(j < I(0))); }); };
  const int shift = static_cast<int>(args.b[0] & 31);
  switch (args.operation) {
    case Operation::add:
      return floats([](F x, F y, F) { return x + y; });
    case Operation::subtract:
      return floats([](F x, F y, F) { return x - y; });
    case Operation::multiply:
      return floats([](F x, F y, F) { return x * y; });
    case Operation::divide:
      return floats([](F x, F y, F) { return x / y; });
    case Operation::mul_add:
      return floats([](F x, F y, F z) { return mul_add(x, y, z); });
    case Operation::mul_sub:
      return floats([](F x, F y, F z) { return mul_sub(x, y, z); });
    case Operation::neg_mul_add:
      return floats([](F x, F y, F z) { return neg_mul_add(x, y, z); });
    case Operation::sqrt:
      return floats([](F x, F, F) { return sqrt(x); });
    case Operation::abs:
      return floats([](F x, F, F) { return abs(x); });
    case Operation::negate:
      return floats([](F x, F, F) { return -x; });
    case Operation::floor:
      return floats([](F x, F, F) { return floor(x); });
    case Operation::min:
      return floats([](F x, F y, F) { return min(x, y); });
    case Operation::max:
      return floats([](F x, F y, F) { return max(x, y); });
    case Operation::clamp:
      return floats([](F x, F y, F z) { return clamp(x, y, z); });
    case Operation::saturate:
      return floats([](F x, F, F) { return saturate(x); });
    case Operation::copy_sign:
      return floats([](F x, F y, F) { return copy_sign(x, y); });
    case Operation::difference_of_products:
      return floats([](F x, F y, F z) { return difference_of_products(x, y, z, x); });
    case Operation::less:
      return floats([](F x, F y, F) { return x < y; });
    case Operation::less_equal:
      return floats([](F x, F y, F) { return x <= y; });
    case Operation::greater:
      return floats([](F x, F y, F) { return x > y; });
    case Operation::greater_equal:
      return floats([](F x, F y, F) { return x >= y; });
    case Operation::equal:
      return floats([](F x, F y, F) { return x == y; });
    case Operation::not_equal:
      return floats([](F x, F y, F) { return x != y; });
    case Operation::is_nan:
      return floats([](F x, F, F) { return is_nan(x); });
    case Operation::select:
      return floats([](F x, F y, F z) { return select(x < y, y, z); });
    case Operation::truncate_to_int:
      return floats([](F x, F, F) { return truncate_to_int(x); });
    case Operation::round_to_int:
      return floats([](F x, F, F) { return round_to_int(x); });
    case Operation::to_float:
      return ints([](I i, I) { return to_float(i); });
    case Operation::half_to_float:
      return ints([](I i, I) { return half_to_float(i); });
    case Operation::float_to_half:
      return floats([](F x, F, F) { return float_to_half(x); });
    case Operation::int_add:
      return ints([](I i, I j) { return i + j; });
    case Operation::int_subtract:
      return ints([](I i, I j) { return i - j; });
    case Operation::int_multiply:
      return ints([](I i, I j) { return i * j; });
    case Operation::int_negate:
      return ints([](I i, I) { return -i; });
    case Operation::int_and:
      return ints([](I i, I j) { return i & j; });
    case Operation::int_or:
      return ints([](I i, I j) { return i | j; });
    case Operation::int_xor:
      return ints([](I i, I j) { return i ^ j; });
    case Operation::int_not:
      return ints([](I i, I) { return ~i; });
    case Operation::shift_left:
      return ints([=](I i, I) { return i << shift; });
    case Operation::shift_right:
      return ints([=](I i, I) { return i >> shift; });
    case Operation::shift_right_logical:
      return ints([=](I i, I) { return shift_right_logical(i, shift); });
    case Operation::low_half_shifted:
      return ints([](I i, I) { return low_half_shifted<13>(i) ^ low_half_shifted<0>(i); });
    case Operation::high_half_shifted:
      return ints([](I i, I) { return high_half_shifted<13>(i) ^ high_half_shifted<14>(i); });
    case Operation::dot_halves:
      return ints([](I i, I j) { return dot_halves(i, j); });
    case Operation::int_min:
      return ints([](I i, I j) { return min(i, j); });
    case Operation::int_max:
      return ints([](I i, I j) { return max(i, j); });
    case Operation::int_less:
      return ints([](I i, I j) { return i < j; });
    case Operation::int_less_equal:
      return ints([](I i, I j) { return i <= j; });
    case Operation::int_greater:
      return ints([](I i, I j) { return i > j; });
    case Operation::int_greater_equal:
      return ints([](I i, I j) { return i >= j; });
    case Operation::int_equal:
      return ints([](I i, I j) { return i == j; });
    case Operation::int_not_equal:
      return ints([](I i, I j) { return i != j; });
    case Operation::int_select:
      return ints([](I i, I j) { return select(i < j, i, j); });
    case Operation::mask_and:
      return masks([](M p, M q) { return M(p & q); });
    case Operation::mask_or:
      return masks([](M p, M q) { return M(p | q); });
    case Operation::mask_xor:
      return masks([](M p, M q) { return M(p ^ q); });
    case Operation::mask_not:
      return masks([](M p, M) { return !p; });
  }
}

template <int words>
void gather_words(const float* base, const std::int32_t* word, float* out) {
  Float v[words];
  gather_quads(base, load_int(word), v);
  for (int i = 0; i < words; ++i) store(out + i * Float::lanes, v[i]);
}

template <int registers, int words>
void spread_words(const float* const* record, Int place4, float* out) {
  Float v[words];
  spread_records<registers>(record, place4, v);
  for (int i = 0; i < words; ++i) store(out + i * Float::lanes, v[i]);
}

Float load_word(const float* in, int word) { return load<Float>(in + word * Float::lanes); }

}  // namespace

extern const VocabularyTable vocabulary;
const VocabularyTable vocabulary = {
    TESSERA_TEXT(TESSERA_ISA),
    Float::lanes,
    apply<Float>,
    apply<float>,
    [](const float* table, const std::int32_t* index, float* out) { store(out, gather(table, load_int(index))); },
    [](const std::int32_t* table, const std::int32_t* index, std::int32_t* out) {
      store(out, gather(table, load_int(index)));
    },
    [](const float* table, const std::int32_t* index, std::uint32_t mask, float* out) {
      store(out, gather(table, load_int(index), from_mask_bits(mask)));
    },
    [](const std::int32_t* table, const std::int32_t* index, std::uint32_t mask, std::int32_t* out) {
      store(out, gather(table, load_int(index), from_mask_bits(mask)));
    },
    [](const void* base, const std::int32_t* offset, std::int32_t* out) {
      store(out, gather_bytes(base, load_int(offset)));
    },
    [](const void* base, const std::int32_t* offset, std::uint32_t mask, std::int32_t* out) {
      store(out, gather_bytes(base, load_int(offset), from_mask_bits(mask)));
    },
    [](const void* base, const std::int32_t* offset, std::int32_t* low, std::int32_t* high) {
      const IntPair pair = gather_pairs(base, load_int(offset));
      store(low, pair.low);
      store(high, pair.high);
    },
    [](const float* in, std::uint32_t mask, float* out) { store_masked(out, load<Float>(in), from_mask_bits(mask)); },
    [](const std::int32_t* in, std::uint32_t mask, std::int32_t* out) {
      store_masked(out, load_int(in), from_mask_bits(mask));
    },
    [](const float* base, const std::int32_t* word, float* out) { gather_words<4>(base, word, out); },
    [](const float* base, const std::int32_t* word, float* out) { gather_words<12>(base, word, out); },
    [](const float* base, const std::int32_t* word, float* out) {
      Float v[3];
      gather_triples(base, load_int(word), v);
      for (int i = 0; i < 3; ++i) store(out + i * Float::lanes, v[i]);
    },
    [](const float* in, float* out) {
      Float v[4];
      load_quads(in, v);
      for (int i = 0; i < 4; ++i) store(out + i * Float::lanes, v[i]);
    },
    [](const float* in, std::size_t row_stride, float* out) {
      store_quads(out, row_stride, {load_word(in, 0), load_word(in, 1), load_word(in, 2), load_word(in, 3)});
    },
    [](const float* in, std::size_t row_stride, float* out) {
      stream_quads(out, row_stride, {load_word(in, 0), load_word(in, 1), load_word(in, 2), load_word(in, 3)});
    },
    [](const float* in, int stride, float* out) {
      scatter_quads(out, stride, {load_word(in, 0), load_word(in, 1), load_word(in, 2), load_word(in, 3)});
    },
    [](const void* in, std::int32_t* low, std::int32_t* high) {
      const IntPair pair = load_pairs(in);
      store(low, pair.low);
      store(high, pair.high);
    },
    [](const std::int32_t* low, const std::int32_t* high, void* out) {
      store_pairs(out, load_int(low), load_int(high));
    },
    [](const std::int32_t* in, std::int32_t* values, std::int32_t* place4) {
      DistinctLanes distinct;
      find_distinct(load_int(in), distinct);
      std::copy_n(distinct.values, Int::lanes, values);
      store(place4, distinct.place4);
      return distinct.count;
    },
    most_distinct,
    records_per_register,
    [](int registers, int words, const float* const* record, const std::int32_t* place4, float* out) {
      const auto spread = registers == 1 ? words == 3 ? spread_words<1, 3> : spread_words<1, 12>
                          : words == 3 ? spread_words<2, 3>
                                         : spread_words<2, 12>;
      spread(record, load_int(place4), out);
    },
    [](const float* in, std::uint32_t mask, float* out) {
      store(out, compress(load<Float>(in), from_mask_bits(mask)));
    },
    [](const std::int32_t* in, std::uint32_t mask, std::int32_t* out) {
      return compress_store(out, load_int(in), from_mask_bits(mask));
    },
    [](std::uint32_t mask) { return to_bits(from_mask_bits(mask)); },
    [](std::uint32_t mask) {
      const Mask m = from_mask_bits(mask);
      return std::uint32_t{any(m)} | std::uint32_t{all(m)} << 1 | std::uint32_t{none(m)} << 2;
    },
    [](int n) { return to_bits(first_lanes(n)); },
    [](std::int32_t* out) { store(out, lane_index()); },
    [](const float* in, float* out) {
      for (int i = 0; i < Float::lanes; ++i) out[i] = lane(load<Float>(in), i);
    },
    [](const std::uint16_t* in, float* wide, std::uint16_t* out) {
      store(wide, load_half(in));
      store_half(out, load<Float>(wide));
    },
};

}  // namespace tessera::TESSERA_ISA

// The arithmetic of kernels/simd.hpp, and lanes and masks, on every instruction set and for plain float, against the
// C++ standard's scalar operation on millions of bit patterns: all lanes, subnormals, infinities, NaN and cancellation
// included.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "kernels/isa/runnable_vocabularies.hpp"

namespace tessera {

namespace {

using Bits = std::uint32_t;

Bits to_bits(float x) { return std::bit_cast<Bits>(x); }
float to_float(Bits x) { return std::bit_cast<float>(x); }
Bits mask(bool m) { return m ? ~Bits{0} : 0; }

// Rounds to nearest even by the definition, through an integer multiple of the half's last place.
Bits half_truth(float x) {
  const Bits sign = to_bits(x) >> 16 & 0x8000;
  if (std::isnan(x)) return sign | 0x7e00 | (to_bits(x) >> 13 & 0x1ff);
  const float a = std::fabs(x);
  if (a >= 65520) return sign | 0x7c00;
  const int exponent = a < 0x1p-14f ? -14 : std::ilogb(a);
  const double steps = std::nearbyint(std::ldexp(double{a}, 10 - exponent));
  return sign | static_cast<Bits>(steps + 1024 * (exponent + 14));  // a carry runs into the exponent
}

float half_value(Bits half) {
  const int exponent = half >> 10 & 31, fraction = half & 1023;
  float magnitude =
      exponent == 0 ? std::ldexp(float(fraction), -24) : std::ldexp(float(fraction + 1024), exponent - 25);
  if (exponent == 31)
    magnitude = fraction ? to_float(0x7fc00000 | fraction << 13) : std::numeric_limits<float>::infinity();
  return std::copysign(magnitude, half & 0x8000 ? -1.0f : 1.0f);
}

using Truth = Bits (*)(float x, float y, float z, int i, int j, int shift);
struct Row {
  Operation operation;
  const char* name;
  bool is_float;  // the result; NaNs compare equal
  Truth truth;
};

#define FLOATS(name, expression)                                                 \
  {                                                                              \
    Operation::name, #name, true, [](float x, float y, float z, int, int, int) { \
      (void)x, (void)y, (void)z;                                                 \
      return to_bits(expression);                                                \
    }                                                                            \
  }
#define TESTS(name, expression)                                                 \
  {                                                                             \
    Operation::name, #name, false, [](float x, float y, float, int, int, int) { \
      (void)y;                                                                  \
      return mask(expression);                                                  \
    }                                                                           \
  }
#define INTS(name, expression)                                                        \
  {                                                                                   \
    Operation::name, #name, false, [](float, float, float, int i, int j, int shift) { \
      (void)j, (void)shift;                                                           \
      return static_cast<Bits>(expression);                                           \
    }                                                                                 \
  }
const Row rows[] = {
    FLOATS(add, x + y),
    FLOATS(subtract, x - y),
    FLOATS(multiply, x* y),
    FLOATS(divide, x / y),
    FLOATS(mul_add, std::fma(x, y, z)),
    FLOATS(mul_sub, std::fma(x, y, -z)),
    FLOATS(neg_mul_add, std::fma(-x, y, z)),
    FLOATS(sqrt, std::sqrt(x)),
    FLOATS(abs, std::fabs(x)),
    FLOATS(negate, -x),
    FLOATS(floor, std::floor(x)),
    FLOATS(min, x < y ? x : y),
    FLOATS(max, x > y ? x : y),
    FLOATS(clamp, (x > y ? x : y) < z ? (x > y ? x : y) : z),
    FLOATS(saturate, std::isnan(x) || x <= 0 ? 0.0f
                     : x >= 1                ? 1.0f
                                             : x),
    FLOATS(copy_sign, std::copysign(x, y)),
    FLOATS(select, x < y ? y : z),
    TESTS(less, x < y),
    TESTS(less_equal, x <= y),
    TESTS(greater, x > y),
    TESTS(greater_equal, x >= y),
    TESTS(equal, x == y),
    TESTS(not_equal, x != y),
    TESTS(is_nan, std::isnan(x)),
    {Operation::to_float, "to_float", true,
     [](float, float, float, int i, int, int) { return to_bits(static_cast<float>(i)); }},
    INTS(int_add, Bits(i) + Bits(j)),
    INTS(int_subtract, Bits(i) - Bits(j)),
    INTS(int_multiply, Bits(i) * Bits(j)),
    INTS(int_negate, -Bits(i)),
    INTS(int_and, i& j),
    INTS(int_or, i | j),
    INTS(int_xor, i ^ j),
    INTS(int_not, ~i),
    INTS(shift_left, Bits(i) << shift),
    INTS(shift_right, std::int64_t{i} >> shift),
    INTS(shift_right_logical, Bits(i) >> shift),
    INTS(low_half_shifted, (std::int16_t(i) * 8192) ^ std::int16_t(i)),
    INTS(high_half_shifted, (std::int16_t(i >> 16) * 8192) ^ (std::int16_t(i >> 16) * 16384)),
    INTS(dot_halves, std::int64_t{std::int16_t(i)} * std::int16_t(j) + std::int64_t{i >> 16} * (j >> 16)),
    INTS(int_min, std::min(i, j)),
    INTS(int_max, std::max(i, j)),
    INTS(int_less, mask(i < j)),
    INTS(int_less_equal, mask(i <= j)),
    INTS(int_greater, mask(i > j)),
    INTS(int_greater_equal, mask(i >= j)),
    INTS(int_equal, mask(i == j)),
    INTS(int_not_equal, mask(i != j)),
    INTS(int_select, i < j ? i : j),
    INTS(mask_and, mask(i < 0 && j < 0)),
    INTS(mask_or, mask(i < 0 || j < 0)),
    INTS(mask_xor, mask((i < 0) != (j < 0))),
    INTS(mask_not, mask(i >= 0)),
};

struct Operands {
  std::vector<Bits> a, b, c;
  explicit Operands(std::size_t count) : a(count), b(count), c(count) {}
};

// A third any bit pattern, a third special values, a third of ordinary size where c is close to -ab.
Operands random_operands(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  const Bits special[] = {0,          1,          2,          0x7fffff,   0x800000,   0x800001,   0x3f800000,
                          0x3f7fffff, 0x3f800001, 0x34000000, 0x4b000000, 0x4b7fffff, 0x3f000000, 0x3effffff,
                          0x7f7fffff, 0x7f800000, 0x7fc00000, 0x5f000000, 0x1f800000, 0x40490fdb};
  const auto any = [&] { return Bits(random()); };
  const auto some_special = [&] { return special[random() % std::size(special)] ^ (random() & 0x80000000u); };
  const auto ordinary = [&] { return ((100 + random() % 56) << 23 | (random() & 0x807fffff)); };
  Operands o(count);
  for (std::size_t n = 0; n < count; ++n) {
    switch (random() % 3) {
      case 0:
        o.a[n] = any(), o.b[n] = any(), o.c[n] = any();
        break;
      case 1:
        o.a[n] = some_special(), o.b[n] = some_special(), o.c[n] = some_special();
        break;
      default:
        o.a[n] = ordinary(), o.b[n] = random() % 8 ? ordinary() : o.a[n];
        o.c[n] = to_bits(-(to_float(o.a[n]) * to_float(o.b[n]))) + random() % 3;
    }
  }
  return o;
}

bool same(Bits x, Bits y, bool is_float) {
  return x == y || (is_float && std::isnan(to_float(x)) && std::isnan(to_float(y)));
}

struct Simd : testing::TestWithParam<const VocabularyTable*> {
  // out of `operation` on the operands, through vectors or through scalars
  std::vector<Bits> run(Operation operation, const Operands& o, bool scalar) {
    std::vector<Bits> out(o.a.size());
    const OperationArgs args{operation, o.a.data(), o.b.data(), o.c.data(), out.data(), out.size()};
    scalar ? GetParam()->apply_scalar(args) : GetParam()->apply(args);
    return out;
  }
};

TEST_P(Simd, OperationsAreThoseOfTheScalarStandard) {
  for (const Row& row : rows) {
    const bool arithmetic = row.operation <= Operation::sqrt;
    const Operands o = random_operands(arithmetic ? 1 << 20 : 1 << 16, 1 + static_cast<unsigned>(row.operation));
    const int shift = static_cast<int>(o.b[0] & 31);
    const bool may_overflow = row.operation >= Operation::int_add && row.operation <= Operation::int_negate;
    for (const bool scalar : {false, true}) {
      if (scalar && may_overflow) continue;  // lanes wrap; int32_t must not overflow
      const std::vector<Bits> out = run(row.operation, o, scalar);
      std::size_t wrong = 0;
      for (std::size_t n = 0; n < out.size(); ++n) {
        const Bits expected = row.truth(to_float(o.a[n]), to_float(o.b[n]), to_float(o.c[n]), static_cast<int>(o.a[n]),
                                        static_cast<int>(o.b[n]), shift);
        if (!same(out[n], expected, row.is_float) && wrong++ == 0)
          ADD_FAILURE() << row.name << (scalar ? " (scalar)" : "") << std::hex << " of " << o.a[n] << ", " << o.b[n]
                        << ", " << o.c[n] << " is " << out[n] << ", not " << expected;
      }
      EXPECT_EQ(wrong, 0u) << row.name;
    }
  }
}

TEST_P(Simd, ShiftsByEveryCount) {
  Operands o = random_operands(64, 7);
  for (unsigned shift = 0; shift < 32; ++shift) {
    o.b[0] = shift;
    const auto left = run(Operation::shift_left, o, false), right = run(Operation::shift_right, o, false),
               logical = run(Operation::shift_right_logical, o, false);
    for (std::size_t n = 0; n < o.a.size(); ++n) {
      EXPECT_EQ(left[n], o.a[n] << shift);
      EXPECT_EQ(static_cast<int>(right[n]), static_cast<int>(o.a[n]) >> shift);
      EXPECT_EQ(logical[n], o.a[n] >> shift);
    }
  }
}

TEST_P(Simd, ConversionsToIntegers) {
  Operands o = random_operands(1 << 18, 11);
  std::mt19937 random(12);
  for (std::size_t n = 0; n < o.a.size(); ++n) {
    // Ties, and anything whose integer fits.
    if (n % 4 == 0) o.a[n] = to_bits(static_cast<float>(static_cast<int>(random() % 4001) - 2000) / 2);
    if (!(std::fabs(to_float(o.a[n])) < 0x1p31f)) o.a[n] = 0xcf000000;  // -2^31
  }
  for (const bool scalar : {false, true}) {
    const auto truncated = run(Operation::truncate_to_int, o, scalar),
               rounded = run(Operation::round_to_int, o, scalar);
    for (std::size_t n = 0; n < o.a.size(); ++n) {
      const double x = to_float(o.a[n]);
      ASSERT_EQ(static_cast<int>(truncated[n]), static_cast<int>(std::trunc(x))) << x;
      ASSERT_EQ(static_cast<int>(rounded[n]), static_cast<int>(std::nearbyint(x))) << x;  // default mode: ties to even
    }
  }
}

TEST_P(Simd, HalvesToFloatsAllOfThem) {
  Operands o(65536);
  for (Bits half = 0; half < 65536; ++half) o.a[half] = half;
  const auto wide = run(Operation::half_to_float, o, false), scalar = run(Operation::half_to_float, o, true);
  for (Bits half = 0; half < 65536; ++half) {
    ASSERT_EQ(wide[half], to_bits(half_value(half))) << half;
    ASSERT_EQ(scalar[half], to_bits(half_value(half))) << half;
  }
}

TEST_P(Simd, FloatsToHalvesAcrossAllExponents) {
  // Every sign, exponent and top 12 fraction bits, with low bits on, beside and between the ties.
  Operands o(std::size_t{1} << 23);
  const Bits low[] = {0, 1, 0x7ff, 0x400};
  for (std::size_t n = 0; n < o.a.size(); ++n) o.a[n] = static_cast<Bits>(n >> 2 << 11) | low[n & 3];
  const auto half = run(Operation::float_to_half, o, false);
  for (std::size_t n = 0; n < o.a.size(); ++n) ASSERT_EQ(half[n], half_truth(to_float(o.a[n]))) << std::hex << o.a[n];
}

TEST_P(Simd, HalvesInMemory) {
  std::uint16_t in[max_lanes], out[max_lanes];
  float wide[max_lanes];
  for (int start = 0; start + max_lanes <= 0x7c00; start += max_lanes) {
    for (int i = 0; i < max_lanes; ++i) in[i] = static_cast<std::uint16_t>(start + i);
    GetParam()->half_round_trip(in, wide, out);
    for (int i = 0; i < GetParam()->lanes; ++i) {
      EXPECT_EQ(wide[i], half_value(in[i]));
      EXPECT_EQ(out[i], in[i]);
    }
  }
}

// Against the exact value in long double: 64 bits hold each product of two floats.
TEST_P(Simd, DifferenceOfProductsStaysWithinOneAndAHalfUlp) {
  std::mt19937 random(3);
  Operands o(1 << 18);
  for (std::size_t n = 0; n < o.a.size(); ++n) {
    o.a[n] = 0x3f800000 | (random() & 0x7fffff);
    o.b[n] = 0x3f800000 | (random() & 0x7fffff);
    o.c[n] = o.b[n] + random() % 5;  // nearly parallel: most of the bits cancel
  }
  for (const bool scalar : {false, true}) {
    const auto out = run(Operation::difference_of_products, o, scalar);  // a b - c a
    for (std::size_t n = 0; n < out.size(); ++n) {
      const double a = to_float(o.a[n]), exact = a * to_float(o.b[n]) - a * to_float(o.c[n]);
      const double ulp = exact == 0 ? 0 : std::ldexp(1.0, std::ilogb(exact) - 23);
      ASSERT_LE(std::fabs(to_float(out[n]) - exact), 1.5 * ulp);
    }
  }
}

TEST_P(Simd, MasksAndLanes) {
  const VocabularyTable& v = *GetParam();
  const Bits every = (Bits{1} << v.lanes) - 1;
  for (Bits set = 0; set <= every; ++set) {
    ASSERT_EQ(v.mask_round_trip(set), set);
    ASSERT_EQ(v.any_all_none(set), Bits(set != 0) | Bits(set == every) << 1 | Bits(set == 0) << 2);
  }
  for (int n : {-5, 0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 1 << 30})
    EXPECT_EQ(v.first_lanes(n), n <= 0 ? 0 : n >= v.lanes ? every : (Bits{1} << n) - 1) << n;
  std::int32_t index[max_lanes];
  float in[max_lanes], out[max_lanes];
  v.lane_index(index);
  for (int i = 0; i < v.lanes; ++i) in[i] = 1.0f / float(1 + i);
  v.lane_by_lane(in, out);
  for (int i = 0; i < v.lanes; ++i) {
    EXPECT_EQ(index[i], i);
    EXPECT_EQ(out[i], in[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(AllInstructionSets, Simd, testing::ValuesIn(runnable_vocabularies()),
                         [](const auto& info) { return std::string(info.param->isa); });

}  // namespace
}  // namespace tessera

// Every wrapper of kernels/simd.hpp behind a plain function, so that a test outside the instruction set can call it.
// vocabulary.cpp is compiled once per instruction set, as the kernels are.
#pragma once
#include <cstddef>
#include <cstdint>

namespace tessera {

// Element by element on bit patterns: out[i] = op(a[i], b[i], c[i]). Masks come out as 0 or ~0; a mask operand is the
// sign bit.
enum class Operation {
  add,
  subtract,
  multiply,
  divide,
  mul_add,
  mul_sub,
  neg_mul_add,
  sqrt,
  abs,
  negate,
  floor,
  min,
  max,
  clamp,
  saturate,
  copy_sign,
  difference_of_products,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  is_nan,
  select,
  truncate_to_int,
  round_to_int,
  to_float,
  half_to_float,
  float_to_half,
  int_add,
  int_subtract,
  int_multiply,
  int_negate,
  int_and,
  int_or,
  int_xor,
  int_not,
  shift_left,
  shift_right,
  shift_right_logical,
  low_half_shifted,
  high_half_shifted,
  dot_halves,
  int_min,
  int_max,
  int_less,
  int_less_equal,
  int_greater,
  int_greater_equal,
  int_equal,
  int_not_equal,
  int_select,
  mask_and,
  mask_or,
  mask_xor,
  mask_not,
};  // shifts: by the low five bits of b[0]

struct OperationArgs {
  Operation operation;
  const std::uint32_t *a, *b, *c;
  std::uint32_t* out;
  std::size_t count;  // a multiple of max_lanes
};

struct VocabularyTable {
  const char* isa;
  int lanes;
  void (*apply)(const OperationArgs&);         // through Float, Int and Mask
  void (*apply_scalar)(const OperationArgs&);  // the same source through float, int32_t and bool

  // One vector each; arrays of at least `lanes` elements, the mask in the low bits.
  void (*gather_float)(const float* table, const std::int32_t* index, float* out);
  void (*gather_int)(const std::int32_t* table, const std::int32_t* index, std::int32_t* out);
  void (*gather_float_masked)(const float* table, const std::int32_t* index, std::uint32_t mask, float* out);
  void (*gather_int_masked)(const std::int32_t* table, const std::int32_t* index, std::uint32_t mask,
                            std::int32_t* out);
  void (*gather_bytes)(const void* base, const std::int32_t* offset, std::int32_t* out);
  void (*gather_bytes_masked)(const void* base, const std::int32_t* offset, std::uint32_t mask, std::int32_t* out);
  void (*gather_pairs)(const void* base, const std::int32_t* offset, std::int32_t* low, std::int32_t* high);
  void (*store_float_masked)(const float* in, std::uint32_t mask, float* out);
  void (*store_int_masked)(const std::int32_t* in, std::uint32_t mask, std::int32_t* out);
  // Records of four words, or of twelve, or of three, at base[word[lane]]: word by word into out, `lanes` of each.
  void (*gather_quads)(const float* base, const std::int32_t* word, float* out);
  void (*gather_three_quads)(const float* base, const std::int32_t* word, float* out);
  void (*gather_triples)(const float* base, const std::int32_t* word, float* out);
  void (*load_quads)(const float* in, float* out);  // consecutive records -> word by word
  // And back: four lanes' records to out, four to out + row_stride, and so on.
  void (*store_quads)(const float* in, std::size_t row_stride, float* out);
  void (*stream_quads)(const float* in, std::size_t row_stride, float* out);
  void (*scatter_quads)(const float* in, int stride, float* out);
  void (*load_pairs)(const void* in, std::int32_t* low, std::int32_t* high);
  void (*store_pairs)(const std::int32_t* low, const std::int32_t* high, void* out);
  // find_distinct(): values has `lanes` elements, place4 too; and how many values there may be.
  int (*find_distinct)(const std::int32_t* in, std::int32_t* values, std::int32_t* place4);
  int most_distinct, records_per_register;
  // Records of twelve words, or of three, from one register or from two: word by word into out.
  void (*spread_records)(int registers, int words, const float* const* record, const std::int32_t* place4, float* out);
  void (*compress)(const float* in, std::uint32_t mask, float* out);
  int (*compress_store)(const std::int32_t* in, std::uint32_t mask, std::int32_t* out);
  std::uint32_t (*mask_round_trip)(std::uint32_t mask);
  std::uint32_t (*any_all_none)(std::uint32_t mask);  // bits 0, 1, 2
  std::uint32_t (*first_lanes)(int n);
  void (*lane_index)(std::int32_t* out);
  void (*lane_by_lane)(const float* in, float* out);                                  // through lane(v, i)
  void (*half_round_trip)(const std::uint16_t* in, float* wide, std::uint16_t* out);  // load_half, store_half
};

extern const VocabularyTable* const vocabulary_tables[];  // null-terminated, in the order of kernel_tables

}  // namespace tessera

// The functions of kernels/simd.hpp for float and double, one "lane" each. Included by kernels/simd.hpp alone.
#pragma once

namespace tessera::TESSERA_ISA {
namespace {

TESSERA_INLINE std::int32_t bits(float x) { return __builtin_bit_cast(std::int32_t, x); }
TESSERA_INLINE std::int64_t bits(double x) { return __builtin_bit_cast(std::int64_t, x); }
TESSERA_INLINE float from_bits(std::int32_t x) { return __builtin_bit_cast(float, x); }
TESSERA_INLINE double from_bits(std::int64_t x) { return __builtin_bit_cast(double, x); }

// One rounding. Without the instruction, as in simd/sse42.hpp: libm's fmaf is not called from a kernel.
TESSERA_INLINE float mul_add(float a, float b, float c) {
#if defined(__FMA__) || defined(__aarch64__)
  return __builtin_fmaf(a, b, c);
#else
  const __m128 sum = native::mul_add(_mm_set_ss(a), _mm_set_ss(b), _mm_set_ss(c));
  return _mm_cvtss_f32(sum);
#endif
}
TESSERA_INLINE double mul_add(double a, double b, double c) { return __builtin_fma(a, b, c); }
template <class F>
TESSERA_INLINE F mul_sub(F a, F b, F c) {
  return mul_add(a, b, -c);
}
template <class F>
TESSERA_INLINE F neg_mul_add(F a, F b, F c) {
  return mul_add(-a, b, c);
}

TESSERA_INLINE float sqrt(float x) { return __builtin_sqrtf(x); }
TESSERA_INLINE double sqrt(double x) { return __builtin_sqrt(x); }
TESSERA_INLINE float abs(float x) { return __builtin_fabsf(x); }
TESSERA_INLINE double abs(double x) { return __builtin_fabs(x); }
TESSERA_INLINE float floor(float x) { return __builtin_floorf(x); }
TESSERA_INLINE double floor(double x) { return __builtin_floor(x); }
TESSERA_INLINE float copy_sign(float magnitude, float sign) { return __builtin_copysignf(magnitude, sign); }
TESSERA_INLINE double copy_sign(double magnitude, double sign) { return __builtin_copysign(magnitude, sign); }

// The second operand where the comparison is false: a NaN on either side, or two zeros.
TESSERA_INLINE float min(float a, float b) { return a < b ? a : b; }
TESSERA_INLINE float max(float a, float b) { return a > b ? a : b; }
TESSERA_INLINE double min(double a, double b) { return a < b ? a : b; }
TESSERA_INLINE double max(double a, double b) { return a > b ? a : b; }
TESSERA_INLINE std::int32_t min(std::int32_t a, std::int32_t b) { return a < b ? a : b; }
TESSERA_INLINE std::int32_t max(std::int32_t a, std::int32_t b) { return a > b ? a : b; }
TESSERA_INLINE std::int64_t min(std::int64_t a, std::int64_t b) { return a < b ? a : b; }
TESSERA_INLINE std::int64_t max(std::int64_t a, std::int64_t b) { return a > b ? a : b; }

TESSERA_INLINE bool is_nan(float x) { return x != x; }
TESSERA_INLINE bool is_nan(double x) { return x != x; }
TESSERA_INLINE float select(bool m, float a, float b) { return m ? a : b; }
TESSERA_INLINE double select(bool m, double a, double b) { return m ? a : b; }
TESSERA_INLINE std::int32_t select(bool m, std::int32_t a, std::int32_t b) { return m ? a : b; }
TESSERA_INLINE std::int64_t select(bool m, std::int64_t a, std::int64_t b) { return m ? a : b; }
TESSERA_INLINE bool any(bool m) { return m; }
TESSERA_INLINE bool all(bool m) { return m; }
TESSERA_INLINE bool none(bool m) { return !m; }

TESSERA_INLINE std::int32_t shift_right_logical(std::int32_t x, int n) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(x) >> n);
}
TESSERA_INLINE std::int64_t shift_right_logical(std::int64_t x, int n) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(x) >> n);
}
template <int n>
TESSERA_INLINE std::int32_t low_half_shifted(std::int32_t x) {
  return static_cast<std::int16_t>(x) * (1 << n);
}
template <int n>
TESSERA_INLINE std::int32_t high_half_shifted(std::int32_t x) {
  return (x >> 16) * (1 << n);
}
TESSERA_INLINE std::int32_t dot_halves(std::int32_t a, std::int32_t b) {
  return static_cast<std::int16_t>(a) * static_cast<std::int16_t>(b) + (a >> 16) * (b >> 16);
}

// The caller keeps x within the integer's range.
TESSERA_INLINE std::int32_t truncate_to_int(float x) { return static_cast<std::int32_t>(x); }
TESSERA_INLINE std::int64_t truncate_to_int(double x) { return static_cast<std::int64_t>(x); }
// To the nearest, ties to even.
#if defined(__aarch64__)
TESSERA_INLINE std::int32_t round_to_int(float x) { return vcvtns_s32_f32(x); }
TESSERA_INLINE std::int64_t round_to_int(double x) { return vcvtnd_s64_f64(x); }
#else
TESSERA_INLINE std::int32_t round_to_int(float x) { return _mm_cvtss_si32(_mm_set_ss(x)); }
TESSERA_INLINE std::int64_t round_to_int(double x) { return _mm_cvtsd_si64(_mm_set_sd(x)); }
#endif
TESSERA_INLINE float to_float(std::int32_t x) { return static_cast<float>(x); }
TESSERA_INLINE double to_float(std::int64_t x) { return static_cast<double>(x); }

TESSERA_INLINE float lane(float x, int) { return x; }
TESSERA_INLINE double lane(double x, int) { return x; }
TESSERA_INLINE std::int32_t lane(std::int32_t x, int) { return x; }
TESSERA_INLINE std::int64_t lane(std::int64_t x, int) { return x; }
TESSERA_INLINE bool lane(bool x, int) { return x; }

TESSERA_INLINE float half_to_float(std::int32_t x) {
  const std::int32_t magnitude = x & 0x7fff, sign = static_cast<std::int32_t>(static_cast<std::uint32_t>(x) << 16);
  const float scaled = from_bits(magnitude << 13) * 0x1p112f;  // exact, subnormals included
  const std::int32_t special = magnitude << 13 | 0x7f800000 | (magnitude > 0x7c00 ? 0x400000 : 0);
  const std::int32_t value = magnitude >= 0x7c00 ? special : bits(scaled);
  return from_bits(value | (sign & static_cast<std::int32_t>(0x80000000u)));
}

// load<F>(p): one value per lane, any alignment.
template <class F>
TESSERA_INLINE F load(const float* p) {
  return static_cast<F>(*p);
}
template <class I = Int>
TESSERA_INLINE I load_int(const std::int32_t* p) {
  return *p;
}
template <class F = Float>
TESSERA_INLINE F load_half(const std::uint16_t* p) {
  return static_cast<F>(half_to_float(std::int32_t{*p}));
}
TESSERA_INLINE void store(float* p, float x) { *p = x; }
TESSERA_INLINE void store(std::int32_t* p, std::int32_t x) { *p = x; }

TESSERA_INLINE float gather(const float* p, std::int32_t index) { return p[index]; }
TESSERA_INLINE double gather(const float* p, std::int64_t index) { return static_cast<double>(p[index]); }
TESSERA_INLINE std::int32_t gather(const std::int32_t* p, std::int32_t index) { return p[index]; }
TESSERA_INLINE std::int64_t gather(const std::int32_t* p, std::int64_t index) { return p[index]; }

}  // namespace
}  // namespace tessera::TESSERA_ISA

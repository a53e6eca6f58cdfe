// What a machine's own estimates and free contraction would buy. BANNED from every kernel: the bits differ between
// machines, even between two makers of one instruction set. Only kernels/entry/terms_estimate.cpp includes this, and
// only the chart runs that.
#pragma once
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// 12 to 14 bits; 8 on AArch64.
TESSERA_INLINE Float hardware_reciprocal(Float x) {
#if defined(__AVX512F__)
  return make_float(_mm512_maskz_rcp14_ps(0xffff, x.raw()));
#elif defined(__AVX2__)
  return make_float(_mm256_rcp_ps(x.raw()));
#elif defined(__x86_64__)
  return make_float(_mm_rcp_ps(x.raw()));
#else
  return make_float(vrecpeq_f32(x.raw()));
#endif
}
TESSERA_INLINE Float hardware_rsqrt(Float x) {
#if defined(__AVX512F__)
  return make_float(_mm512_maskz_rsqrt14_ps(0xffff, x.raw()));
#elif defined(__AVX2__)
  return make_float(_mm256_rsqrt_ps(x.raw()));
#elif defined(__x86_64__)
  return make_float(_mm_rsqrt_ps(x.raw()));
#else
  return make_float(vrsqrteq_f32(x.raw()));
#endif
}
// What they estimate.
TESSERA_INLINE double hardware_reciprocal(double x) { return 1 / x; }
TESSERA_INLINE double hardware_rsqrt(double x) { return 1 / __builtin_sqrt(x); }

/// 1 / x for x in [1e-37, 1e37], with one Newton step. Plain operators: the compiler may contract them.
template <class F>
TESSERA_INLINE F estimated_reciprocal(F x) {
  const F y = hardware_reciprocal(x);
  return y * (F(2) - x * y);
}
/// 1 / sqrt(x) for x in [1e-37, 1e37], with one Newton step.
template <class F>
TESSERA_INLINE F estimated_rsqrt(F x) {
  const F y = hardware_rsqrt(x);
  return y * (F(1.5) - F(0.5) * x * y * y);
}

/// A number whose arithmetic is the compiler's and the machine's own: a * b + c in one rounding or in two, as it suits
/// them; with `estimates`, division and square root by estimate and one Newton step. Templates of kernels/ run on it.
template <bool estimates, class F>
struct Loose {
  F value;

  TESSERA_INLINE explicit Loose(F x) : value(x) {}
  template <class Constant>
  TESSERA_INLINE explicit Loose(Constant x) : value(x) {}

  TESSERA_INLINE friend Loose operator+(Loose a, Loose b) { return Loose(a.value + b.value); }
  TESSERA_INLINE friend Loose operator-(Loose a, Loose b) { return Loose(a.value - b.value); }
  TESSERA_INLINE friend Loose operator*(Loose a, Loose b) { return Loose(a.value * b.value); }
  TESSERA_INLINE friend Loose operator/(Loose a, Loose b) {
    if constexpr (estimates) {
      return Loose(a.value * estimated_reciprocal(b.value));
    } else {
      return Loose(a.value / b.value);
    }
  }
  TESSERA_INLINE friend Loose mul_add(Loose a, Loose b, Loose c) { return Loose(a.value * b.value + c.value); }
  TESSERA_INLINE friend Loose max(Loose a, Loose b) { return Loose(max(a.value, b.value)); }
  TESSERA_INLINE friend Loose sqrt(Loose x) {
    if constexpr (estimates) {
      return Loose(x.value * estimated_rsqrt(x.value));
    } else {
      return Loose(sqrt(x.value));
    }
  }
};

}  // namespace
}  // namespace tessera::TESSERA_ISA

// The vocabulary of every kernel: Float, Int and Mask (one lane per pixel, vertex or texel), and functions that mean
// the same, bit for bit, on every target and for plain float and double. The only include of xsimd.
//
// Templates over a number type F work for Float, float and double. IntOf<F> and MaskOf<F> name the types beside it:
// Int and Mask; int32_t and bool; int64_t and bool.
//
// What differs between machines is not here: reciprocal and square-root estimates, sums across lanes, min and max
// with the hardware's own rule for NaN. A NaN's sign and payload are the one thing that may differ: compare NaN-ness.
#pragma once
#include <cstddef>
#include <cstdint>

#include <xsimd/xsimd.hpp>

#ifndef TESSERA_ISA
#error "kernel headers need TESSERA_ISA, the namespace of the instruction set that this file is compiled for"
#endif
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "kernels must be compiled without -ffast-math and its parts"
#endif
#if __FLT_EVAL_METHOD__ != 0
#error "kernels need float arithmetic in float (no x87)"
#endif

// always_inline leaves no copy of a helper behind that the linker could hand to another instruction set.
#define TESSERA_INLINE [[gnu::always_inline]] inline

#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#include "kernels/simd/avx512.hpp"
#elif defined(__AVX2__) && defined(__FMA__) && defined(__F16C__)
#include "kernels/simd/avx2.hpp"
#elif defined(__SSE4_2__)
#include "kernels/simd/sse42.hpp"
#elif defined(__aarch64__)
#include "kernels/simd/neon64.hpp"
#else
#error "kernels need at least SSE4.2 (-march=x86-64-v2) or AArch64"
#endif

namespace tessera::TESSERA_ISA {
namespace {

struct Float;
struct Int;

struct Mask {
  using Batch = xsimd::batch_bool<float, native::Arch>;
  Batch batch;

  Mask() = default;
  TESSERA_INLINE explicit Mask(bool all) : batch(all) {}
  TESSERA_INLINE explicit Mask(Batch b) : batch(b) {}
  TESSERA_INLINE native::MaskRegister raw() const { return batch.data; }
};

struct Int {
  using Batch = xsimd::batch<std::int32_t, native::Arch>;
  static constexpr int lanes = static_cast<int>(Batch::size);
  Batch batch;

  Int() = default;
  TESSERA_INLINE explicit Int(std::int32_t all) : batch(all) {}
  TESSERA_INLINE explicit Int(std::uint32_t all) : batch(static_cast<std::int32_t>(all)) {}
  TESSERA_INLINE explicit Int(Batch b) : batch(b) {}
  TESSERA_INLINE native::IntRegister raw() const { return batch.data; }
};

struct Float {
  using Batch = xsimd::batch<float, native::Arch>;
  static constexpr int lanes = static_cast<int>(Batch::size);
  Batch batch;

  Float() = default;
  TESSERA_INLINE explicit Float(float all) : batch(all) {}
  TESSERA_INLINE explicit Float(double all) : batch(static_cast<float>(all)) {}
  TESSERA_INLINE explicit Float(std::int32_t all) : batch(static_cast<float>(all)) {}
  TESSERA_INLINE explicit Float(Batch b) : batch(b) {}
  TESSERA_INLINE native::FloatRegister raw() const { return batch.data; }
};

TESSERA_INLINE Mask make_mask(native::MaskRegister r) { return Mask(Mask::Batch(r)); }
TESSERA_INLINE Mask make_mask(xsimd::batch_bool<std::int32_t, native::Arch> b) {
  return make_mask(native::mask_from_int(b.data));
}
TESSERA_INLINE Int make_int(native::IntRegister r) { return Int(Int::Batch(r)); }
TESSERA_INLINE Float make_float(native::FloatRegister r) { return Float(Float::Batch(r)); }

// ---------------------------------------------------------------------------------------------------------- traits

template <class F>
struct NumberTraits;
template <>
struct NumberTraits<Float> {
  using Integer = Int;
  using Boolean = Mask;
};
template <>
struct NumberTraits<float> {
  using Integer = std::int32_t;
  using Boolean = bool;
};
template <>
struct NumberTraits<double> {
  using Integer = std::int64_t;
  using Boolean = bool;
};
template <class F>
using IntOf = typename NumberTraits<F>::Integer;
template <class F>
using MaskOf = typename NumberTraits<F>::Boolean;

}  // namespace
}  // namespace tessera::TESSERA_ISA

#include "kernels/simd/scalar.hpp"
#include "kernels/simd/vector.hpp"

#include "kernels/simd/pair.hpp"

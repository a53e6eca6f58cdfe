// Texture coordinate -> texels, along one axis. Safe for every input: an index is within [0, size) for NaN, infinite
// and huge coordinates too (NaN and infinity address the first texel).
#pragma once
#include "kernels/interface.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Two neighbouring texels and how far the coordinate lies from the first to the second, in [0, 1).
template <class F>
struct Taps {
  IntOf<F> first, second;
  F fraction;
};

/// Folds a coordinate into [0, 1].
template <class F>
inline F wrap_coordinate(F u, WrapMode wrap) {
  if (wrap == WrapMode::repeat) {
    u = u - floor(u);
  } else if (wrap == WrapMode::mirrored_repeat) {
    const F period = neg_mul_add(F(2), floor(u * F(0.5)), u);  // [0, 2]
    u = min(period, F(2) - period);
  }
  return saturate(u);  // a tiny negative u repeats to exactly 1; NaN becomes 0
}

/// The texel that holds the coordinate.
template <class F>
inline IntOf<F> nearest_texel(F u, WrapMode wrap, IntOf<F> size) {
  const F x = floor(wrap_coordinate(u, wrap) * to_float(size));
  return truncate_to_int(min(x, to_float(size - IntOf<F>(1))));  // u = 1 belongs to the last texel
}

/// The two texels whose centres enclose the coordinate. Lanes of `nearest` put all the weight on the one that holds it.
template <class F>
inline Taps<F> linear_taps(F u, WrapMode wrap, IntOf<F> size, MaskOf<F> nearest) {
  using I = IntOf<F>;
  const F extent = to_float(size);
  const F scaled = wrap_coordinate(u, wrap) * extent;  // [0, size]
  const F x = select(nearest, min(floor(scaled), extent - F(1)), scaled - F(0.5));
  const F left = floor(x);  // [-1, size - 1]
  Taps<F> taps;
  taps.fraction = x - left;
  const I first = truncate_to_int(left);
  const I second = first + I(1);
  const I last = size - I(1);
  // A texel beyond the edge is the opposite one when repeating. Mirrored and clamped, it is the edge's own.
  const bool repeat = wrap == WrapMode::repeat;
  taps.first = select(first < I(0), repeat ? last : I(0), first);
  taps.second = select(second > last, repeat ? I(0) : last, second);
  return taps;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// Two vectors as one number. Every operation is done on both, one right after the other, so that two chains of
// dependent instructions run side by side. Included by kernels/simd.hpp alone.
#pragma once

namespace tessera::TESSERA_ISA {
namespace {

template <class T>
struct Pair {
  static constexpr int lanes = 2 * T::lanes;
  T first, second;

  Pair() = default;
  TESSERA_INLINE Pair(T a, T b) : first(a), second(b) {}
  TESSERA_INLINE explicit Pair(float all) : first(all), second(all) {}
  TESSERA_INLINE explicit Pair(double all) : first(all), second(all) {}
  TESSERA_INLINE explicit Pair(std::int32_t all) : first(all), second(all) {}
};

template <>
struct NumberTraits<Pair<Float>> {
  using Integer = Pair<Int>;
  using Boolean = Pair<Mask>;
};

// As many lanes as there are independent chains for: with registers of sixteen floats one is enough to keep a core busy
// (and two would not fit into its registers), with shorter ones it is not.
template <int lanes>
struct WideOf {
  using type = Pair<Float>;
};
template <>
struct WideOf<16> {
  using type = Float;
};
using Wide = WideOf<Float::lanes>::type;

// ------------------------------------------------------------------------------------------------------- operators

template <class T>
TESSERA_INLINE Pair<T> operator+(Pair<T> a, Pair<T> b) {
  return {a.first + b.first, a.second + b.second};
}
template <class T>
TESSERA_INLINE Pair<T> operator-(Pair<T> a, Pair<T> b) {
  return {a.first - b.first, a.second - b.second};
}
template <class T>
TESSERA_INLINE Pair<T> operator*(Pair<T> a, Pair<T> b) {
  return {a.first * b.first, a.second * b.second};
}
TESSERA_INLINE Pair<Float> operator/(Pair<Float> a, Pair<Float> b) { return {a.first / b.first, a.second / b.second}; }
template <class T>
TESSERA_INLINE Pair<T> operator-(Pair<T> a) {
  return {-a.first, -a.second};
}
template <class T>
TESSERA_INLINE Pair<T> operator&(Pair<T> a, Pair<T> b) {
  return {a.first & b.first, a.second & b.second};
}
template <class T>
TESSERA_INLINE Pair<T> operator|(Pair<T> a, Pair<T> b) {
  return {a.first | b.first, a.second | b.second};
}
TESSERA_INLINE Pair<Mask> operator!(Pair<Mask> a) { return {!a.first, !a.second}; }
TESSERA_INLINE Pair<Int> operator<<(Pair<Int> a, int n) { return {a.first << n, a.second << n}; }
TESSERA_INLINE Pair<Int> operator>>(Pair<Int> a, int n) { return {a.first >> n, a.second >> n}; }
template <class T>
TESSERA_INLINE Pair<Mask> operator<(Pair<T> a, Pair<T> b) {
  return {a.first < b.first, a.second < b.second};
}
template <class T>
TESSERA_INLINE Pair<Mask> operator>(Pair<T> a, Pair<T> b) {
  return {a.first > b.first, a.second > b.second};
}
template <class T>
TESSERA_INLINE Pair<Mask> operator>=(Pair<T> a, Pair<T> b) {
  return {a.first >= b.first, a.second >= b.second};
}

// ------------------------------------------------------------------------------------------------------- functions

TESSERA_INLINE Pair<Int> bits(Pair<Float> x) { return {bits(x.first), bits(x.second)}; }
TESSERA_INLINE Pair<Float> from_bits(Pair<Int> x) { return {from_bits(x.first), from_bits(x.second)}; }
TESSERA_INLINE Pair<Float> mul_add(Pair<Float> a, Pair<Float> b, Pair<Float> c) {
  return {mul_add(a.first, b.first, c.first), mul_add(a.second, b.second, c.second)};
}
TESSERA_INLINE Pair<Float> mul_sub(Pair<Float> a, Pair<Float> b, Pair<Float> c) {
  return {mul_sub(a.first, b.first, c.first), mul_sub(a.second, b.second, c.second)};
}
TESSERA_INLINE Pair<Float> neg_mul_add(Pair<Float> a, Pair<Float> b, Pair<Float> c) {
  return {neg_mul_add(a.first, b.first, c.first), neg_mul_add(a.second, b.second, c.second)};
}
TESSERA_INLINE Pair<Float> sqrt(Pair<Float> x) { return {sqrt(x.first), sqrt(x.second)}; }
TESSERA_INLINE Pair<Float> abs(Pair<Float> x) { return {abs(x.first), abs(x.second)}; }
template <class T>
TESSERA_INLINE Pair<T> min(Pair<T> a, Pair<T> b) {
  return {min(a.first, b.first), min(a.second, b.second)};
}
template <class T>
TESSERA_INLINE Pair<T> max(Pair<T> a, Pair<T> b) {
  return {max(a.first, b.first), max(a.second, b.second)};
}
template <class T>
TESSERA_INLINE Pair<T> select(Pair<Mask> m, Pair<T> a, Pair<T> b) {
  return {select(m.first, a.first, b.first), select(m.second, a.second, b.second)};
}
TESSERA_INLINE bool any(Pair<Mask> m) { return any(m.first | m.second); }
TESSERA_INLINE Pair<Int> truncate_to_int(Pair<Float> x) {
  return {truncate_to_int(x.first), truncate_to_int(x.second)};
}
TESSERA_INLINE Pair<Int> round_to_int(Pair<Float> x) { return {round_to_int(x.first), round_to_int(x.second)}; }
TESSERA_INLINE Pair<Float> to_float(Pair<Int> x) { return {to_float(x.first), to_float(x.second)}; }

template <>
TESSERA_INLINE Pair<Float> load<Pair<Float>>(const float* p) {
  return {load<Float>(p), load<Float>(p + Float::lanes)};
}
template <>
TESSERA_INLINE Pair<Int> load_int<Pair<Int>>(const std::int32_t* p) {
  return {load_int<Int>(p), load_int<Int>(p + Int::lanes)};
}
TESSERA_INLINE void store(float* p, Pair<Float> x) {
  store(p, x.first);
  store(p + Float::lanes, x.second);
}
TESSERA_INLINE void store(std::int32_t* p, Pair<Int> x) {
  store(p, x.first);
  store(p + Int::lanes, x.second);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

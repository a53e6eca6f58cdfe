// Two- and three-component vectors over a number type.
#pragma once
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

template <class F>
struct Vec2 {
  F x, y;
};

template <class F>
struct Vec3 {
  F x, y, z;
};

template <class F>
TESSERA_INLINE Vec2<F> operator+(Vec2<F> a, Vec2<F> b) {
  return {a.x + b.x, a.y + b.y};
}
template <class F>
TESSERA_INLINE Vec2<F> operator-(Vec2<F> a, Vec2<F> b) {
  return {a.x - b.x, a.y - b.y};
}
template <class F>
TESSERA_INLINE Vec2<F> operator-(Vec2<F> a) {
  return {-a.x, -a.y};
}
template <class F>
TESSERA_INLINE Vec2<F> operator*(Vec2<F> a, Vec2<F> b) {
  return {a.x * b.x, a.y * b.y};
}
template <class F>
TESSERA_INLINE Vec2<F> operator*(Vec2<F> a, F s) {
  return {a.x * s, a.y * s};
}
template <class F>
TESSERA_INLINE Vec2<F> operator*(F s, Vec2<F> a) {
  return a * s;
}

template <class F>
TESSERA_INLINE Vec3<F> operator+(Vec3<F> a, Vec3<F> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class F>
TESSERA_INLINE Vec3<F> operator-(Vec3<F> a, Vec3<F> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class F>
TESSERA_INLINE Vec3<F> operator-(Vec3<F> a) {
  return {-a.x, -a.y, -a.z};
}
template <class F>
TESSERA_INLINE Vec3<F> operator*(Vec3<F> a, Vec3<F> b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class F>
TESSERA_INLINE Vec3<F> operator*(Vec3<F> a, F s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class F>
TESSERA_INLINE Vec3<F> operator*(F s, Vec3<F> a) {
  return a * s;
}

template <class F>
TESSERA_INLINE F dot(Vec2<F> a, Vec2<F> b) {
  return mul_add(a.y, b.y, a.x * b.x);
}
template <class F>
TESSERA_INLINE F dot(Vec3<F> a, Vec3<F> b) {
  return mul_add(a.z, b.z, mul_add(a.y, b.y, a.x * b.x));
}

// Every component within 1.5 ulp, also for nearly parallel vectors.
template <class F>
TESSERA_INLINE Vec3<F> cross(Vec3<F> a, Vec3<F> b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

template <class V>
TESSERA_INLINE auto length(V a) {
  return sqrt(dot(a, a));
}

template <class F>
TESSERA_INLINE Vec2<F> select(MaskOf<F> m, Vec2<F> a, Vec2<F> b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y)};
}
template <class F>
TESSERA_INLINE Vec3<F> select(MaskOf<F> m, Vec3<F> a, Vec3<F> b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}

// a / |a|. Where |a|^2 under- or overflows a normal float (|a| < 1.1e-19 or > 1.7e19, a zero or a NaN), the fallback.
template <class F>
TESSERA_INLINE Vec3<F> normalize(Vec3<F> a, Vec3<F> fallback) {
  const F squared = dot(a, a);
  const MaskOf<F> usable = (squared > F(0x1p-126)) & (squared < F(3e38));  // both false for NaN
  const F scale = F(1) / sqrt(squared);
  return select<F>(usable, a * scale, fallback);
}
// The same with (0, 0, 1) as the fallback.
template <class F>
TESSERA_INLINE Vec3<F> normalize(Vec3<F> a) {
  return normalize(a, Vec3<F>{F(0), F(0), F(1)});
}

// a at t = 0 and, up to rounding, b at t = 1.
template <class F>
TESSERA_INLINE F lerp(F a, F b, F t) {
  return mul_add(t, b - a, a);
}
template <class F>
TESSERA_INLINE Vec2<F> lerp(Vec2<F> a, Vec2<F> b, F t) {
  return {lerp(a.x, b.x, t), lerp(a.y, b.y, t)};
}
template <class F>
TESSERA_INLINE Vec3<F> lerp(Vec3<F> a, Vec3<F> b, F t) {
  return {lerp(a.x, b.x, t), lerp(a.y, b.y, t), lerp(a.z, b.z, t)};
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

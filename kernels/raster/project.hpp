// World positions -> fixed-point window coordinates.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// The guard band: vertices within it need no clipping in x and y. Snapped coordinates stay in [-2^22, 2^23], pixels
// [-16384, 32768]: at least a whole frame (max_frame_size) of margin on every side, and differences of coordinates
// are at most 3 * 2^22 < 2^24, so that they are exact in float and their products in int64 and double.
inline constexpr std::int32_t guard_low = -(1 << 22);
inline constexpr std::int32_t guard_high = 1 << 23;
inline constexpr float subpixel_scale = 1 << subpixel_bits;

template <class F>
struct ClipPosition {  // homogeneous window coordinates: x_pixels * w, y_pixels * w, depth * w, w
  F x, y, z, w;
};

template <class F>
struct Projected {
  IntOf<F> x, y;
  F depth;
  IntOf<F> flags;
};

template <class F>
inline F transform_row(const float (&row)[4], F x, F y, F z) {
  return mul_add(F(row[0]), x, mul_add(F(row[1]), y, mul_add(F(row[2]), z, F(row[3]))));
}

template <class F>
inline ClipPosition<F> to_clip(const ViewTransform& view, F x, F y, F z) {
  return {transform_row(view.x, x, y, z), transform_row(view.y, x, y, z), transform_row(view.z, x, y, z),
          transform_row(view.w, x, y, z)};
}

/// Outcodes are tests in homogeneous space, so that three vertices beyond one plane can be dropped whatever their w.
/// Watertight: with |x| <= 2^14 pixels, float rounding moves a vertex by less than half of 1/256 pixel, so a vertex
/// that is called outside never snaps to the inner side of the viewport's border.
template <class F>
inline Projected<F> project(const ViewTransform& view, const ClipPosition<F>& p) {
  using I = IntOf<F>;
  const auto flag = [](MaskOf<F> m, int bit) { return select(m, I(bit), I(0)); };
  const F zero(0), infinity_bound(3.4028234663852886e38), low(guard_low), high(guard_high);
  const auto finite = (abs(p.x) <= infinity_bound) & (abs(p.y) <= infinity_bound) & (abs(p.z) <= infinity_bound) &
                      (abs(p.w) <= infinity_bound);
  const F x = p.x / p.w * F(subpixel_scale);
  const F y = p.y / p.w * F(subpixel_scale);
  const auto in_guard = (x >= low) & (x <= high) & (y >= low) & (y <= high);
  const auto in_front = (p.z <= p.w) & (p.w > zero);
  Projected<F> out;
  out.x = round_to_int(clamp(x, low, high));
  out.y = round_to_int(clamp(y, low, high));
  // Beyond the far plane of an orthographic camera depth is negative; -2^60 keeps depth planes finite.
  out.depth = clamp(p.z / p.w, F(-1152921504606846976.0), F(1));
  out.flags = flag(p.x < zero, outside_left) | flag(p.x > F(view.width) * p.w, outside_right) |
              flag(p.y < zero, outside_top) | flag(p.y > F(view.height) * p.w, outside_bottom) |
              flag(p.z > p.w, outside_near) | flag(p.z < zero, outside_far) | flag(!(in_guard & in_front), needs_clip) |
              flag(!finite, not_finite);
  return out;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

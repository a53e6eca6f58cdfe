// Which lights reach a set of points: their bounding box against each light's sphere.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

struct Box {
  float low[3], high[3];
};

/// position as GBufferView::position.
inline Box bounding_box(const float* const position[3], std::uint32_t count) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    Float low(max_coordinate), high(-max_coordinate);
    for (std::uint32_t i = 0; i < count; i += Float::lanes) {
      const Float p = load<Float>(position[axis] + i);
      const Mask there = first_lanes(static_cast<int>(count - i));
      low = select(there, min(p, low), low);
      high = select(there, max(p, high), high);
    }
    // The least and the greatest do not depend on the order in which they are looked for.
    float lows[Float::lanes], highs[Float::lanes];
    store(lows, low);
    store(highs, high);
    box.low[axis] = lows[0];
    box.high[axis] = highs[0];
    for (int k = 1; k < Float::lanes; ++k) {
      box.low[axis] = min(box.low[axis], lows[k]);
      box.high[axis] = max(box.high[axis], highs[k]);
    }
  }
  return box;
}

/// The distance's parts, its square and its ratio to the range are computed as light_reach does, step by step. Rounding
/// is monotonic, so no point in the box gets a smaller ratio than the box: a light beyond 1 has a window of exactly 0.
inline std::uint32_t cull_lights_against(const Box& box, const LightBoundsView& lights, std::uint32_t* out) {
  auto* next = reinterpret_cast<std::int32_t*>(out);
  const auto beside = [&](const float* centre, std::uint32_t i, int axis) {
    const Float c = load<Float>(centre + i);
    return max(max(Float(box.low[axis]) - c, c - Float(box.high[axis])), Float(0));
  };
  for (std::uint32_t i = 0; i < lights.count; i += Float::lanes) {
    const Float x = beside(lights.x, i, 0), y = beside(lights.y, i, 1), z = beside(lights.z, i, 2);
    const Vec3<Float> d = {x, y, z};
    const Mask reaches = !(dot(d, d) * load<Float>(lights.inverse_range_squared + i) > Float(1));
    const Mask there = first_lanes(static_cast<int>(lights.count - i));
    next += compress_store(next, lane_index() + Int(i), reaches & there);
  }
  return static_cast<std::uint32_t>(next - reinterpret_cast<std::int32_t*>(out));
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

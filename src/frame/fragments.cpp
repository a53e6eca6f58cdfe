#include "frame/fragments.hpp"

#include "frame/gbuffer.hpp"

namespace tessera {

void TileFragments::reserve_planes(std::uint32_t count) {
  const std::size_t wanted = round_up_to_lanes(count);
  if (wanted <= stride_) return;
  // One cache line more than a power of two: planes a multiple of 4 KiB apart would share the same cache sets.
  stride_ = wanted + wanted / 4 + max_lanes;
  stride_ = stride_ / max_lanes * max_lanes;
  // All anew: shading reads up to max_lanes - 1 slots beyond the last, and what lay there in planes of another length
  // could be out of range here.
  planes_.assign(stride_ * (gbuffer_planes + 3), 0.0f);
}

GBufferView TileFragments::gbuffer(std::uint32_t first) const {
  GBufferView view{};
  for (int k = 0; k < gbuffer_planes; ++k) gbuffer_pointer(view, k) = plane(k, first);
  return view;
}

std::array<float*, 3> TileFragments::radiance(std::uint32_t first) const {
  return {plane(gbuffer_planes, first), plane(gbuffer_planes + 1, first), plane(gbuffer_planes + 2, first)};
}

std::size_t TileFragments::bytes() const {
  return planes_.capacity() * sizeof(float) + fragments.capacity() * sizeof(Fragment) +
         slots.capacity() * sizeof(std::uint32_t);
}

}  // namespace tessera

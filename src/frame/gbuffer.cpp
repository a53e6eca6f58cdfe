#include "frame/gbuffer.hpp"

#include <algorithm>

namespace tessera {

float*& gbuffer_pointer(GBufferView& view, int k) {
  float** const pointers[gbuffer_planes] = {
      &view.position[0],   &view.position[1],   &view.position[2],   &view.normal[0], &view.normal[1], &view.normal[2],
      &view.base_color[0], &view.base_color[1], &view.base_color[2], &view.metallic,  &view.roughness, &view.occlusion,
      &view.emissive[0],   &view.emissive[1],   &view.emissive[2],   &view.alpha,     &view.unlit,     &view.depth};
  return *pointers[k];
}

bool GBufferImage::is_flat() const {
  const std::uint32_t whole = (1u << samples) - 1;
  return std::all_of(counts.begin(), counts.end(), [](std::uint32_t n) { return n <= 1; }) &&
         std::all_of(coverage.begin(), coverage.end(), [&](std::uint32_t c) { return c == whole; });
}

}  // namespace tessera

// Which shading features a set of fragments calls for: model no more than a scene needs.
#pragma once
#include <cstdint>

#include "kernels/interface.hpp"

namespace tessera {

/// Features (ShadeFeature bits) that fragments of this material use, among those that the frame offers.
std::uint32_t classify(const MaterialView& material, std::uint32_t frame_features);

/// The same from the content of a G-buffer.
std::uint32_t classify(const GBufferView& gbuffer, std::uint32_t count, std::uint32_t frame_features);

}  // namespace tessera

// The points over which a level of the prefiltered environment is summed.
#pragma once
#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera {

struct Lobe {
  AlignedVector<float> x, y, z, weight, lod;
  float alpha2 = 0, scale = 0;  // the lobe itself, of integral 1: PointSources has the formula

  [[nodiscard]] LobeSamples view() const {
    return {x.data(), y.data(), z.data(), weight.data(), lod.data(), int(x.size())};
  }
};

/// The GGX lobe about +z for n = v = r (Karis 2013, "Real shading in Unreal Engine 4": half-vectors by D(h) n.h,
/// weights n.l), at the points of a spiral. roughness: perceptual, in (0, 1]; cube_size: texels along a face of the
/// radiance that will be read, level 0.
Lobe ggx_lobe(float roughness, int count, int cube_size, const Kernels& kernels);

}  // namespace tessera

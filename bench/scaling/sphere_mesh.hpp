// The scene of the peer comparison as triangles: as many as wanted, over the same pixels.
#pragma once
#include <cstddef>

#include "bench/workload/mesh.hpp"

namespace tessera::scaling {

/// Spheres on a floor, about that many triangles, about half of them seen from the front; a tenth are the floor's.
workload::Mesh sphere_mesh(std::size_t triangles);

/// The camera of the peer comparison.
View sphere_view(int width, int height, const Kernels& kernels);

}  // namespace tessera::scaling

// The table that kernels/bsdf/energy_loss.hpp reads, baked by quadrature.
#pragma once
#include <vector>

namespace tessera::reference {

/// size x size values of q = Ems / (m u^2 (1 + mu^2 m^2)), with Ems = 1 - E(mu, alpha), m = mu / (mu + 2.5
/// alpha) and u = 1 - m; row j at perceptual roughness j / (size - 1) (alpha is its square), column i at sqrt(m (1
/// + 2.5 alpha)) = i / (size - 1). size >= 2. Exact at the nodes to float precision, except where a node has no value:
/// smooth surfaces (row 0) take that of alpha = 1e-6, the horizon (column 0) that of half a column further.
std::vector<float> energy_loss_table(int size);

}  // namespace tessera::reference

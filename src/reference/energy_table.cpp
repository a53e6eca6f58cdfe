#include "reference/energy_table.hpp"

#include <algorithm>
#include <cmath>

#include "reference/albedo.hpp"

namespace tessera::reference {

std::vector<float> energy_loss_table(int size) {
  constexpr double scale = 2.5;
  std::vector<float> table;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const double r = double(j) / (size - 1), alpha = std::max(r * r, 1e-6);
      const double x = std::max(double(i), 0.5) / (size - 1), m = x * x / (1 + scale * alpha), u = 1 - m;
      // m solved for mu; at the last column it is 1 but for rounding.
      const double mu = i == size - 1 ? 1 : std::min(scale * alpha * m / u, 1.0);
      table.push_back(float((1 - directional_albedo(mu, alpha, 40).E()) / (m * u * u * (1 + mu * mu * m * m))));
    }
  return table;
}

}  // namespace tessera::reference

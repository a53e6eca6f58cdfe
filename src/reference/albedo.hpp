// Directional albedo of the GGX lobe by quadrature: what fraction of light from a white hemisphere it reflects.
#pragma once

namespace tessera::reference {

/// The lobe's integral against the cosine, split by Schlick's Fresnel: integral f = F0 A + F90 B.
struct DirectionalAlbedo {
  double A = 0, B = 0;
  [[nodiscard]] double E() const { return A + B; }
};

/// mu = n.v in (0,1], alpha in (0,1], height-correlated Smith. `order` nodes per piece; the difference between two
/// orders is the convergence estimate: below 1e-6 from 64 on for mu >= 0.05.
DirectionalAlbedo directional_albedo(double mu, double alpha, int order = 96);

/// 2 integral E(mu) mu dmu.
double average_albedo(double alpha, int order = 48);

}  // namespace tessera::reference

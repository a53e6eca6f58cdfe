// Ground truth for light that meets several microfacets: a random walk inside the surface.
//
// Heitz, Hanika, d'Eon, Dachsbacher 2016, Multiple-Scattering Microfacet BSDFs with the Smith Model: the surface is a
// medium whose density depends on height; a ray goes down, meets a facet that it sees (distribution of visible
// normals), is reflected, and either leaves or meets another. What comes out after one facet is the classic
// single-scattering lobe with height-correlated masking; the rest is what that lobe lacks.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "reference/vector.hpp"

namespace tessera::reference {

/// A GGX surface with Smith's uncorrelated heights. One channel of colour.
struct Microsurface {
  enum class Facets { mirror, diffuse };
  double alpha = 1;  // roughness^2, (0,1] (the walk itself has no upper limit)
  /// What a facet reflects, [0,1], of the cosine between direction and facet: Fresnel's function of a metal. Diffuse
  /// facets take it as their albedo, which should be the same for every cosine: otherwise they are not reciprocal.
  std::function<double(double)> reflectance = [](double) { return 1.0; };
  Facets facets = Facets::mirror;
};

/// A Monte-Carlo result and its own convergence estimate: the standard deviation of the mean.
struct Estimate {
  double mean = 0, error = 0;
};

struct WalkResult {
  Estimate total;                  // all orders, beyond those that are listed too
  Estimate multiple;               // all orders but the first
  std::vector<Estimate> by_order;  // [0]: light that met one facet
};

/// Directional albedo: the fraction of light along v that leaves again, anywhere. mu = n.v in (0,1]. For white facets
/// the total is 1 (a walk ends only by leaving).
WalkResult walk_albedo(const Microsurface& surface, double mu, long walks, int orders = 4, std::uint64_t seed = 1);

/// The BRDF's value, cosine not included, for unit vectors above the surface in the shading frame (n = +Z), by the
/// paper's stochastic evaluation: at each facet of a walk from v, the light that would leave along l. Symmetric in v
/// and l in expectation.
WalkResult walk_brdf(const Microsurface& surface, const Vec3& v, const Vec3& l, long walks, int orders = 4,
                     std::uint64_t seed = 1);

}  // namespace tessera::reference

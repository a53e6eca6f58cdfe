// Specular lobes as sums over microfacets: the points at which a chart compares forms of masking.
#pragma once
#include <vector>

#include "reference/vector.hpp"

namespace tessera::chart {

enum class Microfacets { ggx, beckmann };

/// One direction of light: integral f n.l dl = sum of weight V, for a lobe f = D V with F = 1.
struct LobeSample {
  reference::Vec3 v, l;
  double NoH, VoH, phi, weight;
};

/// Every direction above the surface, as order x order facets in either of two rings; mu = n.v.
std::vector<LobeSample> lobe_samples(Microfacets microfacets, double mu, double alpha, int order);

}  // namespace tessera::chart

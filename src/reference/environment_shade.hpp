// A point's light from an environment: the Monte-Carlo integral of its BRDF over the sphere, in double.
//
// The BRDF: the GGX lobe with height-correlated Smith masking (Heitz 2014) and Schlick's Fresnel; light that met
// several facets as Kulla and Conty 2017 have it ("Revisiting physically based shading at Imageworks"), tinted by the
// average Fresnel term; below them Lambert, by what those two leave (1 - E): the energy that the renderer's split sum
// aims at, with every integral exact. Occlusion multiplies the result, as in the renderer.
#pragma once
#include <cstdint>
#include <vector>

#include "reference/environment.hpp"
#include "reference/shade.hpp"

namespace tessera::reference {

/// Radiance with the standard error of its mean, per channel.
struct RadianceEstimate {
  Vec3 mean, error;
};

/// What the lobe loses, by roughness and angle; built once, by quadrature.
class EnergyTable {
 public:
  explicit EnergyTable(int size = 33);
  /// 1 - E(mu), mu in (0, 1], roughness in [0, 1].
  [[nodiscard]] double loss(double mu, double roughness) const;
  /// 1 - Eavg.
  [[nodiscard]] double average_loss(double roughness) const;

 private:
  int size_;
  std::vector<double> loss_, average_;
};

/// Radiance towards v from the surface. Three directions per round: by visible normals, by the environment's
/// brightness, by the cosine; each weighted by the balance heuristic (Veach 1997, section 9.2).
RadianceEstimate integrate_environment(const ShadeSurface& surface, const Vec3& v, const EnvironmentMap& environment,
                                       const EnergyTable& table, int rounds, std::uint64_t seed);

}  // namespace tessera::reference

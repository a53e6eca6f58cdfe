// Environments that image-based lighting is measured in, and what surfaces in them reflect, by brute force in double.
#pragma once
#include <string>
#include <vector>

#include "bench/chart/chart.hpp"
#include "precompute/environment.hpp"
#include "reference/environment_shade.hpp"

namespace tessera::chart {

/// Radiance from all around: as the renderer bakes it, and as it is. Of its channels the second alone is measured.
struct World {
  World(GivenEnvironment given, const EnvironmentSettings& settings, const Kernels& kernels);

  std::string id, title;
  Image picture;  // equirectangular, RGB
  Environment environment;
  reference::EnvironmentMap map;
  double mean;  // radiance over the sphere

  /// What white facets of the GGX lobe reflect to v: the integral of D G2 / (4 n.v n.l) L n.l. Over the picture's
  /// texels where the lobe is wide against them, else over visible normals.
  [[nodiscard]] double reflected(const reference::Vec3& n, const reference::Vec3& v, double alpha) const;

 private:
  struct Texel {
    reference::Vec3 d;
    double solid_angle, radiance;
  };
  std::vector<Texel> texels_;
};

/// The session's own pictures, baked as the renderer does. If it has none: a sky with a sun above a dark ground; a dark
/// room with windows; a studio of strip lights. Those are grey and of 256 x 128 texels.
std::vector<World> make_worlds(const Session& session);

/// Ways to prefilter, and formats of texels: plots of the family, in ibl_bake.cpp.
Plot prefilter_plot(Session& session, const World& world);
Plot level_plot(Session& session, const World& world);
Plot format_plot(Session& session, const World& world);

}  // namespace tessera::chart

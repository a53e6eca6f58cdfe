// A cube's texels as six quadtrees, from which a lobe is summed with as few texels as its shape allows: fine ones
// around its axis, coarser ones where it is flat. (The idea is Barnes and Hut's, 1986, "A hierarchical O(N log N)
// force-calculation algorithm".)
#pragma once
#include <vector>

#include "precompute/cube.hpp"

namespace tessera {

/// Texels of several levels that cover the sphere once, or the part of it that a lobe sees.
struct SphereCut {
  ScratchVector<float> x, y, z, red, green, blue, solid_angle;

  void resize(std::size_t count);
  [[nodiscard]] PointSources view(float alpha2) const;
};

class SphereTree {
 public:
  struct Node {
    float x, y, z, solid_angle, width;
    float flux[3];
  };
  /// Where a node is in its level. What cut() works with is kept by its caller, from cut to cut.
  struct Place {
    std::int32_t face, i, j;
  };
  struct Scratch {
    ScratchVector<Place> places, open;
    ScratchVector<const Node*> taken;
  };

  explicit SphereTree(const CubeLevel& radiance);

  /// Directions within `radius` (a chord of the unit sphere) of `centre`: the axes of lobes that share a cut.
  struct Cap {
    float x, y, z, radius;
  };
  /// Texels for lobes of this alpha around any axis of the cap: those whose width is at most `fineness` times
  /// sqrt(4 alpha^2 + d^2), d their distance from the cap; half spheres behind all horizons left out.
  void cut(const Cap& cap, float alpha, float fineness, Scratch& scratch, SphereCut& out) const;

 private:
  std::vector<std::vector<Node>> levels_;  // finest first
  int size_;
};

}  // namespace tessera

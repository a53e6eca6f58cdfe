// Pairs of directions for tests of diffuse lobes, with what the terms take of them.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/vector.hpp"

namespace tessera::test {

struct DiffuseInputs {
  std::vector<float> albedo, roughness, NoV, NoL, LoV, LoH;
  struct Exact {
    reference::Vec3 v, l;  // rebuilt from NoV, NoL and the azimuth
    double albedo, roughness;
  };
  std::vector<Exact> exact;
};

/// Cosines from 1e-3 to 1, all azimuths, roughness from 0 to 1.
inline DiffuseInputs diffuse_inputs(int steps = 8) {
  DiffuseInputs in;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      for (int k = 0; k <= steps; ++k)
        for (const double phi : {0.0, 0.8, 1.7, 3.1}) {
          const float NoV = float(std::pow(10.0, -3 + 3.0 * i / steps)),
                      NoL = float(std::pow(10.0, -3 + 3.0 * j / steps));
          const float roughness = float(k) / float(steps), albedo = float(1 + (i + j + k) % 4) / 4;
          DiffuseInputs::Exact e;
          e.v = {std::sqrt(1 - double(NoV) * NoV), 0, NoV};
          const double sine = std::sqrt(1 - double(NoL) * NoL);
          e.l = {sine * std::cos(phi), sine * std::sin(phi), NoL};
          e.albedo = albedo, e.roughness = roughness;
          in.albedo.push_back(albedo), in.roughness.push_back(roughness);
          in.NoV.push_back(NoV), in.NoL.push_back(NoL);
          in.LoV.push_back(float(std::clamp(reference::dot(e.l, e.v), -1.0, 1.0)));
          in.LoH.push_back(float(reference::dot(e.l, reference::normalize(e.l + e.v))));
          in.exact.push_back(e);
        }
  return in;
}

}  // namespace tessera::test

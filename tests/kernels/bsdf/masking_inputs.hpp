// Pairs of directions for tests of masking, from grazing to normal, with what the terms take of them.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/vector.hpp"

namespace tessera::test {

struct MaskingInputs {
  std::vector<float> NoV, NoL, NoH, VoH, phi, alpha, roughness;
  // The pair and the alpha that the floats stand for, rebuilt from NoV, NoL and phi.
  struct Exact {
    reference::Vec3 v, l;
    double theta_v, theta_l, phi, alpha, roughness;
  };
  std::vector<Exact> exact;
};

/// Cosines from 1e-4 to 1, azimuths from 0 to pi, alpha from 1e-4 to 1.
inline MaskingInputs masking_inputs() {
  MaskingInputs in;
  const double azimuths[] = {0, 1e-3, 0.4, 1.7, 3.1415};
  const auto logarithmic = [](int i, int last) { return float(std::pow(10.0, -4 + 4.0 * i / last)); };
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 12; ++j)
      for (int k = 0; k <= 12; ++k)
        for (const double azimuth : azimuths) {
          const float NoV = logarithmic(i, 12), NoL = logarithmic(j, 12), alpha = logarithmic(k, 12);
          const float phi = float(azimuth), roughness = std::sqrt(alpha);
          MaskingInputs::Exact e;
          e.theta_v = std::acos(double(NoV)), e.theta_l = std::acos(double(NoL));
          e.v = reference::from_angles(e.theta_v, 0), e.l = reference::from_angles(e.theta_l, phi);
          e.v.z = NoV, e.l.z = NoL;
          e.phi = phi, e.alpha = alpha, e.roughness = roughness;
          const reference::Vec3 h = reference::normalize(e.v + e.l);
          in.NoV.push_back(NoV), in.NoL.push_back(NoL), in.phi.push_back(phi);
          in.NoH.push_back(float(h.z)), in.VoH.push_back(float(reference::dot(e.v, h)));
          in.alpha.push_back(alpha), in.roughness.push_back(roughness);
          in.exact.push_back(e);
        }
  return in;
}

}  // namespace tessera::test

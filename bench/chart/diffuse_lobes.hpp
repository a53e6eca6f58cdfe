// What the two plots of the diffuse family share: sums over directions of light.
#pragma once
#include <string>
#include <vector>

#include "bench/chart/measure.hpp"
#include "reference/vector.hpp"

namespace tessera::chart {

/// A direction of light: integral f n.l dl = sum of weight f.
struct DiffuseSample {
  reference::Vec3 v, l;
  double weight;
};

/// 2 order heights (n.l) by 2 order azimuths, azimuth innermost, for n.v = mu. Cut where diffuse lobes have kinks: a
/// quarter turn from v in azimuth, and at the height `cut`, which should be mu.
std::vector<DiffuseSample> hemisphere(double mu, int order, double cut);

double albedo_of(const std::vector<DiffuseSample>& samples, const std::vector<double>& f);

/// Largest, mean and rms of these errors themselves.
Error error_of(const std::vector<double>& values);

/// Light shared between a specular and a diffuse lobe.
Plot measure_split(Session& session);

}  // namespace tessera::chart

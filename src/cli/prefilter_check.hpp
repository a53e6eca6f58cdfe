// How far an environment's prefiltered levels are from brute force, for whoever baked one or charts the baking.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "precompute/cube.hpp"
#include "reference/environment.hpp"

namespace tessera::cli {

struct LevelError {
  int level, size;
  double roughness;
  std::size_t texels;   // that were compared
  double rms, largest;  // over them and the three channels; in units of the level's own RMS
  double seam;          // the RMS step across edges of the cube, of that from the edges to the next texels inside
};

/// Each level but the sharpest against reference::CubeSum over level 0. texels: how many of a level, evenly from all
/// over the cube (0: all). curve: EnvironmentView::lod_curve.
std::vector<LevelError> check_prefilter(const Cube& cube, float curve, std::size_t texels, const Kernels& kernels);

/// The six faces as ground truth takes them.
reference::SpherePicture as_sphere(const CubeLevel& level);

/// The brightest texel of level 0 as a multiple of the median; by luminance.
double brightest_over_median(const Cube& cube, const Kernels& kernels);

/// As a table for a person.
std::string table_of(const std::vector<LevelError>& errors);

}  // namespace tessera::cli

// Where the samples of a pixel are.
#pragma once
#include "kernels/interface.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// The standard patterns of Direct3D 11 (D3D11_STANDARD_MULTISAMPLE_PATTERN) and Vulkan (standardSampleLocations), in
/// their order. They lie on a grid of 1/16 pixel. Counts other than 1, 2, 4, 8 and 16 give one sample in the centre.
inline SamplePattern standard_pattern(int samples) {
  constexpr std::int8_t grid[4][max_samples][2] = {
      // 1/16 pixel from the top-left corner
      {{12, 12}, {4, 4}},
      {{6, 2}, {14, 6}, {2, 10}, {10, 14}},
      {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}},
      {{9, 9},
       {7, 5},
       {5, 10},
       {12, 7},
       {3, 6},
       {10, 13},
       {13, 11},
       {11, 3},
       {6, 14},
       {8, 1},
       {4, 2},
       {2, 12},
       {0, 8},
       {15, 4},
       {14, 15},
       {1, 0}},
  };
  SamplePattern pattern{};
  const int row = samples == 2 ? 0 : samples == 4 ? 1 : samples == 8 ? 2 : samples == 16 ? 3 : -1;
  if (row < 0) {
    pattern.count = 1;
    pattern.x[0] = pattern.y[0] = 128;
    return pattern;
  }
  pattern.count = samples;
  for (int s = 0; s < samples; ++s) {
    pattern.x[s] = grid[row][s][0] * 16;
    pattern.y[s] = grid[row][s][1] * 16;
  }
  return pattern;
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// A furnace seen: spheres, and a map of what is missing.
#pragma once
#include <string>
#include <vector>

#include "kernels/interface.hpp"

namespace tessera::cli {

/// Reflected light by roughness and NoV; the furnace's own light is 1.
struct FurnaceGrid {
  std::vector<double> roughness;  // rows
  std::vector<double> NoV;        // columns, ascending, the last 1
  std::vector<double> albedo;     // row by row

  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return albedo[row * NoV.size() + column]; }
  /// Linear between the columns.
  [[nodiscard]] double at_cosine(std::size_t row, double mu) const;
};

/// One sphere per roughness on the furnace's own light, shown as a middle grey so that a gain shows too: what conserves
/// energy is invisible. Below, a map: NoV from 0 to 1 across, a band per roughness from the top; white within 1e-3 of
/// the furnace, blue darker, red brighter, full colour at a difference of 1. A PNG; throws Error(output).
void write_furnace_picture(const std::string& path, const FurnaceGrid& grid, int sphere_size, const Kernels& kernels);

}  // namespace tessera::cli

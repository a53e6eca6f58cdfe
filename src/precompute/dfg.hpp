// The environment BRDF as a table over (n.v, perceptual roughness).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera {

/// As DfgView stores a number: the nearest one that can be.
inline std::int16_t dfg_number(double x) {
  return std::int16_t(std::clamp(std::round((x - dfg_middle) / dfg_step), -32768.0, 32767.0));
}

struct DfgTable {
  AlignedVector<std::int16_t> nodes;  // as DfgView has them
  int size = 0;
  bool warped = false;

  /// From size x size pairs, size >= 2.
  DfgTable(const float* pairs, int size, bool warped = false);
  [[nodiscard]] DfgView view() const { return {nodes.data(), size, warped}; }
  /// The pair at column i of row j.
  [[nodiscard]] std::array<double, 2> node(int i, int j) const;
};

inline DfgTable::DfgTable(const float* pairs, int table_size, bool on_warped_axes)
    : size(table_size), warped(on_warped_axes) {
  const int pitch = dfg_pitch(size);
  nodes.reserve(std::size_t(pitch) * std::size_t(pitch) * dfg_node_shorts);
  const auto number = [&](int i, int j, int c) {
    const int row = std::clamp(j - 1, 0, size - 1), column = std::clamp(i - 1, 0, size - 1);
    return dfg_number(double(pairs[std::size_t(row * size + column) * 2 + std::size_t(c)]));
  };
  for (int j = 0; j < pitch; ++j)
    for (int i = 0; i < pitch; ++i)
      for (int c = 0; c < 2; ++c)
        for (const int row : {j, j + 1}) nodes.push_back(number(i, row, c));
}

inline std::array<double, 2> DfgTable::node(int i, int j) const {
  const std::int16_t* numbers = nodes.data() + std::size_t((j + 1) * dfg_pitch(size) + i + 1) * dfg_node_shorts;
  return {numbers[0] * dfg_step + dfg_middle, numbers[2] * dfg_step + dfg_middle};
}

/// A and B at the nodes of linear axes: size x size pairs, size >= 2.
AlignedVector<float> dfg_pairs(const Kernels& kernels, int size = 128);

/// size >= 2. At 128 the nodes are within 2e-5 of the integral. Elsewhere the linear axes are the limit: at most 2e-4
/// (mean 2e-5) for n.v and r from 0.1 up, 4e-3 beyond the last node (r > 0.996), 2e-2 below 0.02, and 8e-2 at r < 0.03
/// where n.v < 0.002 is off the table.
DfgTable build_dfg_table(const Kernels& kernels, int size = 128);

/// The same on warped axes: at 128 within 1e-4 everywhere, between the nodes too. What the renderer uses.
DfgTable build_warped_dfg_table(const Kernels& kernels, int size = 128);

}  // namespace tessera

#include "precompute/dfg_variants.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/parallel.hpp"
#include "kernels/terms.hpp"
#include "precompute/dfg.hpp"

namespace tessera {
namespace {

struct Node {
  double NoV, roughness;
};

// The inverse of the lookup's axes.
Node node_of(DfgAxes axes, int i, int j, int size) {
  if (axes == DfgAxes::linear) return {(i + 0.5) / size, (j + 0.5) / size};
  const double u = double(i) / (size - 1), v = double(j) / (size - 1);
  if (axes == DfgAxes::root) return {u * u, v * v};
  // u = s (1 + q) / (s + q), q = 2 r. At r = 0 the limit: functions of NoV / alpha.
  const double q = 2 * std::max(v * v, 1e-3), s = u * q / (1 + q - u);
  return {s * s, v * v};
}

// One plane of nodes per channel.
struct Nodes {
  std::vector<float> channel[2];
};

Nodes evaluate_nodes(const Kernels& kernels, DfgAxes axes, int size) {
  const auto n = std::size_t(size);
  Nodes nodes;
  for (auto& plane : nodes.channel) plane.resize(n * n);
  const Term<float>& integral = *find_term(kernels.terms, "dfg_integral");
  parallel_for(n, [&](std::size_t row) {
    std::vector<float> NoV(n), roughness(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Node node = node_of(axes, int(i), int(row), size);
      NoV[i] = float(node.NoV);
      roughness[i] = float(node.roughness);
    }
    float *a = nodes.channel[0].data() + row * n, *b = nodes.channel[1].data() + row * n;
    integral.run({{NoV.data(), roughness.data()}, {a, b}, n, nullptr, 0});
    if (axes != DfgAxes::warped) return;
    for (std::size_t i = 0; i < n; ++i) {
      const float m = 1 - NoV[i], m2 = m * m, loss = std::max(1 - (a[i] + b[i]), 0.0f), drop = m2 * m2 * m - b[i];
      a[i] = loss;
      b[i] = drop;
    }
  });
  return nodes;
}

// Second difference along one axis; at the ends that of the neighbour.
void subtract_curvature(const std::vector<float>& from, std::vector<float>& nodes, int size) {
  const auto at = [&](int i, int j) { return from[std::size_t(j) * std::size_t(size) + std::size_t(i)]; };
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const int x = std::clamp(i, 1, size - 2), y = std::clamp(j, 1, size - 2);
      const float along = at(x - 1, j) - 2 * at(x, j) + at(x + 1, j),
                  across = at(i, y - 1) - 2 * at(i, y) + at(i, y + 1);
      nodes[std::size_t(j) * std::size_t(size) + std::size_t(i)] -= (along + across) * (1.0f / 16);
    }
}

}  // namespace

DfgVariant build_dfg_variant(const Kernels& kernels, DfgAxes axes, DfgFormat format, int size, bool balanced) {
  Nodes nodes = evaluate_nodes(kernels, axes, size);
  if (balanced && size > 2)
    for (auto& plane : nodes.channel) subtract_curvature(std::vector<float>(plane), plane, size);
  const auto &a = nodes.channel[0], &b = nodes.channel[1];
  DfgVariant table;
  table.size = size;
  const std::size_t words = format == DfgFormat::float32 ? 2 : 1;
  table.words.resize(words * a.size());
  table.bytes = 4 * table.words.size();
  if (format == DfgFormat::float32) {
    for (std::size_t k = 0; k < a.size(); ++k) table.words[2 * k] = a[k], table.words[2 * k + 1] = b[k];
  } else {
    std::vector<std::uint16_t> low(a.size()), high(a.size());
    if (format == DfgFormat::half) {
      kernels.pack_half(a.data(), low.data(), a.size());
      kernels.pack_half(b.data(), high.data(), b.size());
    } else {
      const auto unorm16 = [](float x) { return std::uint16_t(dfg_number(double(x)) + 32768); };
      for (std::size_t k = 0; k < a.size(); ++k) low[k] = unorm16(a[k]), high[k] = unorm16(b[k]);
    }
    for (std::size_t k = 0; k < a.size(); ++k)
      table.words[k] = std::bit_cast<float>(std::uint32_t(low[k]) | std::uint32_t(high[k]) << 16);
  }
  return table;
}

}  // namespace tessera

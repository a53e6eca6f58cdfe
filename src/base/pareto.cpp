#include "base/pareto.hpp"

#include <algorithm>
#include <cmath>

namespace tessera {

std::vector<std::size_t> pareto_frontier(const std::vector<Tradeoff>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isfinite(points[i].cost) && !std::isnan(points[i].error)) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (points[a].cost != points[b].cost) return points[a].cost < points[b].cost;
    if (points[a].error != points[b].error) return points[a].error < points[b].error;
    return a < b;
  });
  // Walking towards dearer points, only a smaller error than all before is worth its price.
  std::vector<std::size_t> frontier;
  for (const std::size_t i : order) {
    const bool first = frontier.empty();
    const Tradeoff& best = points[first ? i : frontier.back()];
    if (first || points[i].error < best.error || (points[i].error == best.error && points[i].cost == best.cost))
      frontier.push_back(i);
  }
  return frontier;
}

}  // namespace tessera

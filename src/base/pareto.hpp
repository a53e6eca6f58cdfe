// Which methods are worth having: those that no other beats in both cost and error.
#pragma once
#include <cstddef>
#include <vector>

namespace tessera {

struct Tradeoff {
  double cost, error;
};

/// Indices of the points that no other point dominates (at most as dear and at most as wrong, and better in one of the
/// two), cheapest first. Of equal points all are kept. Points with a cost or an error that is no number take no part.
std::vector<std::size_t> pareto_frontier(const std::vector<Tradeoff>& points);

}  // namespace tessera

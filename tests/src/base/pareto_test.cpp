#include "base/pareto.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tessera {
namespace {

TEST(Pareto, KeepsWhatNothingBeatsCheapestFirst) {
  const std::vector<Tradeoff> points = {{4, 1}, {1, 9}, {3, 3}, {2, 9}, {5, 1}, {3, 4}};
  EXPECT_EQ(pareto_frontier(points), (std::vector<std::size_t>{1, 2, 0}));
}

TEST(Pareto, EqualPointsAllStay) { EXPECT_EQ(pareto_frontier({{1, 1}, {1, 1}}).size(), 2u); }

TEST(Pareto, WhatIsNoNumberTakesNoPart) {
  EXPECT_EQ(pareto_frontier({{NAN, 0}, {1, NAN}, {2, 1}}), (std::vector<std::size_t>{2}));
  EXPECT_TRUE(pareto_frontier({}).empty());
}

TEST(Pareto, AgreesWithTheDefinition) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> draw(0, 12);  // few values, so that ties are common
  for (int round = 0; round < 200; ++round) {
    std::vector<Tradeoff> points;
    for (int i = 0; i < 15; ++i) points.push_back({double(draw(random)), double(draw(random))});
    const std::vector<std::size_t> frontier = pareto_frontier(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool beaten = false;
      for (const Tradeoff& other : points)
        beaten = beaten || (other.cost <= points[i].cost && other.error <= points[i].error &&
                            (other.cost < points[i].cost || other.error < points[i].error));
      EXPECT_EQ(std::count(frontier.begin(), frontier.end(), i), beaten ? 0 : 1);
    }
  }
}

}  // namespace
}  // namespace tessera

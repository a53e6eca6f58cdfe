// The search on knobs whose costs and errors are known, against trying everything.
#include "frame/knob_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace tessera {
namespace {

// Each choice of each knob adds to cost and error.
struct Model {
  std::vector<std::vector<double>> cost, error;

  [[nodiscard]] double sum(const std::vector<std::vector<double>>& table, const KnobChoice& choice) const {
    double all = 0;
    for (std::size_t k = 0; k < choice.size(); ++k) all += table[k][static_cast<std::size_t>(choice[k])];
    return all;
  }
  [[nodiscard]] KnobSearch search_of() const {
    KnobSearch s;
    for (const std::vector<double>& knob : cost) s.choices.push_back(static_cast<int>(knob.size()));
    s.rounds = 3;
    s.error = [this](const KnobChoice& c) { return PictureError{sum(error, c), 2 * sum(error, c)}; };
    s.cost = [this](const KnobChoice& c) { return sum(cost, c); };
    return s;
  }
};

TEST(KnobSearch, FindsTheCheapestOfAll) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> price(1, 40), wrong(0, 40), length(1, 4);
  for (int trial = 0; trial < 200; ++trial) {
    Model model;
    std::vector<KnobChoice> all = {{}};
    for (int knob = 0; knob < 3; ++knob) {
      const int count = length(random);
      model.cost.emplace_back();
      model.error.emplace_back();
      for (int k = 0; k < count; ++k) {
        model.cost.back().push_back(price(random));
        model.error.back().push_back(k == 0 ? 0 : wrong(random));
      }
      std::vector<KnobChoice> longer;
      for (const KnobChoice& c : all)
        for (int k = 0; k < count; ++k) {
          longer.push_back(c);
          longer.back().push_back(k);
        }
      all = longer;
    }
    const std::vector<KnobPoint> points = search(model.search_of());
    ASSERT_EQ(points.at(0).choice, KnobChoice(3, 0));
    for (const double limit : {0.0, 5.0, 17.0, 60.0, 200.0}) {
      double least = 1e9;
      for (const KnobChoice& c : all)
        if (model.sum(model.error, c) <= limit) least = std::min(least, model.sum(model.cost, c));
      const KnobPoint& chosen = points[cheapest_within(points, {limit, 1e9})];
      EXPECT_LE(chosen.error.mean, limit);
      EXPECT_LE(chosen.cost, least * 1.02);
      EXPECT_EQ(chosen.cost, model.sum(model.cost, chosen.choice));
    }
    for (const KnobPoint& p : points) {
      bool beaten = false;
      for (const KnobChoice& c : all) {
        const double cost = model.sum(model.cost, c), error = model.sum(model.error, c);
        beaten |= cost <= p.cost && error <= p.error.mean && (cost < p.cost || error < p.error.mean);
      }
      EXPECT_EQ(p.frontier, !beaten);
    }
  }
}

TEST(KnobSearch, MeasuresOnceForErrorAndTakesTurnsForCost) {
  Model model{{{9, 5}, {4, 3}}, {{0, 1}, {0, 2}}};
  KnobSearch s = model.search_of();
  s.besides = {{1, 1}};
  std::map<KnobChoice, int> asked;
  std::vector<KnobChoice> timed;
  std::size_t last = 0;
  int stages = 0;
  s.error = [&](const KnobChoice& c) {
    ++asked[c];
    return PictureError{model.sum(model.error, c), 0};
  };
  s.cost = [&](const KnobChoice& c) {
    timed.push_back(c);
    return model.sum(model.cost, c);
  };
  s.progress = [&](bool, std::size_t done, std::size_t total) {
    stages += done == 1;
    EXPECT_EQ(done, done == 1 ? 1 : last + 1);
    EXPECT_LE(done, total);
    last = done;
  };
  EXPECT_EQ(search(s).size(), 4u);
  EXPECT_EQ(stages, 2);
  for (const auto& [choice, count] : asked) EXPECT_EQ(count, 1);
  ASSERT_EQ(timed.size(), 2u * 3u * 4u);
  for (std::size_t i = 0; i < timed.size(); ++i) EXPECT_EQ(timed[i], timed[i % 4]);
}

TEST(KnobSearch, AnOutlierDoesNotMoveTheMedian) {
  Model model{{{10, 8}}, {{0, 1}}};
  KnobSearch s = model.search_of();
  int frame = 0;
  s.cost = [&](const KnobChoice& c) { return model.sum(model.cost, c) * (++frame % 5 == 0 ? 100 : 1); };
  const std::vector<KnobPoint> points = search(s);
  EXPECT_EQ(points[0].cost, 10);
  EXPECT_EQ(points[1].cost, 8);
}

TEST(CheapestWithin, TakesTheNearestOfThoseThatCostTheSame) {
  const std::vector<KnobPoint> points = {{{0}, {0, 0}, 100, false},
                                         {{1}, {3, 9}, 50, false},
                                         {{2}, {2, 30}, 50.9, false},
                                         {{3}, {1, 9}, 51.1, false},
                                         {{4}, {9, 99}, 10, false}};
  EXPECT_EQ(cheapest_within(points, {5, 255}), 2u);  // 1.8 % dearer than the cheapest, and nearer
  EXPECT_EQ(cheapest_within(points, {5, 10}), 1u);   // 51.1 is 2.2 % dearer
  EXPECT_EQ(cheapest_within(points, {2.5, 10}), 3u);
  EXPECT_EQ(cheapest_within(points, {0.5, 255}), 0u);
  EXPECT_EQ(cheapest_within(points, {255, 255}), 4u);
}

}  // namespace
}  // namespace tessera

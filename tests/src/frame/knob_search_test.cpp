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

TEST(KnobSearch, OutliersDoNotMoveTheCost) {
  Model model{{{10, 8}}, {{0, 1}}};
  KnobSearch s = model.search_of();
  int frame = 0;
  s.cost = [&](const KnobChoice& c) { return model.sum(model.cost, c) * (++frame % 5 == 0 ? 100 : 1); };
  const std::vector<KnobPoint> points = search(s);
  EXPECT_EQ(points[0].cost, 10);
  EXPECT_EQ(points[1].cost, 8);
}

// Many knobs whose costs multiply and whose errors add up, as the forecast has it, and somewhat otherwise.
TEST(KnobSearch, OfMoreThanItMayMeasureItFindsNearlyTheBest) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<std::vector<double>> factor, error;
    for (int knob = 0; knob < 8; ++knob) {
      factor.push_back({1});
      error.push_back({0});
      for (int k = 1; k < 3; ++k) {
        factor.back().push_back(factor.back().back() * (0.5 + 0.4 * uniform(random)));
        error.back().push_back(error.back().back() + uniform(random));
      }
    }
    const auto cost = [&](const KnobChoice& c) {
      double product = 50, bent = 0;
      for (std::size_t k = 0; k < c.size(); ++k) product *= factor[k][std::size_t(c[k])], bent += c[k];
      return product + 0.05 * bent;
    };
    const auto wrong = [&](const KnobChoice& c) {
      double sum = 0;
      for (std::size_t k = 0; k < c.size(); ++k) sum += error[k][std::size_t(c[k])];
      return sum * (0.9 + 0.1 / (1 + sum));
    };
    KnobSearch s;
    s.choices.assign(8, 3);
    s.most = 60;
    std::size_t asked = 0;
    s.error = [&](const KnobChoice& c) {
      ++asked;
      return PictureError{wrong(c), 0};
    };
    s.cost = cost;
    for (const double limit : {1.0, 2.5, 5.0}) {
      s.limit = limit;
      asked = 0;
      const std::vector<KnobPoint> points = search(s);
      EXPECT_EQ(asked, points.size());
      EXPECT_LE(points.size(), 17u + 60u);
      double least = 1e9;
      KnobChoice c(8, 0);
      for (int i = 0; i < 6561; ++i) {
        for (int k = 0, rest = i; k < 8; ++k, rest /= 3) c[std::size_t(k)] = rest % 3;
        if (wrong(c) <= limit) least = std::min(least, cost(c));
      }
      EXPECT_LE(points[cheapest_within(points, {limit, 1e9})].cost, least * 1.25) << trial << " " << limit;
    }
  }
}

TEST(ClearFrontier, LeavesOutWhatIsHardlyCheaper) {
  std::vector<KnobPoint> points = {{{0}, {0, 0}, 100, true},  {{1}, {1, 0}, 99, true}, {{2}, {2, 0}, 97, true},
                                   {{3}, {3, 0}, 96, true},   {{4}, {3, 0}, 96, true}, {{5}, {4, 0}, 10, true},
                                   {{6}, {9, 0}, 500, false}, {{7}, {5, 0}, 9.9, true}};
  EXPECT_EQ(clear_frontier(points), (std::vector<std::size_t>{5, 2, 0}));
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

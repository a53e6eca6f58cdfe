#include "chart/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tessera::chart {
namespace {

std::vector<std::string> labels_of(const LogAxis& axis, int most = 8) {
  std::vector<std::string> labels;
  for (const Tick& tick : axis.ticks(most))
    if (tick.major) labels.push_back(tick.label);
  return labels;
}

TEST(LogAxis, PutsDecadesAtEqualDistances) {
  const LogAxis axis{-2, 2, 100, 500};
  EXPECT_DOUBLE_EQ(axis.at(0.01), 100);
  EXPECT_DOUBLE_EQ(axis.at(1), 300);
  EXPECT_DOUBLE_EQ(axis.at(100), 500);
  const LogAxis upwards{0, 1, 400, 0};  // as y does
  EXPECT_DOUBLE_EQ(upwards.at(10), 0);
}

TEST(LogAxis, LabelsDecadesAndOnAShortAxisTwosAndFives) {
  EXPECT_EQ(labels_of({-3, 0, 0, 1}), (std::vector<std::string>{"0.001", "0.01", "0.1", "1"}));
  EXPECT_EQ(labels_of({-0.1, 1.1, 0, 1}), (std::vector<std::string>{"1", "2", "5", "10"}));
  EXPECT_EQ(labels_of({-8, -5, 0, 1}), (std::vector<std::string>{"10⁻⁸", "10⁻⁷", "10⁻⁶", "10⁻⁵"}));
}

TEST(LogAxis, LabelsNoMoreThanAsked) {
  EXPECT_LE(labels_of({-12, 3, 0, 1}, 8).size(), 9u);
  EXPECT_LE(labels_of({-12, 3, 0, 1}, 3).size(), 4u);
}

TEST(LogAxis, TicksLieOnTheAxisAndAscend) {
  const LogAxis axis{-2.4, 1.7, 0, 1};
  double last = 0;
  for (const Tick& tick : axis.ticks()) {
    EXPECT_GE(std::log10(tick.value), axis.low - 1e-6);
    EXPECT_LE(std::log10(tick.value), axis.high + 1e-6);
    EXPECT_GT(tick.value, last);
    last = tick.value;
  }
}

TEST(LogAxis, HoldsAllValuesWithRoom) {
  const LogAxis axis = axis_over({0.002, 5, 0, NAN, INFINITY, -1}, 1, 0.1, 0, 100);
  EXPECT_GT(axis.at(0.002), 5);
  EXPECT_LT(axis.at(5), 95);
  const LogAxis one = axis_over({3}, 1, 0, 0, 100);  // a single value is in the middle of its decade
  EXPECT_NEAR(one.at(3), 50, 1e-9);
  EXPECT_NEAR(one.high - one.low, 1, 1e-12);
  const LogAxis none = axis_over({}, 1, 0, 0, 100);
  EXPECT_TRUE(std::isfinite(none.at(1)));
}

TEST(TickLabel, IsPlainInTheMiddleAndAPowerOutside) {
  EXPECT_EQ(tick_label(0.002), "0.002");
  EXPECT_EQ(tick_label(1e4), "10000");
  EXPECT_EQ(tick_label(1e-7), "10⁻⁷");
  EXPECT_EQ(tick_label(2e-7), "2·10⁻⁷");
  EXPECT_EQ(tick_label(1e12), "10¹²");
}

}  // namespace
}  // namespace tessera::chart

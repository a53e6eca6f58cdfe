#include "chart/labels.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tessera::chart {
namespace {

// Whether two lines have a point in common, by solving for it.
bool meet(const Segment& a, const Segment& b) {
  const double ax = a.x1 - a.x0, ay = a.y1 - a.y0, bx = b.x1 - b.x0, by = b.y1 - b.y0;
  const double determinant = ax * by - ay * bx, dx = b.x0 - a.x0, dy = b.y0 - a.y0;
  if (determinant == 0) return false;
  const double along_a = (dx * by - dy * bx) / determinant, along_b = (dx * ay - dy * ax) / determinant;
  return along_a > 0 && along_a < 1 && along_b > 0 && along_b < 1;
}

// What no placement may violate.
void expect_clear(const LabelScene& scene, const std::vector<LabelRequest>& requests,
                  const std::vector<Label>& labels) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!labels[i].placed) continue;
    EXPECT_TRUE(scene.bounds.contains(labels[i].box));
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(labels[k].placed && labels[i].box.overlaps(labels[k].box)) << i << " " << k;
    for (const LabelRequest& r : requests)
      EXPECT_FALSE(labels[i].box.overlaps({r.x - r.radius, r.y - r.radius, r.x + r.radius, r.y + r.radius}));
    for (const Rect& obstacle : scene.obstacles) EXPECT_FALSE(labels[i].box.overlaps(obstacle));
    for (const Label& other : labels)
      if (other.placed && other.leader && &other != &labels[i]) {
        EXPECT_FALSE(crosses(other.line, labels[i].box));
        EXPECT_FALSE(labels[i].leader && meet(other.line, labels[i].line));
      }
  }
}

TEST(Labels, OneAloneGoesToTheRight) {
  const LabelScene scene{{0, 0, 400, 200}, {}, {}};
  const std::vector<LabelRequest> requests = {{100, 100, 5, {{0, 0, 80, 14}}}};
  const std::vector<Label> labels = place_labels(scene, requests);
  ASSERT_TRUE(labels[0].placed);
  EXPECT_GT(labels[0].box.x0, 105);
  EXPECT_LT(labels[0].box.x0, 115);
  EXPECT_NEAR((labels[0].box.y0 + labels[0].box.y1) / 2, 100, 1);
  EXPECT_FALSE(labels[0].leader);
}

TEST(Labels, NeverCollideInACrowd) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(20, 780), y(20, 380), width(40, 190);
  for (int round = 0; round < 30; ++round) {
    const LabelScene scene{{0, 0, 800, 400}, {{0, 350, 90, 400}}, {{0, 0, 800, 400}}};
    std::vector<LabelRequest> requests;
    for (int i = 0; i < 24; ++i)
      requests.push_back({x(random), y(random), 7, {{0, 0, width(random), 15}, {0, 0, 16, 15}}});
    const std::vector<Label> labels = place_labels(scene, requests);
    expect_clear(scene, requests, labels);
    int placed = 0;
    for (const Label& label : labels) placed += label.placed ? 1 : 0;
    EXPECT_GE(placed, 22) << round;
  }
}

TEST(Labels, FallBackToTheShorterWording) {
  const LabelScene scene{{0, 0, 60, 40}, {}, {}};
  const std::vector<Label> labels = place_labels(scene, {{20, 20, 5, {{0, 0, 200, 14}, {0, 0, 12, 14}}}});
  ASSERT_TRUE(labels[0].placed);
  EXPECT_EQ(labels[0].choice, 1u);
}

TEST(Labels, AreLeftOutWhereThereIsNoRoom) {
  const LabelScene scene{{0, 0, 60, 40}, {{0, 0, 60, 40}}, {}};
  EXPECT_FALSE(place_labels(scene, {{20, 20, 5, {{0, 0, 12, 14}}}})[0].placed);
}

TEST(Labels, CoincidentPointsBothGetOne) {
  const LabelScene scene{{0, 0, 400, 200}, {}, {}};
  const std::vector<LabelRequest> requests = {{100, 100, 5, {{0, 0, 60, 14}}}, {100, 100, 5, {{0, 0, 60, 14}}}};
  const std::vector<Label> labels = place_labels(scene, requests);
  EXPECT_TRUE(labels[0].placed && labels[1].placed);
  expect_clear(scene, requests, labels);
}

TEST(Crosses, SeesLinesThroughAndPast) {
  const Rect rect{10, 10, 20, 20};
  EXPECT_TRUE(crosses({0, 0, 30, 30}, rect));
  EXPECT_TRUE(crosses({15, 0, 15, 30}, rect));
  EXPECT_TRUE(crosses({12, 12, 14, 13}, rect));
  EXPECT_FALSE(crosses({0, 20, 15, 35}, rect));
  EXPECT_FALSE(crosses({0, 0, 30, 5}, rect));
}

TEST(TextWidth, CountsCharactersNotBytes) {
  EXPECT_DOUBLE_EQ(text_width("10⁻⁷", 10), text_width("1000", 10));
  EXPECT_GT(text_width("mmm", 10), text_width("iii", 10));
}

}  // namespace
}  // namespace tessera::chart

#include "chart/frontier_plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace tessera::chart {
namespace {

struct Circle {
  double x, y, r;
};

std::vector<Circle> circles(const std::string& svg, const std::string& cls) {
  std::vector<Circle> found;
  const std::string begin = "<circle class=\"" + cls + "\" ";
  for (std::size_t at = svg.find(begin); at != std::string::npos; at = svg.find(begin, at + 1)) {
    Circle c{};
    if (std::sscanf(svg.c_str() + at + begin.size(), "cx=\"%lf\" cy=\"%lf\" r=\"%lf\"/>", &c.x, &c.y, &c.r) == 3)
      found.push_back(c);
  }
  return found;
}

FrontierPlot plot() {
  FrontierPlot p{"cost: ms", "error: steps", 0.5, "E = 0.5", 1e-3, {}};
  p.points = {{100, 0, "exact <all>", ".", true, false, true},
              {10, 0.05, "ten", "B", true, true, false},
              {1, 0.5, "one", "A", true, false, false},
              {50, 5, "beaten", ".", false, false, false}};
  return p;
}

TEST(FrontierPlot, PointsStandWhereTheirLogarithmsSay) {
  const std::string svg = draw(plot(), {"title", "subtitle", {"caption"}});
  // Dominated ones are drawn first; the legend's three come last.
  const std::vector<Circle> dots = circles(svg, "dot");
  ASSERT_EQ(dots.size(), 4u + 3u);
  const Circle &beaten = dots[0], &exact = dots[1], &ten = dots[2], &one = dots[3];
  EXPECT_NEAR(exact.x - ten.x, ten.x - one.x, 0.02);
  EXPECT_NEAR((beaten.x - one.x) / (exact.x - one.x), std::log10(50) / 2, 1e-3);
  EXPECT_NEAR(one.y - beaten.y, ten.y - one.y, 0.02);  // decades, upwards
  EXPECT_GT(exact.y, ten.y);
  EXPECT_LT(beaten.r, ten.r);
  const std::vector<Circle> rings = circles(svg, "chosen-ring");
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_EQ(rings[0].x, ten.x);
  EXPECT_EQ(rings[0].y, ten.y);
  // The limit is as high as the point that meets it.
  const std::size_t limit = svg.find("class=\"limit\"");
  ASSERT_NE(limit, std::string::npos);
  double y = 0;
  ASSERT_EQ(std::sscanf(svg.c_str() + limit, "class=\"limit\" d=\"M%*f %lfL", &y), 1);
  EXPECT_NEAR(y, one.y, 0.01);
}

TEST(FrontierPlot, NamesAreThereAndEscaped) {
  const std::string svg = draw(plot(), {"a & b", "<s>", {"caption"}});
  for (const char* words : {"exact &lt;all&gt;", ">ten<", ">one<", "E = 0.5", "a &amp; b", "&lt;s&gt;", "cost: ms",
                            "error: steps", ">exact<", "caption"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  EXPECT_EQ(svg.find("<all>"), std::string::npos);
  EXPECT_EQ(svg.find(">beaten<"), std::string::npos);  // only as a tooltip
  EXPECT_NE(svg.find("beaten: cost"), std::string::npos);
  EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
}

TEST(FrontierPlot, OnePointAndNoLimitWillDo) {
  FrontierPlot p = plot();
  p.points.resize(1);
  p.limit = 0;
  const std::string svg = draw(p, {});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("class=\"limit\""), std::string::npos);
}

TEST(Staircase, LeadsFromPointToPoint) {
  const std::vector<Segment> s = staircase({{30, 40}, {10, 20}}, 0, 99);
  ASSERT_EQ(s.size(), 4u);
  EXPECT_EQ(path_of(s), "M10 0L10 20L10 20L30 20L30 20L30 40L30 40L99 40");
  EXPECT_TRUE(staircase({}, 0, 99).empty());
}

}  // namespace
}  // namespace tessera::chart

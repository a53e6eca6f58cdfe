// What the scaling program measures with: its mesh, its straight lines, its charts.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "bench/scaling/fit.hpp"
#include "bench/scaling/series_plot.hpp"
#include "bench/scaling/sphere_mesh.hpp"

namespace tessera::scaling {
namespace {

TEST(SphereMesh, HasAboutAsManyTrianglesAsWantedAndTheirFrontsOutside) {
  for (const std::size_t wanted : {10'000u, 200'000u}) {
    const workload::Mesh mesh = sphere_mesh(wanted);
    const GeometryView g = mesh.scene().geometry;
    EXPECT_NEAR(double(g.triangle_count), double(wanted), 0.15 * double(wanted));
    for (std::uint32_t i = 0; i < g.triangle_count; ++i) {
      double p[3][3], outwards[3] = {0, 0, 0};
      for (int k = 0; k < 3; ++k) {
        ASSERT_LT(g.triangles[i].vertex[k], g.vertex_count);
        const SurfaceVertex& v = g.surfaces[g.triangles[i].vertex[k]];
        for (int c = 0; c < 3; ++c) {
          p[k][c] = double(v.position[c]);
          outwards[c] += double(v.normal[c]);
          EXPECT_EQ(g.positions[3 * g.triangles[i].vertex[k] + std::uint32_t(c)], v.position[c]);
        }
      }
      double volume = 0, area2 = 0;  // (b - a) x (c - a), counter-clockwise from outside
      for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        const double n = (p[1][d] - p[0][d]) * (p[2][e] - p[0][e]) - (p[1][e] - p[0][e]) * (p[2][d] - p[0][d]);
        volume += n * outwards[c];
        area2 += n * n;
      }
      if (area2 < 1e-16) continue;  // at the poles
      ASSERT_GT(volume, 0) << i;
    }
  }
}

TEST(FitLine, FindsALineAndMindsRelativeErrors) {
  Series series{"", {}};
  for (const double x : {0.0, 1.0, 4.0, 100.0}) {
    Case c;
    c.x = x;
    c.time.median = 3 + 0.5 * x;
    series.cases.push_back(c);
  }
  LinearFit fit = fit_line(series);
  EXPECT_NEAR(fit.fixed, 3, 1e-9);
  EXPECT_NEAR(fit.each, 0.5, 1e-9);
  // Without the first.
  series.cases[0].time.median = 1000;
  fit = fit_line(series, 1);
  EXPECT_NEAR(fit.fixed, 3, 1e-9);
  // A tenth too much on the largest moves the small ones by little.
  series.cases[0].time.median = 3;
  series.cases[3].time.median *= 1.1;
  fit = fit_line(series);
  EXPECT_NEAR(fit.fixed, 3, 0.1);
}

TEST(SeriesPlot, PointsStandWhereTheirValuesSay) {
  SeriesPlot plot{"lights",
                  "ms",
                  "a line",
                  true,
                  {{"a <series>", {{0, 10, 9, 11}, {10, 20, 20, 20}, {20, 30, 30, 31}}, {{0, 10}, {20, 30}}}}};
  const std::string svg = draw(plot, {"title", "subtitle", {}});
  const std::regex dot("cx=\"([-0-9.]+)\" cy=\"([-0-9.]+)\" r=\"5.5\"><title>");
  std::vector<double> x, y;
  for (std::sregex_iterator it(svg.begin(), svg.end(), dot), end; it != end; ++it) {
    x.push_back(std::stod((*it)[1]));
    y.push_back(std::stod((*it)[2]));
  }
  ASSERT_EQ(x.size(), 3u);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.02);
  EXPECT_NEAR(y[0] - y[1], y[1] - y[2], 0.02);
  EXPECT_NE(svg.find("a &lt;series&gt;"), std::string::npos);
  EXPECT_NE(svg.find("20 ms"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  plot.linear = false;
  plot.series[0].points = {{1, 1, 1, 1}, {10, 10, 9, 11}, {100, 100, 100, 100}};
  plot.series[0].guide = {{1, 1}, {100, 100}};
  EXPECT_EQ(draw(plot, {}).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace tessera::scaling

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kernels/raster/camera.hpp"
#include "kernels/raster/oracle.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::raster_test {
namespace {

std::vector<ProjectedVertex> project(const Kernels& k, const ViewTransform& view, const std::vector<float>& positions) {
  // One more, to see that nothing is written past the end.
  std::vector<ProjectedVertex> out(positions.size() / 3 + 1, ProjectedVertex{7, 7, 7, 7});
  k.project_vertices(view, positions.data(), static_cast<std::uint32_t>(positions.size() / 3), out.data());
  EXPECT_EQ(out.back().flags, 7u) << k.isa;
  out.pop_back();
  return out;
}

TEST(Project, EqualsDoubleToTheNearestStepAndIsTheSameEverywhere) {
  Random random(1);
  for (const ViewTransform& view : {perspective(1920, 1080, 1500, 0.1f), orthographic(640, 480, 100, 1, 50),
                                    perspective(16384, 16384, 9000, 0.01f)}) {
    std::vector<float> positions;
    for (int i = 0; i < 3 * 5003; ++i) positions.push_back(random.real(-8, 8));
    const std::vector<ProjectedVertex> first = project(*runnable_kernels().front(), view, positions);
    int inside = 0, clipped = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      const ProjectedVertex& v = first[i];
      double p[4];
      const float(*rows[4])[4] = {&view.x, &view.y, &view.z, &view.w};
      for (int r = 0; r < 4; ++r) {
        const float* row = *rows[r];
        p[r] = row[0] * double{positions[3 * i]} + row[1] * double{positions[3 * i + 1]} +
               row[2] * double{positions[3 * i + 2]} + row[3];
      }
      const double x = p[0] / p[3] * 256, y = p[1] / p[3] * 256;
      // Within 1e-4 of a border either answer will do.
      const auto expect_flag = [&](std::uint32_t flag, double beyond, double size) {
        if (std::abs(beyond) > 1e-4 * size) {
          EXPECT_EQ((v.flags & flag) != 0, beyond > 0) << flag;
        }
      };
      expect_flag(outside_left, -p[0], view.width);
      expect_flag(outside_right, p[0] - view.width * p[3], view.width);
      expect_flag(outside_top, -p[1], view.height);
      expect_flag(outside_bottom, p[1] - view.height * p[3], view.height);
      expect_flag(outside_near, p[2] - p[3], 1);
      expect_flag(outside_far, -p[2], 1);
      EXPECT_EQ(v.flags & not_finite, 0u);
      const bool guarded = x > -(1 << 22) + 1 && x < (1 << 23) - 1 && y > -(1 << 22) + 1 && y < (1 << 23) - 1;
      if (p[2] > p[3] + 1e-4 || (!guarded && std::abs(x) > 8388610)) {
        EXPECT_NE(v.flags & needs_clip, 0u);
        ++clipped;
      } else if (p[2] < p[3] - 1e-4 && guarded) {
        EXPECT_EQ(v.flags & needs_clip, 0u);
        // Half a step, and the rounding of a row and a division in float.
        const double size = (std::abs(p[0]) + std::abs(double{view.x[0]} * 8) + view.width * 4) / p[3] * 256;
        EXPECT_NEAR(v.x, x, 0.5 + size * 0x1p-22);
        EXPECT_NEAR(v.y, y, 0.5 + size * 0x1p-22);
        EXPECT_NEAR(v.depth, p[2] / p[3], 1e-5);
        ++inside;
      }
    }
    EXPECT_GT(inside, 300);
    EXPECT_GT(clipped, 300);
    for (const Kernels* k : runnable_kernels()) {
      const std::vector<ProjectedVertex> out = project(*k, view, positions);
      EXPECT_TRUE(same_bits(out.data(), first.data(), out.size())) << k->isa;
    }
  }
}

TEST(Project, MarksWhatIsNotFinite) {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const float huge = std::numeric_limits<float>::max();
  for (const Kernels* k : runnable_kernels()) {
    const std::vector<ProjectedVertex> v = project(
        *k, perspective(640, 480, 500, 0.1f), {nan, 0, -1, 0, infinity, -1, 0, 0, -infinity, huge, 0, -1, 0, 0, -1});
    for (int i = 0; i < 4; ++i) EXPECT_NE(v[i].flags & not_finite, 0u) << k->isa << ' ' << i;
    EXPECT_EQ(v[4].flags, 0u) << k->isa;
    EXPECT_EQ(v[4].x, 320 * 256);
    EXPECT_EQ(v[4].y, 240 * 256);
  }
}

TEST(Project, WorksForEveryCount) {
  Random random(2);
  const ViewTransform view = perspective(640, 480, 500, 0.1f);
  std::vector<float> positions;
  for (int i = 0; i < 3 * 40; ++i) positions.push_back(random.real(-3, 1));
  for (const Kernels* k : runnable_kernels()) {
    const std::vector<ProjectedVertex> all = project(*k, view, positions);
    for (std::size_t n = 0; n <= 40; ++n) {
      const std::vector<ProjectedVertex> some = project(*k, view, {positions.begin(), positions.begin() + 3 * n});
      EXPECT_TRUE(same_bits(some.data(), all.data(), n)) << k->isa << ' ' << n;
    }
  }
}

}  // namespace
}  // namespace tessera::raster_test

#define TESSERA_ISA scalar_test
#include "kernels/raster/clip.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kernels/raster/camera.hpp"
#include "kernels/raster/oracle.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::raster_test {
namespace {

using Corners = std::array<std::array<float, 3>, 3>;

struct Clipped {
  std::vector<SetupTriangle> pieces;
  GeometryCounters counters{};
};

Clipped set_up(const Kernels& k, const ViewTransform& view, const Corners& corners, bool double_sided) {
  Clipped out;
  const Triangle triangle{{0, 1, 2}, 0};
  const std::uint8_t sided = double_sided ? 1 : 0;
  ProjectedVertex vertices[3];
  k.project_vertices(view, corners[0].data(), 3, vertices);
  out.pieces.resize(max_setup_per_triangle);
  out.pieces.resize(k.setup_triangles({{corners[0].data(), nullptr, &triangle, 3, 1},
                                       view,
                                       vertices,
                                       &sided,
                                       1,
                                       0,
                                       1,
                                       out.pieces.data(),
                                       &out.counters}));
  return out;
}

/// Where the ray of a point of the window meets the triangle, in homogeneous coordinates and double (Olano and Greer
/// 1997, "Triangle scan conversion using 2D homogeneous coordinates"): no clipping anywhere.
struct Hit {
  bool covered, front;
  double depth;
};
Hit meet(const ViewTransform& view, const Corners& corners, double px, double py) {
  double x[3], y[3], z[3], w[3];
  for (int i = 0; i < 3; ++i) {
    const auto row = [&](const float(&r)[4]) {
      return r[0] * double{corners[i][0]} + r[1] * double{corners[i][1]} + r[2] * double{corners[i][2]} + r[3];
    };
    w[i] = row(view.w), z[i] = row(view.z);
    x[i] = row(view.x) - px * w[i];
    y[i] = row(view.y) - py * w[i];
  }
  double b[3], sum_w = 0, sum_z = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    b[i] = x[j] * y[k] - x[k] * y[j];
    sum_w += b[i] * w[i];
    sum_z += b[i] * z[i];
  }
  const double sign = sum_w > 0 ? 1 : -1;
  const bool inside = b[0] * sign > 0 && b[1] * sign > 0 && b[2] * sign > 0;
  // sum_w is the determinant of (x, y, w): with y down, negative is counter-clockwise on the screen.
  return {inside && sum_z * sign <= sum_w * sign, sum_w < 0, sum_z / sum_w};
}

/// Pixels of a small window against meet(), except where moving the pixel by 2/256 changes the answer.
void expect_like_unclipped(const Kernels& k, const ViewTransform& view, const Corners& corners, bool double_sided,
                           int& covered_pixels) {
  const Clipped got = set_up(k, view, corners, double_sided);
  ASSERT_LE(got.pieces.size(), std::size_t{max_setup_per_triangle});
  for (const SetupTriangle& p : got.pieces) {
    ASSERT_GT(twice_area(p), 0);
    ASSERT_EQ(p.triangle, 0u);
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(p.x[i] >= -(1 << 22) && p.x[i] <= 1 << 23 && p.y[i] >= -(1 << 22) && p.y[i] <= 1 << 23);
    }
  }
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      int count = 0;
      double depth = 0, slope = 0;
      for (const SetupTriangle& p : got.pieces) {
        if (!covers(p, x * 256 + 128, y * 256 + 128)) continue;
        ++count;
        depth = depth_at(p, x * 256 + 128, y * 256 + 128);
        slope = std::abs(p.depth_dx) + std::abs(p.depth_dy);
      }
      ASSERT_LE(count, 1) << "covered twice";
      const Hit hit = meet(view, corners, x + 0.5, y + 0.5);
      bool clear = true;
      for (const double dx : {-2 / 256.0, 2 / 256.0})
        for (const double dy : {-2 / 256.0, 2 / 256.0}) {
          const Hit near = meet(view, corners, x + 0.5 + dx, y + 0.5 + dy);
          clear &= near.covered == hit.covered && near.front == hit.front;
        }
      if (!clear) continue;
      ASSERT_EQ(count == 1, hit.covered && (hit.front || double_sided)) << k.isa << " pixel " << x << ',' << y;
      if (count == 1) {
        ++covered_pixels;
        EXPECT_NEAR(depth, hit.depth, slope * 4 / 256 + 1e-4);
      }
    }
  }
}

TEST(Clip, TrianglesThroughTheNearPlaneAndBehindTheEye) {
  Random random(1);
  for (const Kernels* k : runnable_kernels()) {
    int covered = 0;
    for (int i = 0; i < 300; ++i) {
      Corners corners;
      for (auto& c : corners) c = {random.real(-3, 3), random.real(-3, 3), random.real(-6, 4)};
      expect_like_unclipped(*k, perspective(64, 48, 40, 0.5f), corners, i % 2 == 0, covered);
      if (HasFatalFailure()) FAIL() << i;
    }
    EXPECT_GT(covered, 10000);
  }
}

TEST(Clip, TrianglesAMillionPixelsWide) {
  Random random(2);
  for (const Kernels* k : runnable_kernels()) {
    int covered = 0;
    for (int i = 0; i < 300; ++i) {
      Corners corners;
      const auto far = [&] { return random.real(-1, 1) * (i % 3 == 0 ? 30000.0f : 2000.0f); };
      for (auto& c : corners) c = {far(), far(), random.real(-6, i % 2 == 0 ? -0.6 : 4)};
      expect_like_unclipped(*k, perspective(64, 48, 40, 0.5f), corners, true, covered);
      if (HasFatalFailure()) FAIL() << i;
    }
    EXPECT_GT(covered, 10000);
  }
}

TEST(Clip, OrthographicNearPlane) {
  Random random(3);
  for (const Kernels* k : runnable_kernels()) {
    int covered = 0;
    for (int i = 0; i < 100; ++i) {
      Corners corners;
      for (auto& c : corners) c = {random.real(-3, 3), random.real(-3, 3), random.real(-6, 2)};
      expect_like_unclipped(*k, orthographic(64, 48, 10, 1, 20), corners, true, covered);
      if (HasFatalFailure()) FAIL() << i;
    }
    EXPECT_GT(covered, 10000);
  }
}

TEST(Clip, CountsWhatIsClippedAndWhatIsBehind) {
  const ViewTransform view = perspective(64, 48, 40, 0.5f);
  for (const Kernels* k : runnable_kernels()) {
    const Clipped behind = set_up(*k, view, {{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}}, true);
    EXPECT_EQ(behind.counters.outside, 1u);
    EXPECT_EQ(behind.counters.clipped, 0u);
    const Clipped through = set_up(*k, view, {{{-1, -1, -2}, {1, -1, -2}, {0, 2, 2}}}, false);
    EXPECT_EQ(through.counters.clipped, 1u);
    EXPECT_EQ(through.counters.kept, 1u);
    EXPECT_EQ(through.pieces.size(), 2u);
    const Clipped back = set_up(*k, view, {{{1, -1, -2}, {-1, -1, -2}, {0, 2, 2}}}, false);
    EXPECT_EQ(back.counters.back_face, 1u);
    EXPECT_TRUE(back.pieces.empty());
  }
}

// A crack of one bit would be rounded away by snapping, nearly always: look before it.
TEST(Clip, BothTrianglesOfAnEdgeGetTheSameBits) {
  Random random(5);
  int cut = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto vertex = [&] {
      return scalar_test::PolygonVertex{
          random.real(-1e3, 1e3), random.real(-1e3, 1e3), 0.5, random.real(-3, 3), false, {}};
    };
    const scalar_test::PolygonVertex a = vertex(), b = vertex(), c = vertex(), d = vertex();
    if ((a.w < 0.5) == (b.w < 0.5)) continue;
    scalar_test::Polygon one{3, {a, b, c}}, other{3, {b, a, d}};
    scalar_test::clip_by_plane(0, one);
    scalar_test::clip_by_plane(0, other);
    // The point on a-b is the one that both have beside the inner end.
    int shared = 0;
    for (int j = 0; j < one.count; ++j)
      for (int k = 0; k < other.count; ++k) {
        const scalar_test::PolygonVertex &p = one.v[j], &q = other.v[k];
        shared += p.x == q.x && p.y == q.y && p.z == q.z && p.w == q.w;
      }
    ASSERT_EQ(shared, 2);
    ++cut;
  }
  EXPECT_GT(cut, 1000);
}

// Vertices far away, enormous, tiny, on the planes: nothing may go wrong, and all instruction sets agree.
TEST(Clip, IsTotalAndTheSameEverywhere) {
  Random random(4);
  for (int i = 0; i < 200000; ++i) {
    Corners corners;
    for (auto& c : corners)
      for (float& f : c) {
        const auto bits = static_cast<std::uint32_t>(random.next());
        if (i % 2 == 0) std::memcpy(&f, &bits, 4);
        if (i % 2 == 1)
          f = std::ldexp(random.real(-1, 1), random.between(-8, 20)) * (random.between(0, 5) == 0 ? 0.0f : 1.0f);
      }
    const ViewTransform view = i % 4 < 2 ? perspective(640, 480, 500, 0.5f) : orthographic(640, 480, 50, 1, 100);
    std::vector<SetupTriangle> first;
    for (const Kernels* k : runnable_kernels()) {
      const Clipped got = set_up(*k, view, corners, i % 3 == 0);
      if (k == runnable_kernels().front()) first = got.pieces;
      ASSERT_EQ(got.pieces.size(), first.size());
      ASSERT_TRUE(same_bits(got.pieces.data(), first.data(), first.size())) << k->isa;
      for (const SetupTriangle& p : got.pieces) {
        ASSERT_GT(twice_area(p), 0);
        ASSERT_TRUE(p.depth_min <= p.depth_max && p.depth_max <= 1 && std::isfinite(p.depth_dx));
      }
    }
  }
}

}  // namespace
}  // namespace tessera::raster_test

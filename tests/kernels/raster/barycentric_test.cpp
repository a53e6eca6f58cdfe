// Barycentrics and their derivatives, in double, against intersecting the pixel's ray with the triangle.
#define TESSERA_ISA scalar_test
#include "kernels/raster/barycentric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/raster/ray_reference.hpp"

namespace tessera::resolve_test {
namespace {

using scalar_test::Vec3;
using Bary = scalar_test::Barycentrics<double>;

Bary of(const ViewTransform& view, const Vector (&p)[3], double x, double y) {
  const Vec3<double> corners[3] = {{p[0].x, p[0].y, p[0].z}, {p[1].x, p[1].y, p[1].z}, {p[2].x, p[2].y, p[2].z}};
  return scalar_test::barycentrics(view, corners, x, y);
}

TEST(Barycentrics, DerivativesAreDifferences) {
  std::mt19937 random(11);
  const RayCamera camera;
  int compared = 0;
  for (int k = 0; k < 20000; ++k) {
    Vector p[3];
    for (Vector& v : p) v = camera.random_point(random);
    const double x = uniform(random, 0, camera.width), y = uniform(random, 0, camera.height);
    const double h = 1e-3;
    const auto inside = [&](double dx, double dy) {
      const Bary b = of(camera.view(), p, x + dx, y + dy);
      return b.b0 > 1e-3 && b.b1 > 1e-3 && b.b2 > 1e-3;
    };
    if (!inside(0, 0) || !inside(-h, 0) || !inside(h, 0) || !inside(0, -h) || !inside(0, h)) continue;
    ++compared;
    const Bary b = of(camera.view(), p, x, y);
    const Bary left = of(camera.view(), p, x - h, y), right = of(camera.view(), p, x + h, y);
    const Bary above = of(camera.view(), p, x, y - h), below = of(camera.view(), p, x, y + h);
    const double size = std::abs(b.b1_dx) + std::abs(b.b1_dy) + std::abs(b.b2_dx) + std::abs(b.b2_dy);
    EXPECT_NEAR(b.b1_dx, (right.b1 - left.b1) / (2 * h), 1e-4 * size + 1e-9);
    EXPECT_NEAR(b.b2_dx, (right.b2 - left.b2) / (2 * h), 1e-4 * size + 1e-9);
    EXPECT_NEAR(b.b1_dy, (below.b1 - above.b1) / (2 * h), 1e-4 * size + 1e-9);
    EXPECT_NEAR(b.b2_dy, (below.b2 - above.b2) / (2 * h), 1e-4 * size + 1e-9);
    EXPECT_NEAR(b.b0 + b.b1 + b.b2, 1, 1e-14);
  }
  EXPECT_GT(compared, 300);
}

TEST(Barycentrics, HitWhereTheRayHitsAlsoBehindTheEye) {
  std::mt19937 random(12);
  const RayCamera camera;
  int hits = 0, crossing = 0, backs = 0;
  for (int k = 0; k < 20000; ++k) {
    Vector p[3];
    for (Vector& v : p) v = camera.random_point(random);
    const double x = uniform(random, 0, camera.width), y = uniform(random, 0, camera.height);
    const RayHit hit = camera.intersect(p, x, y);
    if (!hit.inside(1e-3)) continue;
    ++hits;
    crossing += camera.depth_of(p[0]) < 0 || camera.depth_of(p[1]) < 0 || camera.depth_of(p[2]) < 0;
    backs += hit.back;
    const Bary b = of(camera.view(), p, x, y);
    EXPECT_NEAR(b.b0, hit.b[0], 1e-4);  // the view's rows are rounded to float
    EXPECT_NEAR(b.b1, hit.b[1], 1e-4);
    EXPECT_NEAR(b.b2, hit.b[2], 1e-4);
    EXPECT_EQ(b.back, hit.back);
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(crossing, 50);
  EXPECT_GT(backs, 50);
}

TEST(Barycentrics, OutsideIsClampedToTheEdge) {
  const ViewTransform view = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}, 32, 32};
  const Vector p[3] = {{0, 0, 0}, {0, 8, 0}, {8, 0, 0}};
  const Bary b = of(view, p, -0.004, 4);  // beyond the edge from 0 to 1
  EXPECT_EQ(b.b2, 0);
  EXPECT_NEAR(b.b1, 0.5, 1e-3);
  EXPECT_NEAR(b.b0 + b.b1, 1, 1e-15);
  EXPECT_FALSE(b.back);
}

TEST(Barycentrics, DegenerateIsTheCentroid) {
  const ViewTransform view = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}, 32, 32};
  const Vector line[3] = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
  const Vector nan[3] = {{NAN, 0, 0}, {NAN, 1, 0}, {2, NAN, 0}};
  for (const auto& p : {line, nan}) {
    const Vec3<double> corners[3] = {{p[0].x, p[0].y, p[0].z}, {p[1].x, p[1].y, p[1].z}, {p[2].x, p[2].y, p[2].z}};
    const Bary b = scalar_test::barycentrics(view, corners, 1.0, 1.0);
    EXPECT_EQ(b.b0, 1.0 / 3);
    EXPECT_EQ(b.b1, 1.0 / 3);
    EXPECT_EQ(b.b2, 1.0 / 3);
    EXPECT_EQ(b.b1_dx, 0);
    EXPECT_EQ(b.b2_dy, 0);
  }
}

}  // namespace
}  // namespace tessera::resolve_test

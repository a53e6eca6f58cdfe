#define TESSERA_ISA scalar_test
#include "kernels/raster/setup.hpp"

#include <gtest/gtest.h>

#include "kernels/raster/camera.hpp"
#include "kernels/raster/oracle.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::raster_test {
namespace {

struct Result {
  std::vector<SetupTriangle> triangles;
  GeometryCounters counters{};
};

// Triangles over vertices that are already projected: no clipping, so positions are not needed.
struct Mesh {
  std::vector<ProjectedVertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> double_sided{0, 1};

  void add(const ProjectedVertex& a, const ProjectedVertex& b, const ProjectedVertex& c, std::uint32_t binding) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c});
    triangles.push_back({{first, first + 1, first + 2}, binding});
  }
  [[nodiscard]] SetupTrianglesArgs args(int samples, Result& out, int width = 1000, int height = 800) const {
    const auto count = static_cast<std::uint32_t>(triangles.size());
    out.triangles.resize(std::size_t{count} * max_setup_per_triangle);
    return {{nullptr, nullptr, triangles.data(), static_cast<std::uint32_t>(vertices.size()), count},
            perspective(width, height, 500, 0.1f),
            vertices.data(),
            double_sided.data(),
            samples,
            0,
            count,
            out.triangles.data(),
            &out.counters};
  }
  [[nodiscard]] Result run(const Kernels& k, int samples) const {
    Result out;
    out.triangles.resize(k.setup_triangles(args(samples, out)));
    return out;
  }
};

Mesh random_mesh(Random& random, int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    // From a few units to far beyond what fits 32-bit products.
    const int extent = 1 << random.between(2, i % 16 == 0 ? 22 : 14);
    const int x = random.between(-extent, 1000 * 256), y = random.between(-extent, 800 * 256);
    const auto vertex = [&] {
      const int vx = x + random.between(0, extent), vy = y + random.between(0, extent);
      const std::uint32_t flags = (vx < 0 ? outside_left : 0u) | (vx > 1000 * 256 ? outside_right : 0u) |
                                  (vy < 0 ? outside_top : 0u) | (vy > 800 * 256 ? outside_bottom : 0u) |
                                  (random.between(0, 99) == 0 ? not_finite : 0u);
      return ProjectedVertex{vx, vy, random.real(0.01, 1), flags};
    };
    const ProjectedVertex a = vertex(), b = vertex(), c = vertex();
    mesh.add(a, b, i % 50 == 0 ? a : c, random.between(0, 1));
  }
  return mesh;
}

TEST(Setup, CullsAndOrientsAsADirectReadingSays) {
  Random random(1);
  for (const int samples : {1, 4, 16}) {
    const Mesh mesh = random_mesh(random, 20000);
    const SamplePattern pattern = runnable_kernels().front()->sample_pattern(samples);
    GeometryCounters expected{};
    std::vector<SetupTriangle> kept;
    for (const Triangle& t : mesh.triangles) {
      const ProjectedVertex v[3] = {mesh.vertices[t.vertex[0]], mesh.vertices[t.vertex[1]], mesh.vertices[t.vertex[2]]};
      ++expected.in;
      if (((v[0].flags | v[1].flags | v[2].flags) & not_finite) != 0 || (v[0].flags & v[1].flags & v[2].flags) != 0) {
        ++expected.outside;
        continue;
      }
      SetupTriangle s = make_triangle(v[0].x, v[0].y, v[1].x, v[1].y, v[2].x, v[2].y,
                                      static_cast<std::uint32_t>(&t - mesh.triangles.data()));
      if (twice_area(s) < 0 && t.binding == 0) {
        ++expected.back_face;
        continue;
      }
      const auto [left, right] = std::minmax({v[0].x, v[1].x, v[2].x});
      const auto [top, bottom] = std::minmax({v[0].y, v[1].y, v[2].y});
      SetupTriangle front = s;
      orient(front);
      // A sample in the half-open bounding box; where at most 2 x 2 of one kind are in it, a covered one.
      bool sample = false;
      for (int i = 0; i < samples && twice_area(s) != 0; ++i) {
        const auto inside = [](int low, int high, int offset, int size) {
          std::vector<int> at;
          for (int p = std::max(low >> 8, 0); p <= std::min(high >> 8, size - 1); ++p)
            if (p * 256 + offset >= low && p * 256 + offset < high) at.push_back(p * 256 + offset);
          return at;
        };
        const std::vector<int> xs = inside(left, right, pattern.x[i], 1000),
                               ys = inside(top, bottom, pattern.y[i], 800);
        if (xs.size() > 2 || ys.size() > 2) {
          sample |= !xs.empty() && !ys.empty();
        } else {
          for (const int x : xs)
            for (const int y : ys) sample |= covers(front, x, y);
        }
      }
      if (twice_area(s) == 0 || !sample) {
        ++expected.empty;
        continue;
      }
      orient(s);
      kept.push_back(s);
      ++expected.kept;
    }
    EXPECT_GT(expected.kept, 1000u);
    EXPECT_GT(expected.empty, 100u);
    for (const Kernels* k : runnable_kernels()) {
      const Result got = mesh.run(*k, samples);
      EXPECT_EQ(got.counters.in, expected.in);
      EXPECT_EQ(got.counters.outside, expected.outside);
      EXPECT_EQ(got.counters.back_face, expected.back_face);
      EXPECT_EQ(got.counters.empty, expected.empty);
      EXPECT_EQ(got.counters.kept, expected.kept);
      EXPECT_EQ(got.counters.clipped, 0u);
      ASSERT_EQ(got.triangles.size(), kept.size()) << k->isa;
      for (std::size_t i = 0; i < kept.size(); ++i) {
        const SetupTriangle &a = got.triangles[i], &b = kept[i];
        ASSERT_EQ(a.triangle, b.triangle) << k->isa;
        ASSERT_TRUE(same_bits(a.x, b.x, 3)) << k->isa;
        ASSERT_TRUE(same_bits(a.y, b.y, 3)) << k->isa;
      }
    }
  }
}

TEST(Setup, DepthPlaneGoesThroughTheVertices) {
  Random random(2);
  const Mesh mesh = random_mesh(random, 20000);
  for (const Kernels* k : runnable_kernels()) {
    for (const SetupTriangle& t : mesh.run(*k, 1).triangles) {
      const Triangle& triangle = mesh.triangles[t.triangle];
      float low = 2, high = 0;
      for (int corner = 0; corner < 3; ++corner) {
        const ProjectedVertex& v = mesh.vertices[triangle.vertex[corner]];
        low = std::min(low, v.depth), high = std::max(high, v.depth);
        const double x = (double(v.x) - t.x[0]) / 256, y = (double(v.y) - t.y[0]) / 256;
        const double along_x = double{t.depth_dx} * x, along_y = double{t.depth_dy} * y;
        const double value = t.depth + along_x + along_y;
        // Slopes have a relative error of a few 2^-24; a sliver's terms are large and cancel. Differences of depths
        // are rounded to 2^-24.
        const double slope_error = (std::abs(along_x) + std::abs(along_y)) * 8 + 4;
        ASSERT_NEAR(value, v.depth, slope_error * 0x1p-24) << k->isa;
      }
      ASSERT_EQ(t.depth_min, low);
      ASSERT_EQ(t.depth_max, high);
    }
  }
}

TEST(Setup, EveryInstructionSetAndCountGivesTheBitsOfOneAtATime) {
  Random random(3);
  for (const int samples : {1, 8}) {
    const Mesh mesh = random_mesh(random, 5000);
    Result expected;
    const SetupTrianglesArgs args = mesh.args(samples, expected);
    const SamplePattern pattern = scalar_test::standard_pattern(samples);
    std::uint32_t count = 0;
    std::vector<std::uint32_t> count_before;
    for (std::uint32_t i = 0; i < args.count; ++i) {
      count_before.push_back(count);
      count += scalar_test::setup_one(args, pattern, i, expected.triangles.data() + count);
    }
    for (const Kernels* k : runnable_kernels()) {
      const Result all = mesh.run(*k, samples);
      ASSERT_EQ(all.triangles.size(), count) << k->isa;
      EXPECT_TRUE(same_bits(all.triangles.data(), expected.triangles.data(), count)) << k->isa;
      for (std::uint32_t n = 0; n < 40; ++n) {  // parts of vectors
        Result part;
        SetupTrianglesArgs some = mesh.args(samples, part);
        some.first = 100 + n;
        some.count = n;
        const std::uint32_t written = k->setup_triangles(some);
        ASSERT_EQ(written, count_before[some.first + n] - count_before[some.first]);
        EXPECT_TRUE(same_bits(part.triangles.data(), expected.triangles.data() + count_before[some.first], written));
      }
    }
  }
}

}  // namespace
}  // namespace tessera::raster_test

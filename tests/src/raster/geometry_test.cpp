#include "raster/geometry.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "base/parallel.hpp"
#include "kernels/raster/camera.hpp"
#include "kernels/raster/oracle.hpp"
#include "kernels/runnable_kernels.hpp"
#include "raster/touched.hpp"

namespace tessera::raster_test {
namespace {

struct World {
  std::vector<float> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> double_sided{0, 1, 1};
  std::vector<AlphaMode> alpha{AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend};

  [[nodiscard]] GeometryView view() const {
    return {positions.data(), nullptr, triangles.data(), static_cast<std::uint32_t>(positions.size() / 3),
            static_cast<std::uint32_t>(triangles.size())};
  }
  void run(GeometryStage& stage, const ViewTransform& camera, int samples, const Kernels& k, int threads = 2) const {
    run_with_threads(threads, [&] { stage.run(view(), camera, samples, double_sided, alpha, k); });
  }
};

/// How often each sample of the frame is covered, every list drawn additively.
std::vector<int> cover_counts(const GeometryStage& stage, const ViewTransform& camera, int samples, const Kernels& k) {
  std::vector<int> counts(std::size_t(camera.width) * camera.height * samples);
  std::vector<Fragment> fragments(std::size_t(tile_pixels) * samples);
  for (int y = 0; y < camera.height; y += tile_size)
    for (int x = 0; x < camera.width; x += tile_size) {
      const Tile tile(x, y, std::min(tile_size, camera.width - x), std::min(tile_size, camera.height - y), samples);
      const TileLists lists = stage.lists(x / tile_size, y / tile_size);
      for (const std::span<const std::uint32_t> list : {lists.opaque, lists.mask, lists.blend})
        for (const std::uint32_t i : list) {
          const std::uint32_t n = k.collect_triangle(tile.view, stage.setup()[i], false, fragments.data());
          for (std::uint32_t f = 0; f < n; ++f) {
            const int px = x + tile_pixel_x(fragments[f].pixel), py = y + tile_pixel_y(fragments[f].pixel);
            for (int s = 0; s < samples; ++s)
              counts[(std::size_t(py) * camera.width + px) * samples + s] += fragments[f].samples >> s & 1;
          }
        }
    }
  return counts;
}

/// A sheet of n x n cells with shifted corners and random diagonals: neighbours share vertices. at(u, v), with u and v
/// from 0 to 1, puts it into the world, counter-clockwise from the front.
World make_sheet(Random& random, int n, double shift, const std::function<void(double, double, float*)>& at) {
  World world;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const auto jitter = [&](int k) { return k == 0 || k == n ? 0.0 : (random.unit() - 0.5) * shift; };
      const double u = (i + jitter(i)) / n, v = (j + jitter(j)) / n;
      float p[3];
      at(u, v, p);
      world.positions.insert(world.positions.end(), p, p + 3);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto corner = [&](int di, int dj) { return static_cast<std::uint32_t>((j + dj) * (n + 1) + i + di); };
      const std::uint32_t binding = static_cast<std::uint32_t>(random.between(0, 2));
      const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
      if (random.between(0, 1) == 0) {
        world.triangles.push_back({{a, b, c}, binding});
        world.triangles.push_back({{a, c, d}, binding});
      } else {
        world.triangles.push_back({{b, c, d}, binding});
        world.triangles.push_back({{b, d, a}, binding});
      }
    }
  return world;
}

class SharedEdges : public testing::TestWithParam<int> {};

TEST_P(SharedEdges, AFlatSheetCoversEverySampleOnce) {
  const int samples = GetParam();
  Random random(static_cast<std::uint64_t>(samples));
  const ViewTransform camera = perspective(333, 217, 200, 0.1f);
  const World world = make_sheet(random, 60, 0.6, [&](double u, double v, float* p) {
    p[0] = static_cast<float>((u - 0.5) * 4);
    p[1] = static_cast<float>((v - 0.5) * 3);
    p[2] = -1.5f - 0.2f * p[0];
  });
  for (const Kernels* k : runnable_kernels()) {
    GeometryStage stage;
    world.run(stage, camera, samples, *k);
    for (const int count : cover_counts(stage, camera, samples, *k)) ASSERT_EQ(count, 1) << k->isa;
  }
}

// A floor from behind the eye to the far end: its triangles cross the near plane, which cuts it inside the picture.
TEST_P(SharedEdges, AFloorThroughTheNearPlaneCoversEverySampleOnce) {
  const int samples = GetParam();
  Random random(static_cast<std::uint64_t>(samples) + 20);
  const ViewTransform camera = perspective(320, 240, 120, 1.5f);
  const SamplePattern pattern = runnable_kernels().front()->sample_pattern(samples);
  for (const int cells : {3, 12, 40}) {
    const World world = make_sheet(random, cells, 0.6, [&](double u, double v, float* p) {
      p[0] = static_cast<float>((u - 0.5) * 80);
      p[1] = -1;
      p[2] = static_cast<float>(10 - v * 30);
    });
    for (const Kernels* k : runnable_kernels()) {
      GeometryStage stage;
      world.run(stage, camera, samples, *k);
      EXPECT_GT(stage.counters().clipped, 0u);
      const std::vector<int> counts = cover_counts(stage, camera, samples, *k);
      int once = 0;
      for (std::size_t i = 0; i < counts.size(); ++i) {
        ASSERT_LE(counts[i], 1) << k->isa << " cells " << cells;
        const int s = static_cast<int>(i) % samples, y = static_cast<int>(i) / samples / camera.width;
        // The floor is at depth 120 / (y - 120 pixels): seen from the near plane, 1.5, to 20.
        const double depth = 120 / (y + pattern.y[s] / 256.0 - 120);
        if (depth > 1.51 && depth < 19.9) {
          ASSERT_EQ(counts[i], 1) << k->isa << " cells " << cells << " sample " << i;
          ++once;
        }
        if (depth < 1.49) {
          ASSERT_EQ(counts[i], 0);
        }
      }
      EXPECT_GT(once, 1000);
    }
  }
}

TEST_P(SharedEdges, AWallFarBeyondTheGuardBandCoversEverySampleOnce) {
  const int samples = GetParam();
  Random random(static_cast<std::uint64_t>(samples) + 40);
  const ViewTransform camera = perspective(100, 100, 200, 0.1f);
  for (const int cells : {1, 3, 8}) {
    const World world = make_sheet(random, cells, 0.6, [&](double u, double v, float* p) {
      p[0] = static_cast<float>((u - 0.5) * 20000);  // two million pixels
      p[1] = static_cast<float>((v - 0.47) * 9000);
      p[2] = -2;
    });
    for (const Kernels* k : runnable_kernels()) {
      GeometryStage stage;
      world.run(stage, camera, samples, *k);
      EXPECT_GT(stage.counters().clipped, 0u);
      for (const int count : cover_counts(stage, camera, samples, *k)) ASSERT_EQ(count, 1) << k->isa;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, SharedEdges, testing::Values(1, 2, 4, 8, 16));

// Triangles of all sizes, some through the near plane, enough for several chunks.
World random_world(Random& random, int count) {
  World world;
  for (int i = 0; i < count; ++i) {
    const double size = std::ldexp(1.0, random.between(-8, i % 20 == 0 ? 4 : 0));
    const float center[3] = {random.real(-3, 3), random.real(-2, 2), random.real(-6, 0.5)};
    for (int c = 0; c < 3; ++c)
      for (const float middle : center) world.positions.push_back(middle + random.real(-size, size));
    const auto first = static_cast<std::uint32_t>(3 * i);
    world.triangles.push_back({{first, first + 1, first + 2}, static_cast<std::uint32_t>(random.between(0, 2))});
  }
  return world;
}

TEST(Geometry, ListsAreWhatTheTrianglesTouchInSubmissionOrder) {
  Random random(7);
  const World world = random_world(random, 9000);
  const ViewTransform camera = perspective(700, 500, 400, 0.2f);
  const Kernels& k = *runnable_kernels().back();
  GeometryStage stage;
  world.run(stage, camera, 4, k);
  const TileScreen screen(camera.width, camera.height, k.sample_pattern(4));
  std::vector<std::vector<std::uint32_t>> expected(std::size_t(screen.columns) * screen.rows * 3);
  std::uint64_t entries = 0;
  for (std::uint32_t i = 0; i < stage.setup().size(); ++i) {
    if (i > 0) {
      ASSERT_LE(stage.setup()[i - 1].triangle, stage.setup()[i].triangle);
    }
    const std::uint32_t binding = world.triangles[stage.setup()[i].triangle].binding;
    const TouchedTiles touched(screen, stage.setup()[i]);
    for (int row = touched.first_row(); row <= touched.last_row(); ++row)
      for (int column = touched.row(row).first; column <= touched.row(row).last; ++column, ++entries)
        expected[(std::size_t(row) * screen.columns + column) * 3 + static_cast<int>(world.alpha[binding])].push_back(
            i);
  }
  for (int row = 0; row < screen.rows; ++row)
    for (int column = 0; column < screen.columns; ++column) {
      const TileLists lists = stage.lists(column, row);
      const std::span<const std::uint32_t> got[3] = {lists.opaque, lists.mask, lists.blend};
      for (int c = 0; c < 3; ++c)
        ASSERT_TRUE(std::ranges::equal(got[c], expected[(std::size_t(row) * screen.columns + column) * 3 + c]));
    }
  EXPECT_EQ(stage.binned(), entries);
  const GeometryCounters& n = stage.counters();
  EXPECT_EQ(n.in, 9000u);
  EXPECT_EQ(n.in, n.outside + n.back_face + n.empty + n.kept);
  EXPECT_GT(n.clipped, 50u);
  EXPECT_GT(n.kept, 1000u);
}

TEST(Geometry, IsTheSameForAnyNumberOfThreadsInstructionSetAndReuse) {
  Random random(8);
  const World world = random_world(random, 20000), other = random_world(random, 3000);
  const ViewTransform camera = perspective(700, 500, 400, 0.2f);
  GeometryStage expected, stage;
  world.run(expected, camera, 1, *runnable_kernels().front(), 1);
  for (const Kernels* k : runnable_kernels())
    for (const int threads : {1, 2, 7}) {
      other.run(stage, perspective(1200, 90, 300, 0.1f), 4, *k, threads);
      world.run(stage, camera, 1, *k, threads);
      ASSERT_EQ(stage.setup().size(), expected.setup().size());
      ASSERT_EQ(0, std::memcmp(stage.setup().data(), expected.setup().data(), stage.setup().size_bytes()));
      ASSERT_EQ(0, std::memcmp(&stage.counters(), &expected.counters(), sizeof(GeometryCounters)));
      ASSERT_EQ(stage.binned(), expected.binned());
      for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 22; ++column) {
          const TileLists a = stage.lists(column, row), b = expected.lists(column, row);
          ASSERT_TRUE(std::ranges::equal(a.opaque, b.opaque) && std::ranges::equal(a.mask, b.mask) &&
                      std::ranges::equal(a.blend, b.blend));
        }
    }
}

TEST(Geometry, EmptyScenesAndTheLargestFrame) {
  const World nothing;
  GeometryStage stage;
  nothing.run(stage, perspective(33, 1, 10, 0.1f), 1, *runnable_kernels().back());
  EXPECT_TRUE(stage.lists(1, 0).opaque.empty());
  EXPECT_TRUE(stage.setup().empty());

  Random random(9);
  const World sheet = make_sheet(random, 100, 0.6, [&](double u, double v, float* p) {
    p[0] = static_cast<float>((u - 0.5) * 5);
    p[1] = static_cast<float>((v - 0.5) * 5);
    p[2] = -2;
  });
  sheet.run(stage, perspective(max_frame_size, max_frame_size, 16384, 0.1f), 1, *runnable_kernels().back());
  EXPECT_GT(stage.binned(), 512u * 512u);
  for (int tile = 0; tile < 512; ++tile) {
    const TileLists lists = stage.lists(tile, 511 - tile);
    EXPECT_GT(lists.opaque.size() + lists.mask.size() + lists.blend.size(), 0u);
  }
  EXPECT_LT(stage.bytes(), 64u << 20);
}

}  // namespace
}  // namespace tessera::raster_test

// Random bit patterns through the rasterizer, from vertices to the G-buffer: what comes out is within its limits, and
// the same on the narrowest instruction set and the widest.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "base/aligned.hpp"
#include "fuzz/random_bits.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::test {
namespace {

constexpr std::uint32_t batch = 64;  // triangles that meet in one tile
constexpr int samples = 4;
constexpr std::size_t floats_per_vertex = 3 + sizeof(VertexAttributes) / sizeof(float);

// A camera at (0,0,4) that looks down the z axis at [-4, 4]^3, some of which is behind it.
constexpr ViewTransform view{{16, 0, -16, 64}, {0, -16, -16, 64}, {0, 0, 0, 0.1f}, {0, 0, -1, 4},
                             {0, 0, 4, 1},     tile_size,         tile_size};

// Any bits for half of the values; the other half moderate, so that not every triangle is a degenerate one.
void fill(RandomBits& random, float* values, std::size_t count) {
  random.fill(values, count);
  for (std::size_t i = 0; i < count; ++i)
    if (random.next() & 1) values[i] = float(double(std::bit_cast<std::int32_t>(values[i])) * 0x1p-29);
}

struct Soup {
  std::vector<float> positions = std::vector<float>(9 * batch);
  std::vector<VertexAttributes> attributes = std::vector<VertexAttributes>(3 * batch);
  std::vector<Triangle> triangles;

  explicit Soup(RandomBits& random) {
    fill(random, positions.data(), positions.size());
    for (std::uint32_t i = 0; i < batch; ++i) {
      // Every other triangle of moderate corners alone: these reach the tile.
      for (std::uint32_t k = 0; i % 2 == 0 && k < 9; ++k)
        positions[9 * i + k] = float(double(std::int32_t(random.next() >> 32)) * 0x1p-29);
      triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0});
    }
    for (VertexAttributes& v : attributes) {
      float bits[sizeof v / sizeof(float)];
      fill(random, bits, std::size(bits));
      std::memcpy(&v, bits, sizeof v);
    }
  }
  GeometryView geometry() const { return {positions.data(), attributes.data(), triangles.data(), 3 * batch, batch}; }
};

// A material whose five slots read one random texture; all wrap modes and filters among them.
struct Surface {
  std::vector<std::uint32_t> texels;
  TextureView textures[5];
  MaterialView material{};

  explicit Surface(RandomBits& random) {
    for (int i = 0; i < 2 * 16 * 16; ++i) texels.push_back(std::uint32_t(random.next()));
    const WrapMode wraps[] = {WrapMode::repeat, WrapMode::mirrored_repeat, WrapMode::clamp_to_edge};
    for (int i = 0; i < 5; ++i) {
      const FilterMode filter = i == 4 ? FilterMode::nearest : FilterMode::linear;
      textures[i] = {texels.data(), TexelFormat::rgba8_unorm, 16,     16,     5,
                     wraps[i % 3],  wraps[(i + 1) % 3],       filter, filter, filter,
                     i != 2};
    }
    const auto slot = [&](int i) { return TextureSlotView{&textures[i], i % 2, {1.5f, 0.25f, 0.1f, -0.5f, 2, -0.3f}}; };
    material = {
        {0.9f, 0.8f, 0.7f, 0.6f}, 0.8f, 0.9f,  0.7f, 0.5f, {1, 2, 3}, 0.5f, slot(0), slot(1), slot(2), slot(3), slot(4),
        AlphaMode::blend,         true, false, true, true};
  }
};

// What one instruction set makes of a soup.
struct Result {
  std::vector<ProjectedVertex> projected = std::vector<ProjectedVertex>(3 * batch + max_lanes);
  std::vector<SetupTriangle> setup = std::vector<SetupTriangle>(std::size_t{max_setup_per_triangle} * batch);
  AlignedVector<float> depth = AlignedVector<float>(std::size_t{tile_pixels} * samples);
  AlignedVector<std::uint32_t> triangle = AlignedVector<std::uint32_t>(std::size_t{tile_pixels} * samples);
  std::vector<Fragment> fragments = std::vector<Fragment>(std::size_t{tile_pixels} * samples + max_lanes);
  AlignedVector<float> gbuffer = AlignedVector<float>(std::size_t{gbuffer_planes} * tile_pixels * samples);

  Result(const Kernels& kernels, const Soup& soup, const Surface& surface) {
    const GeometryView geometry = soup.geometry();
    kernels.project_vertices(view, soup.positions.data(), 3 * batch, projected.data());
    const std::uint8_t double_sided = 1;
    GeometryCounters counters{};
    setup.resize(kernels.setup_triangles(
        {geometry, view, projected.data(), &double_sided, samples, 0, batch, setup.data(), &counters}));
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 0; i < setup.size(); ++i) list.push_back(i);
    const VisibilityTile tile{0, 0, tile_size, tile_size, samples, depth.data(), triangle.data()};
    kernels.clear_visibility(tile);
    RasterCounters raster{};
    kernels.rasterize_opaque({tile, setup.data(), list.data(), std::uint32_t(list.size())}, &raster);
    fragments.resize(kernels.collect_visible(tile, fragments.data()));
    float* planes[gbuffer_planes];
    for (std::size_t p = 0; p < gbuffer_planes; ++p) planes[p] = gbuffer.data() + p * tile_pixels * samples;
    const GBufferView out{{planes[0], planes[1], planes[2]},
                          {planes[3], planes[4], planes[5]},
                          {planes[6], planes[7], planes[8]},
                          planes[9],
                          planes[10],
                          planes[11],
                          {planes[12], planes[13], planes[14]},
                          planes[15],
                          planes[16],
                          planes[17]};
    kernels.resolve({geometry, view, &surface.material, kernels.sample_pattern(samples), 0, 0, fragments.data(),
                     std::uint32_t(fragments.size()), out});
  }
};

bool same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a != a && b != b);
}

void expect_within_limits(const SetupTriangle& t) {
  for (int k = 0; k < 3; ++k)
    ASSERT_TRUE(t.x[k] >= -(1 << 23) && t.x[k] <= 1 << 23 && t.y[k] >= -(1 << 23) && t.y[k] <= 1 << 23);
  ASSERT_TRUE(t.depth_min >= 0 && t.depth_min <= t.depth_max && t.depth_max <= 3.4e38f)
      << t.depth_min << " " << t.depth_max;
  ASSERT_TRUE(std::isfinite(t.depth_dx) && std::isfinite(t.depth_dy)) << t.depth_dx << " " << t.depth_dy;
  ASSERT_LT(t.triangle, batch);
}

TEST(RasterFuzz, AnyTrianglesGiveTheSameOnTheNarrowestAndTheWidest) {
  const Kernels &narrow = *runnable_kernels().front(), &wide = *runnable_kernels().back();
  RandomBits random(21);
  const Surface surface(random);
  std::size_t shaded = 0;
  for (std::uint64_t done = 0; done < fuzz_count(); done += 3 * batch * floats_per_vertex) {
    const Soup soup(random);
    const Result a(narrow, soup, surface), b(wide, soup, surface);
    for (std::uint32_t i = 0; i < 3 * batch; ++i) {
      ASSERT_EQ(a.projected[i].flags, b.projected[i].flags);
      if (a.projected[i].flags & (needs_clip | not_finite)) continue;
      ASSERT_EQ(std::memcmp(&a.projected[i], &b.projected[i], sizeof(ProjectedVertex)), 0);
    }
    ASSERT_EQ(a.setup.size(), b.setup.size());
    ASSERT_EQ(std::memcmp(a.setup.data(), b.setup.data(), a.setup.size() * sizeof(SetupTriangle)), 0);
    for (const SetupTriangle& t : a.setup) expect_within_limits(t);
    ASSERT_EQ(a.triangle, b.triangle);
    ASSERT_EQ(a.depth, b.depth);
    for (const float depth : a.depth) ASSERT_TRUE(depth >= 0 && depth <= 3.4e38f) << depth;
    ASSERT_EQ(a.fragments.size(), b.fragments.size());
    ASSERT_EQ(std::memcmp(a.fragments.data(), b.fragments.data(), a.fragments.size() * sizeof(Fragment)), 0);
    for (std::size_t p = 0; p < gbuffer_planes; ++p)
      for (std::size_t i = 0; i < a.fragments.size(); ++i) {
        const std::size_t at = p * tile_pixels * samples + i;
        ASSERT_TRUE(same(a.gbuffer[at], b.gbuffer[at]))
            << "plane " << p << ": " << a.gbuffer[at] << " " << b.gbuffer[at];
      }
    shaded += a.fragments.size();
  }
  EXPECT_GT(shaded, fuzz_count() / 200);  // it was not all culled
}

}  // namespace
}  // namespace tessera::test

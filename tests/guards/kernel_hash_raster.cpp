// The way from triangles to surface attributes: projection, set-up, coverage, resolve.
#include <algorithm>
#include <memory>

#include "guards/kernel_hash.hpp"

namespace tessera {
namespace {

// A camera that looks down the z axis at [-2, 2]^3, and random triangles there.
struct Soup {
  static constexpr int width = 100, height = 70;
  std::vector<float> positions;
  std::vector<VertexAttributes> attributes;
  std::vector<Triangle> triangles;
  ViewTransform view{
      {60, 0, -50, 200}, {0, -60, -35, 140}, {0, 0, 0, 0.1f}, {0, 0, -1, 4}, {0, 0, 4, 1}, width, height};

  explicit Soup(Random& random) {
    for (std::uint32_t i = 0; i < 400; ++i) {
      const float center[3] = {random.between(-2, 2), random.between(-2, 2), random.between(-2, 4.5f)};
      const float size = random.unit();
      for (int k = 0; k < 3; ++k) {
        for (const float c : center) positions.push_back(c + size * random.between(-1, 1));
        VertexAttributes v{};
        v.normal[2] = 1;
        for (auto& set : v.uv)
          for (float& x : set) x = random.unit();
        for (float& x : v.color) x = random.unit();
        attributes.push_back(v);
      }
      triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0});
    }
  }
  GeometryView geometry() const {
    return {positions.data(), attributes.data(), triangles.data(), static_cast<std::uint32_t>(attributes.size()),
            static_cast<std::uint32_t>(triangles.size())};
  }
};

// A material whose five slots read one random texture with mips, all filters and wrap modes among them.
struct Surface {
  std::vector<std::uint32_t> texels;
  TextureView textures[5];
  MaterialView material{};

  explicit Surface(Random& random) {
    constexpr int width = 32, height = 16, levels = 6;
    for (int i = 0; i < 2 * width * height; ++i) texels.push_back(static_cast<std::uint32_t>(random.next()));
    const WrapMode wraps[] = {WrapMode::repeat, WrapMode::mirrored_repeat, WrapMode::clamp_to_edge};
    for (int i = 0; i < 5; ++i) {
      const FilterMode filter = i == 4 ? FilterMode::nearest : FilterMode::linear;
      textures[i] = {texels.data(),
                     i == 0 ? TexelFormat::rgba8_squares : TexelFormat::rgba8_unorm,
                     width,
                     height,
                     levels,
                     wraps[i % 3],
                     wraps[(i + 1) % 3],
                     filter,
                     filter,
                     i == 3 ? FilterMode::nearest : FilterMode::linear,
                     i != 2};
    }
    const auto slot = [&](int i) { return TextureSlotView{&textures[i], i % 2, {1.5f, 0.25f, 0.1f, -0.5f, 2, -0.3f}}; };
    material = {{0.9f, 0.8f, 0.7f, 0.6f},
                0.8f,
                0.9f,
                0.7f,
                0.5f,
                {1, 2, 3},
                0.5f,
                slot(0),
                slot(1),
                slot(2),
                slot(3),
                slot(4),
                AlphaMode::blend,
                true,
                false,
                false,
                true};
  }
};

void hash_fragments(const Kernels& kernels, const ResolveArgs& args, GBuffer& gbuffer, Hash& hash) {
  kernels.resolve(args);
  for (const GBuffer::Plane& plane : gbuffer.planes)
    for (std::uint32_t i = 0; i < args.count; ++i) hash.add(plane.values[i]);
}

}  // namespace

void hash_raster(const Kernels& kernels, Random& random, Hash& hash) {
  const Soup soup(random);
  const GeometryView geometry = soup.geometry();
  std::vector<ProjectedVertex> projected(geometry.vertex_count + max_lanes);
  kernels.project_vertices(soup.view, soup.positions.data(), geometry.vertex_count, projected.data());
  for (std::uint32_t i = 0; i < geometry.vertex_count; ++i) {
    hash.add(projected[i].flags);
    if (projected[i].flags & needs_clip) continue;
    hash.add(static_cast<std::uint32_t>(projected[i].x));
    hash.add(static_cast<std::uint32_t>(projected[i].y));
    hash.add(projected[i].depth);
  }
  const Surface surface(random);
  const std::uint8_t double_sided = 1;
  for (const int samples : {1, 4, 16}) {
    std::vector<SetupTriangle> setup(std::size_t{max_setup_per_triangle} * geometry.triangle_count);
    GeometryCounters counters{};
    const std::uint32_t count = kernels.setup_triangles({geometry, soup.view, projected.data(), &double_sided, samples,
                                                         0, geometry.triangle_count, setup.data(), &counters});
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 0; i < count; ++i) {
      list.push_back(i);
      for (int k = 0; k < 3; ++k) hash.add(static_cast<std::uint32_t>(setup[i].x[k] ^ setup[i].y[k] << 16));
      for (const float x : {setup[i].depth, setup[i].depth_dx, setup[i].depth_dy}) hash.add(x);
    }
    struct alignas(64) Planes {
      float depth[tile_pixels * max_samples];
      std::uint32_t triangle[tile_pixels * max_samples];
    };
    const auto planes = std::make_unique<Planes>();
    const auto fragments = std::vector<Fragment>(std::size_t{tile_pixels} * samples + max_lanes);
    for (int y = 0; y < Soup::height; y += tile_size)
      for (int x = 0; x < Soup::width; x += tile_size) {
        const VisibilityTile tile{x,
                                  y,
                                  std::min(tile_size, Soup::width - x),
                                  std::min(tile_size, Soup::height - y),
                                  samples,
                                  planes->depth,
                                  planes->triangle};
        RasterCounters raster{};
        kernels.clear_visibility(tile);
        kernels.rasterize_opaque({tile, setup.data(), list.data(), count}, &raster);
        std::vector<Fragment> visible = fragments;
        visible.resize(kernels.collect_visible(tile, visible.data()));
        for (const Fragment& f : visible) {
          hash.add(f.triangle);
          hash.add(std::uint32_t{f.pixel} << 16 | f.samples);
          for (int s = 0; s < samples; ++s)
            if (f.samples >> s & 1) hash.add(planes->depth[s * tile_pixels + f.pixel]);
        }
        GBuffer gbuffer;
        const auto resolved = std::min<std::size_t>(visible.size(), GBuffer::capacity);
        hash_fragments(kernels,
                       {geometry, soup.view, &surface.material, kernels.sample_pattern(samples), x, y, visible.data(),
                        static_cast<std::uint32_t>(resolved), gbuffer.view()},
                       gbuffer, hash);
      }
  }
}

}  // namespace tessera

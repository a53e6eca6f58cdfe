// A tile full of fragments to resolve: a grid of triangles in the window's plane, of a chosen size, with every
// attribute.
#pragma once
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera {

struct ResolveScene {
  AlignedVector<float> positions;
  AlignedVector<VertexAttributes> attributes;
  AlignedVector<Triangle> triangles;
  std::vector<Fragment> fragments;
  MaterialView material{};
  AlignedVector<float> planes = AlignedVector<float>(std::size_t(gbuffer_planes) * tile_pixels);

  // cell: side of a square of two triangles, in pixels. uv_step: change of u and of v per pixel.
  ResolveScene(int cell, float uv_step) {
    const int n = tile_size / cell;
    std::mt19937 random(1);
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        const float px = float(x * cell), py = float(y * cell);
        positions.insert(positions.end(), {px, py, 1});
        const float tilt = float(random() % 1000) * 1e-4f;
        attributes.push_back({{tilt, 0, 1},
                              {1, 0, 0, 1},
                              {{px * uv_step, py * uv_step}, {py * uv_step, px * uv_step}},
                              {1, 1, 1, 1},
                              0});
      }
    const auto vertex = [&](int x, int y) { return std::uint32_t(y * (n + 1) + x); };
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        triangles.push_back({{vertex(x, y), vertex(x, y + 1), vertex(x + 1, y)}, 0});
        triangles.push_back({{vertex(x + 1, y), vertex(x, y + 1), vertex(x + 1, y + 1)}, 0});
      }
    for (int pixel = 0; pixel < tile_pixels; ++pixel) {
      const int x = tile_pixel_x(pixel), y = tile_pixel_y(pixel);
      const int upper = (x % cell) + (y % cell) + 1 <= cell ? 0 : 1;
      const auto triangle = std::uint32_t(2 * (y / cell * n + x / cell) + upper);
      fragments.push_back({triangle, std::uint16_t(pixel), 1});
    }
    for (float& c : material.base_color) c = 1;
    material.metallic = material.roughness = material.normal_scale = material.occlusion_strength = 1;
    for (TextureSlotView* slot : {&material.base_color_texture, &material.metallic_roughness_texture,
                                  &material.normal_texture, &material.occlusion_texture, &material.emissive_texture})
      slot->transform[0] = slot->transform[4] = 1;
  }

  void run(const Kernels& kernels) {
    const auto p = [&](int i) { return planes.data() + std::size_t(i) * tile_pixels; };
    ResolveArgs args{};
    args.geometry = {positions.data(), attributes.data(), triangles.data(), std::uint32_t(attributes.size()),
                     std::uint32_t(triangles.size())};
    args.view = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0.5f, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}, tile_size, tile_size};
    args.material = &material;
    args.pattern = {1, {128}, {128}};
    args.fragments = fragments.data();
    args.count = std::uint32_t(fragments.size());
    args.out = {{p(0), p(1), p(2)},
                {p(3), p(4), p(5)},
                {p(6), p(7), p(8)},
                p(9),
                p(10),
                p(11),
                {p(12), p(13), p(14)},
                p(15),
                p(16),
                p(17)};
    kernels.resolve(args);
  }
};

/// 1024 x 1024 texels with all levels, of noise.
struct NoiseTexture {
  std::vector<std::uint16_t> texels;
  TextureView view;

  explicit NoiseTexture(TexelFormat format) {
    std::size_t count = 0;
    for (int size = 1024; size > 0; size /= 2) count += std::size_t(size) * size;
    std::mt19937 random(2);
    texels.resize(count * (format == TexelFormat::rgba8_unorm ? 2 : 4));
    for (std::uint16_t& t : texels) t = std::uint16_t(0x0400 + random() % 0x3800);
    view = {texels.data(),
            format,
            1024,
            1024,
            11,
            WrapMode::repeat,
            WrapMode::repeat,
            FilterMode::linear,
            FilterMode::linear,
            FilterMode::linear,
            true};
  }
};

}  // namespace tessera

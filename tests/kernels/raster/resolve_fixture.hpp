// What a resolve kernel reads and writes, owned, and short ways to make it.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera::resolve_test {

inline constexpr std::array<const char*, gbuffer_planes> plane_names = {
    "position.x", "position.y", "position.z", "normal.x",   "normal.y",   "normal.z",   "color.r", "color.g", "color.b",
    "metallic",   "roughness",  "occlusion",  "emissive.r", "emissive.g", "emissive.b", "alpha",   "unlit",   "depth"};

enum Plane {
  position = 0,
  normal = 3,
  color = 6,
  metallic = 9,
  roughness,
  occlusion,
  emissive,
  alpha = 15,
  unlit,
  depth
};

struct GBuffer {
  std::array<AlignedVector<float>, gbuffer_planes> planes;

  explicit GBuffer(std::size_t count) {
    for (auto& plane : planes) plane.assign((count + max_lanes - 1) / max_lanes * max_lanes, -77.0f);
  }
  GBufferView view() {
    const auto p = [&](int i) { return planes[i].data(); };
    return {{p(0), p(1), p(2)},
            {p(3), p(4), p(5)},
            {p(6), p(7), p(8)},
            p(9),
            p(10),
            p(11),
            {p(12), p(13), p(14)},
            p(15),
            p(16),
            p(17)};
  }
};

struct TextureMemory {
  std::vector<std::uint16_t> halves;
  std::vector<std::uint8_t> bytes;
  TextureView view;
};

inline VertexAttributes plain_attributes() { return {{0, 0, 1}, {1, 0, 0, 1}, {{0, 0}, {0, 0}}, {1, 1, 1, 1}, 0}; }

inline MaterialView plain_material() {
  MaterialView m{};
  for (float& c : m.base_color) c = 1;
  m.metallic = m.roughness = m.normal_scale = m.occlusion_strength = 1;
  for (TextureSlotView* slot : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                                &m.occlusion_texture, &m.emissive_texture})
    slot->transform[0] = slot->transform[4] = 1;
  return m;
}

struct Workbench {
  AlignedVector<float> positions;
  AlignedVector<VertexAttributes> attributes;
  AlignedVector<Triangle> triangles;
  MaterialView material = plain_material();
  // World x, y are window x, y; depth is 0.5 z.
  ViewTransform view = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0.5f, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}, 32, 32};
  SamplePattern pattern = {1, {128}, {128}};
  int tile_x = 0, tile_y = 0;

  std::uint32_t add_vertex(float x, float y, float z, const VertexAttributes& a = plain_attributes()) {
    positions.insert(positions.end(), {x, y, z});
    attributes.push_back(a);
    return std::uint32_t(attributes.size() - 1);
  }
  std::uint32_t add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    triangles.push_back({{a, b, c}, 0});
    return std::uint32_t(triangles.size() - 1);
  }
  [[nodiscard]] GeometryView geometry() const {
    return {positions.data(), attributes.data(), triangles.data(), std::uint32_t(attributes.size()),
            std::uint32_t(triangles.size())};
  }
  GBuffer resolve(const Kernels& kernels, const std::vector<Fragment>& fragments) const {
    GBuffer out(fragments.size());
    kernels.resolve({geometry(), view, &material, pattern, tile_x, tile_y, fragments.data(),
                     std::uint32_t(fragments.size()), out.view()});
    return out;
  }
  AlignedVector<float> resolve_alpha(const Kernels& kernels, const std::vector<Fragment>& fragments) const {
    AlignedVector<float> out((fragments.size() + max_lanes - 1) / max_lanes * max_lanes);
    kernels.resolve_alpha({geometry(), view, &material, pattern, tile_x, tile_y, fragments.data(),
                           std::uint32_t(fragments.size()), out.data()});
    return out;
  }
};

inline std::uint16_t pixel(int x, int y) { return std::uint16_t(tile_pixel(x, y)); }

/// One triangle that covers the whole tile at (0, 0) of the plain view, with attributes affine in the window: vertex i
/// gets at(x_i, y_i).
template <class At>
void add_covering_triangle(Workbench& bench, const At& at) {
  const float corners[3][2] = {{-64, -64}, {-64, 192}, {192, -64}};
  std::uint32_t v[3];
  for (int i = 0; i < 3; ++i)
    v[i] = bench.add_vertex(corners[i][0], corners[i][1], 1, at(corners[i][0], corners[i][1]));
  bench.add_triangle(v[0], v[1], v[2]);
}

/// Every pixel of the tile, on triangle 0, all samples covered.
inline std::vector<Fragment> whole_tile(std::uint16_t samples = 1) {
  std::vector<Fragment> fragments;
  for (int p = 0; p < tile_pixels; ++p) fragments.push_back({0, std::uint16_t(p), samples});
  return fragments;
}

/// A view that repeats and is filtered between texels and mips. bind() gives it its texels.
inline TextureView trilinear(TexelFormat format, int width, int height, int levels) {
  constexpr WrapMode repeat = WrapMode::repeat;
  constexpr FilterMode linear = FilterMode::linear;
  return {nullptr, format, width, height, levels, repeat, repeat, linear, linear, linear, true};
}

/// A texture of one half-float texel.
inline TextureMemory half_texel(std::uint16_t r, std::uint16_t g, std::uint16_t b, std::uint16_t a = 0x3c00) {
  TextureMemory t;
  t.halves = {r, g, b, a};
  t.view = trilinear(TexelFormat::rgba16_float, 1, 1, 1);
  return t;
}
inline void bind(TextureSlotView& slot, TextureMemory& texture) {
  texture.view.texels = texture.halves.empty() ? static_cast<const void*>(texture.bytes.data()) : texture.halves.data();
  slot.texture = &texture.view;
}

}  // namespace tessera::resolve_test

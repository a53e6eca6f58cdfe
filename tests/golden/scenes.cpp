#include "golden/scenes.hpp"

#include "golden/builder.hpp"

namespace tessera::golden {
namespace {

Material surface(double r, double g, double b, double metallic, double roughness) {
  Material m;
  m.base_color[0] = static_cast<float>(r);
  m.base_color[1] = static_cast<float>(g);
  m.base_color[2] = static_cast<float>(b);
  m.metallic = static_cast<float>(metallic);
  m.roughness = static_cast<float>(roughness);
  return m;
}

void look(Camera& camera, const Point& eye, const Point& target, double near = 0.01) {
  for (int k = 0; k < 3; ++k) camera.eye[k] = eye[k], camera.target[k] = target[k];
  camera.near_plane = near;
}

RenderSettings picture(int width, int height, int samples) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.samples = samples;
  return settings;
}

// Roughness along x, metallic along y.
GoldenScene spheres() {
  GoldenScene g{"spheres", {}, {}, picture(320, 192, 4)};
  Builder b(g.scene);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 6; ++column) {
      b.begin_part(b.material(surface(0.9, 0.6, 0.25, row / 2.0, column / 5.0)));
      b.sphere({column * 1.1 - 2.75, row * 1.1 - 1.1, 0}, 0.5, 12);
    }
  look(g.camera, {0.5, 0.7, 6}, {0, 0, 0});
  return g;
}

// A floor to the horizon that passes under the eye and behind it: mips, wrap modes, clipping, a normal map from UVs and
// from tangents.
GoldenScene textures() {
  GoldenScene g{"textures", {}, {}, picture(257, 190, 1)};
  Builder b(g.scene);
  const auto checker = [](int x, int y) -> std::array<int, 4> {
    const bool on = ((x / 8) ^ (y / 8)) & 1;
    return {on ? 230 : 40, on ? 200 : 90, (x * 255) / 63, 255};
  };
  const auto bumps = [](int x, int y) -> std::array<int, 4> {
    const int dx = (x % 16) - 8, dy = (y % 16) - 8;
    return {128 + dx * 6, 128 - dy * 6, 220, 255};
  };
  const auto orm = [](int x, int y) -> std::array<int, 4> {
    return {255 - y * 2, 30 + x * 3, (x / 16) % 2 ? 255 : 0, 255};
  };
  const Sampler repeat;
  Sampler mirror{WrapMode::mirrored_repeat, WrapMode::clamp_to_edge, FilterMode::linear,
                 FilterMode::linear,        FilterMode::nearest,     true};
  const Sampler nearest{WrapMode::repeat,    WrapMode::repeat,    FilterMode::nearest,
                        FilterMode::nearest, FilterMode::nearest, false};
  Material floor = surface(1, 1, 1, 1, 1);
  floor.base_color_texture.texture = b.texture(64, 64, repeat, checker);
  floor.normal_texture.texture = b.texture(48, 80, repeat, bumps);
  floor.metallic_roughness_texture.texture = floor.occlusion_texture.texture = b.texture(64, 64, repeat, orm);
  floor.occlusion_strength = 0.7f;
  b.begin_part(b.material(floor));
  b.quad({-400, 0, 400}, {800, 0, 0}, {0, 0, -800}, 300);
  Material wall = surface(0.9, 0.9, 0.9, 0, 0.4);
  wall.base_color_texture = {b.texture(40, 24, mirror, checker), 0, {0.25f, -0.5f}, {3, 2}, 0.5f};
  b.begin_part(b.material(wall));
  b.quad({-3, 0, -4}, {3, 0, 0}, {0, 2, 0});
  Material box = surface(1, 1, 1, 0, 0.6);
  box.base_color_texture.texture = b.texture(16, 16, nearest, checker);
  box.normal_texture.texture = floor.normal_texture.texture;
  box.normal_scale = 1.5f;
  b.begin_part(b.material(box), true);
  for (const std::uint32_t v : b.quad({0.5, 0, -3}, {2, 0, -1}, {0, 2, 0})) {
    const double s = std::sqrt(5.0);
    VertexAttributes& a = b.attributes(v);
    a.tangent[0] = static_cast<float>(2 / s), a.tangent[2] = static_cast<float>(-1 / s), a.tangent[3] = 1;
  }
  look(g.camera, {0, 1, 1}, {0, 0.6, -3});
  return g;
}

// Panes that cross each other, leaves cut out by their alpha, an opaque ball among them.
GoldenScene transparency() {
  GoldenScene g{"transparency", {}, {}, picture(224, 224, 4)};
  Builder b(g.scene);
  b.begin_part(b.material(surface(0.7, 0.2, 0.2, 0, 0.3)));
  b.sphere({0, 0, 0}, 0.6, 10);
  for (int k = 0; k < 4; ++k) {
    Material pane = surface(0.2 + 0.2 * k, 0.8 - 0.2 * k, 0.5, 0, 0.1 + 0.2 * k);
    pane.base_color[3] = 0.25f + 0.15f * static_cast<float>(k);
    pane.alpha_mode = AlphaMode::blend;
    pane.double_sided = k % 2 == 0;
    b.begin_part(b.material(pane));
    b.quad({-1.2 + 0.2 * k, -0.9, -0.5 + 0.3 * k}, {1.8, 0, 1.5 - 0.9 * k}, {0.1 * k, 1.6, -0.2});
  }
  Material leaf = surface(0.3, 0.7, 0.2, 0, 0.8);
  leaf.alpha_mode = AlphaMode::mask;
  leaf.alpha_cutoff = 0.5f;
  leaf.double_sided = true;
  leaf.base_color_texture.texture = b.texture(32, 32, {}, [](int x, int y) -> std::array<int, 4> {
    const int dx = x - 16, dy = y - 16, d = dx * dx + dy * dy;
    return {255, 255, 255, d < 200 ? 255 - d : 0};
  });
  b.begin_part(b.material(leaf));
  for (int k = 0; k < 5; ++k) b.quad({-1.1 + 0.45 * k, -1, 0.9}, {0.5, 0, -0.2}, {0.05, 0.5, 0.1});
  look(g.camera, {0.4, 0.5, 3.2}, {0, -0.1, 0});
  return g;
}

// All punctual lights, no environment; emissive and unlit surfaces, vertex colours.
GoldenScene lights() {
  GoldenScene g{"lights", {}, {}, picture(240, 160, 2)};
  g.environment = false;
  Builder b(g.scene);
  b.begin_part(b.material(surface(0.8, 0.8, 0.8, 0, 0.35)), false, true);
  for (const std::uint32_t v : b.quad({-4, 0, 3}, {8, 0, 0}, {0, 0, -7})) {
    float* color = b.attributes(v).color;
    color[0] = v % 2 ? 1.0f : 0.3f;
    color[1] = v % 3 ? 0.9f : 0.4f;
  }
  b.begin_part(b.material(surface(0.95, 0.8, 0.5, 1, 0.25)));
  b.sphere({-1, 0.7, 0}, 0.7, 16);
  Material glow = surface(0.1, 0.1, 0.1, 0, 0.5);
  glow.emissive[0] = 2, glow.emissive[1] = 0.5f;
  b.begin_part(b.material(glow));
  b.sphere({1, 0.5, -0.5}, 0.5, 10);
  Material sign = surface(0.2, 0.6, 0.9, 0, 1);
  sign.unlit = true;
  b.begin_part(b.material(sign));
  b.quad({1.6, 0.2, 0.4}, {0.8, 0, -0.3}, {0, 0.9, 0});
  Light sun;
  sun.type = LightType::directional;
  sun.direction[0] = 0.48f, sun.direction[1] = -0.8f, sun.direction[2] = -0.36f;
  sun.intensity = 1.5f;
  Light lamp;
  lamp.position[0] = -2, lamp.position[1] = 1.5f, lamp.position[2] = 1.5f;
  lamp.intensity = 6, lamp.range = 6, lamp.color[2] = 0.4f;
  Light spot;
  spot.type = LightType::spot;
  spot.position[0] = 1, spot.position[1] = 3, spot.position[2] = 1;
  spot.direction[0] = 0, spot.direction[1] = -1, spot.direction[2] = 0;
  spot.intensity = 30, spot.inner_cone_angle = 0.2f, spot.outer_cone_angle = 0.5f, spot.color[0] = 0.5f;
  g.scene.lights = {sun, lamp, spot};
  look(g.camera, {0, 1.8, 5}, {0, 0.5, 0});
  return g;
}

// Slivers, needles, tiny and enormous triangles, some of them flat, some behind the eye; an orthographic view.
GoldenScene soup(bool orthographic) {
  GoldenScene g{
      orthographic ? "soup_orthographic" : "soup_perspective", {}, {}, picture(200, 150, orthographic ? 8 : 16)};
  Builder b(g.scene);
  Random random(orthographic ? 1 : 2);
  for (int m = 0; m < 7; ++m) {
    // One statement each: compilers differ in the order in which they evaluate arguments.
    const double roughness = random.uniform();
    const double blue = random.uniform();
    const double green = random.uniform();
    const double red = random.uniform();
    Material material = surface(red, green, blue, m % 2, roughness);
    material.double_sided = m % 3 != 0;
    b.begin_part(b.material(material));
    for (int k = 0; k < 300; ++k) {
      const double scale = k % 50 == 0 ? 1000 : k % 3 == 0 ? 0.02 : 0.7;
      const Point c = {random.between(-2, 2), random.between(-2, 2), random.between(-4, 3)};
      std::uint32_t v[3];
      for (std::uint32_t& i : v) {
        const double stretch = k % 7 == 0 ? 0.001 : 1;  // needles
        Point n = {random.between(-1, 1), random.between(-1, 1), random.between(0.1, 1)};
        const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (double& x : n) x /= length;
        const double texture_v = random.uniform();
        const double texture_u = random.uniform();
        const Point p = {c[0] + scale * random.between(-1, 1), c[1] + scale * stretch * random.between(-1, 1),
                         c[2] + scale * 0.5 * random.between(-1, 1)};
        i = b.vertex(p, n, texture_u, texture_v);
      }
      b.triangle(v[0], v[1], v[2]);
    }
  }
  look(g.camera, {0, 0, 5}, {0.2, 0.1, 0});
  g.camera.orthographic = orthographic;
  g.camera.vertical_extent = 2.2;
  g.camera.far_plane = orthographic ? 20 : 0;
  g.settings.background = Background::transparent;
  return g;
}

}  // namespace

std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  scenes.push_back(spheres());
  scenes.push_back(textures());
  scenes.push_back(transparency());
  scenes.push_back(lights());
  scenes.push_back(soup(true));
  scenes.push_back(soup(false));
  return scenes;
}

Image golden_environment() {
  Image image(64, 32, 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      float* p = image.at(x, y);
      const float up = 1 - static_cast<float>(y) / 16;
      const float side = static_cast<float>(x) / 64;
      if (up > 0)
        p[0] = 0.6f - 0.4f * up + 0.2f * side, p[1] = 0.7f - 0.25f * up, p[2] = 0.9f;
      else
        p[0] = 0.25f, p[1] = 0.2f + 0.1f * side, p[2] = 0.15f;
      if (y >= 6 && y < 8 && x >= 40 && x < 42) p[0] = 60, p[1] = 50, p[2] = 40;
    }
  return image;
}

}  // namespace tessera::golden

// What each thing that a picture's content calls for costs: one wall of 16 x 9 cells of two triangles each that fills
// 1920 x 1080 pixels, on one thread, with one feature after another. "unused/..." has the feature in one corner of the
// picture alone: the rest must not pay for it.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "frame/dispatch.hpp"
#include "frame/frame.hpp"
#include "precompute/environment.hpp"
#include "tests/golden/builder.hpp"

namespace tessera {
namespace {

struct Content {
  const char* name;
  int lights = 4;
  bool environment = true, emissive = false, unlit = false, colors = false, base_texture = false, all_textures = false,
       mask = false, blend = false, two_materials = false, corner_alone = false, nothing = false;
  int samples = 1;
};

constexpr Content contents[] = {
    {.name = "plain"},
    {.name = "no_lights", .lights = 0},
    {.name = "no_environment", .environment = false},
    {.name = "one_light", .lights = 1},
    {.name = "emissive", .emissive = true},
    {.name = "unlit", .unlit = true},
    {.name = "vertex_colors", .colors = true},
    {.name = "base_color_texture", .base_texture = true},
    {.name = "all_textures", .all_textures = true},
    {.name = "alpha_mask", .base_texture = true, .mask = true},
    {.name = "alpha_blend", .base_texture = true, .blend = true},
    {.name = "two_materials", .two_materials = true},
    {.name = "four_samples", .samples = 4},
    {.name = "nothing", .nothing = true},
    {.name = "unused/emissive", .emissive = true, .corner_alone = true},
    {.name = "unused/unlit", .unlit = true, .corner_alone = true},
    {.name = "unused/all_textures", .all_textures = true, .corner_alone = true},
    {.name = "unused/alpha_blend", .base_texture = true, .blend = true, .corner_alone = true},
};

Material special(const Content& c, golden::Builder& builder) {
  Material m;
  m.metallic = 0.25f;
  m.roughness = 0.5f;
  if (c.emissive) m.emissive[1] = 0.5f;
  m.unlit = c.unlit;
  if (c.mask) m.alpha_mode = AlphaMode::mask;
  if (c.blend) m.alpha_mode = AlphaMode::blend;
  const auto texture = [&](int seed) {
    return builder.texture(512, 512, {}, [seed](int x, int y) {
      return std::array<int, 4>{(x * 5 + seed) % 256, (y * 3 + seed) % 256, 192, 128 + (x ^ y) % 128};
    });
  };
  if (c.base_texture || c.all_textures) m.base_color_texture.texture = texture(1);
  if (c.all_textures) {
    m.metallic_roughness_texture.texture = m.occlusion_texture.texture = texture(2);
    m.normal_texture.texture = texture(3);
    m.emissive_texture.texture = texture(4);
    for (float& e : m.emissive) e = 1;
  }
  return m;
}

Scene make_wall(const Content& c) {
  Scene scene;
  golden::Builder builder(scene);
  const Material with = special(c, builder);
  const int marked = builder.material(with), plain = builder.material(special({.name = ""}, builder));
  for (int j = 0; j < 9 && !c.nothing; ++j)
    for (int i = 0; i < 16; ++i) {
      const bool marks = c.corner_alone ? i == 0 && j == 0 : !c.two_materials || (i + j) % 2 == 0;
      builder.begin_part(marks ? marked : plain, false, marks && c.colors);
      builder.quad({double(i) - 8, double(j) - 4.5, 0}, {1, 0, 0}, {0, 1, 0});
    }
  for (int k = 0; k < c.lights; ++k) {
    Light light;
    light.position[0] = float(4 * k - 6);
    light.position[2] = 3;
    light.intensity = 20;
    scene.lights.push_back(light);
  }
  return scene;
}

void content(benchmark::State& state, const Kernels* kernels, const Content* c) {
  const Scene scene = make_wall(*c);
  const Environment environment = constant_environment(0.4f, 0.5f, 0.6f, *kernels);
  RenderSettings settings;
  settings.samples = c->samples;
  settings.threads = 1;
  settings.background = Background::color;
  settings.hash = false;
  Camera camera;
  camera.eye[2] = 10;
  camera.orthographic = true;
  camera.vertical_extent = 4.5;
  camera.near_plane = 1;
  camera.far_plane = 20;
  const View view = make_view(camera, settings.width, settings.height, *kernels);
  Renderer renderer(scene, c->environment ? &environment : nullptr, *kernels);
  Frame frame;
  renderer.render(view, settings, {}, frame);
  for (auto _ : state) renderer.render(view, settings, {}, frame);
  const FrameStatistics& f = frame.statistics;
  const double pixels = double(settings.width) * settings.height;
  state.counters["ns_per_pixel"] = f.total_ms * 1e6 / pixels;
  for (std::size_t k = first_tile_stage; k < stage_names.size(); ++k)
    if (f.stage_ms[k] > 0) state.counters[stage_names[k]] = f.stage_ms[k] * 1e6 / pixels;
}

const bool registered = [] {
  for (const Kernels* k : built_kernels()) {
    if (!cpu_runs(*k) || k->lanes < 8) continue;
    for (const Content& c : contents)
      benchmark::RegisterBenchmark((std::string("content/") + k->isa + "/" + c.name).c_str(), content, k, &c)
          ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace tessera

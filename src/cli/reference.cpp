// tessera reference: what a frame's light from the environment should have been, by Monte Carlo in double.
#include <atomic>
#include <cmath>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "cli/camera.hpp"
#include "cli/commands.hpp"
#include "cli/lighting.hpp"
#include "cli/machine.hpp"
#include "cli/neutral_environment.hpp"
#include "cli/parse.hpp"
#include "cli/picture.hpp"
#include "cli/prefilter_check.hpp"
#include "cli/text.hpp"
#include "frame/dispatch.hpp"
#include "frame/environment_file.hpp"
#include "frame/gbuffer_file.hpp"
#include "io/gltf.hpp"
#include "reference/environment_shade.hpp"

namespace tessera::cli {
namespace {

constexpr const char* footer =
    R"(Rasterizes the scene as 'tessera render' does, and gives each surface in a pixel the integral of its BRDF over the
environment, in double precision: no prefiltered levels, no split sum, no table. Light from several facets is Kulla and
Conty's, diffuse light what the specular lobe leaves; lights are added by the same formulas as in a render, in double.
Visibility is not traced, as in a render: what differs between the two pictures is the shading.

The EXR has the layers R G B A and error.R error.G error.B: the standard error of the mean (with several samples per pixel,
a bound on it). The same command gives the same picture for any number of threads.

Examples:
  tessera reference scene.glb --env courtyard.exr -o truth.exr
  tessera reference scene.glb --env courtyard.exr --size 320x180 --rays 4096 -o truth.exr)";

struct Options {
  std::string scene, size = "640x360", output;
  int samples = 1, rays = 256;
  std::uint64_t seed = 1;
  CameraOptions camera;
  LightingOptions lighting;
  MachineOptions machine;
};

using reference::Vec3;

// The picture as the renderer takes it: grey spread to RGB, what is negative or not finite as 0.
reference::SpherePicture sphere_picture(const EnvironmentPicture& picture, double intensity) {
  const Image& image = picture.image;
  reference::SpherePicture out{image.width, image.height, {}, picture.faces};
  out.rgb.reserve(std::size_t(image.width) * std::size_t(image.height) * 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y)[image.channels < 3 ? 0 : c];
        out.rgb.push_back(std::isfinite(value) && value > 0 ? float(double(value) * intensity) : 0.0f);
      }
  return out;
}

struct Light360 {
  reference::EnvironmentMap map;
  ChosenEnvironment shown;  // for the background, and a light that was taken out
};

Light360 load_environment(const LightingOptions& lighting, const Kernels& kernels) {
  ChosenEnvironment shown = make_environment(lighting, {}, false, kernels);
  const double rotation = lighting.rotation * radians_per_degree;
  if (shown.neutral)
    return {{sphere_picture({neutral_environment(), false}, lighting.intensity), rotation}, std::move(shown)};
  if (is_baked_environment(lighting.environment))
    return {{as_sphere(shown.environment->data().background.load(0, kernels)), 0}, std::move(shown)};
  const EnvironmentPicture picture = read_environment_picture({lighting.environment}, lighting.layout, kernels);
  return {{sphere_picture(picture, lighting.intensity), rotation}, std::move(shown)};
}

reference::ShadeLight reference_light(const Light& light) {
  reference::ShadeLight out;
  out.type = static_cast<reference::ShadeLight::Type>(light.type);
  out.position = {double(light.position[0]), double(light.position[1]), double(light.position[2])};
  out.direction = normalize(Vec3{double(light.direction[0]), double(light.direction[1]), double(light.direction[2])});
  const double intensity = double(light.intensity);
  out.color = {double(light.color[0]) * intensity, double(light.color[1]) * intensity,
               double(light.color[2]) * intensity};
  out.range = double(light.range);
  out.cos_inner = std::cos(double(light.inner_cone_angle));
  out.cos_outer = std::cos(double(light.outer_cone_angle));
  return out;
}

// Every fragment's radiance in place of the G-buffer's emission; a second G-buffer gets the variance.
struct Truth {
  GBufferImage radiance, variance;
};

reference::ShadeSurface surface_of(const GBufferImage& g, std::size_t i) {
  const auto vector = [&](std::size_t k) {
    return Vec3{double(g.planes[k][i]), double(g.planes[k + 1][i]), double(g.planes[k + 2][i])};
  };
  reference::ShadeSurface s;
  s.position = vector(0);
  s.normal = vector(3);
  s.base_color = vector(6);
  s.metallic = double(g.planes[9][i]);
  s.roughness = std::clamp(double(g.planes[10][i]), 0.0, 1.0);
  s.occlusion = double(g.planes[11][i]);
  s.emissive = vector(12);
  s.unlit = g.planes[16][i] > 0.5f;
  return s;
}

Truth integrate(const GBufferImage& gbuffer, const View& view, const std::vector<reference::ShadeLight>& lights,
                const reference::EnvironmentMap& map, const Options& options, Progress& progress) {
  const reference::EnergyTable table;
  Truth truth{gbuffer, gbuffer};
  const std::size_t count = gbuffer.fragment_count(), piece = 256;
  std::atomic<std::size_t> done{0};
  const float* e = view.transform.eye;
  const Vec3 eye{double(e[0]), double(e[1]), double(e[2])};
  parallel_for((count + piece - 1) / piece, [&](std::size_t p) {
    for (std::size_t i = p * piece; i < std::min(count, (p + 1) * piece); ++i) {
      const reference::ShadeSurface s = surface_of(gbuffer, i);
      const Vec3 v = e[3] == 0 ? eye : normalize(eye - s.position);
      Vec3 sum = shade(s, e[3] == 0 ? s.position + eye : eye, lights, {}), variance;
      if (!s.unlit && length(s.normal) > 0.5) {
        reference::ShadeSurface unit = s;
        unit.normal = normalize(s.normal);
        const auto estimate =
            integrate_environment(unit, v, map, table, options.rays, options.seed * 0x9e3779b97f4a7c15u + i);
        sum = sum + estimate.mean;
        variance = estimate.error * estimate.error;
      }
      const double values[2][3] = {{sum.x, sum.y, sum.z}, {variance.x, variance.y, variance.z}};
      for (int k = 0; k < 2; ++k) {
        GBufferImage& out = k == 0 ? truth.radiance : truth.variance;
        for (std::size_t c = 0; c < 3; ++c) out.planes[12 + c][i] = float(values[k][c]);
        out.planes[16][i] = 0;  // not unlit: the emission is what is to be seen
      }
    }
    const std::size_t now = done.fetch_add(1, std::memory_order_relaxed) + 1;
    progress.set_fraction(now, (count + piece - 1) / piece);
  });
  return truth;
}

GBufferFile rasterize(const Options& options, const Kernels& kernels, const RenderSettings& settings) {
  GBufferFile file;
  Scene scene = load_gltf(options.scene);
  const double aspect = double(settings.width) / settings.height;
  file.view =
      make_view(choose_camera(options.camera, scene, aspect, kernels), settings.width, settings.height, kernels);
  file.lights = scene.lights;
  Renderer renderer(scene, nullptr, kernels);
  Frame frame;
  renderer.render(*file.view, settings, {{}, true}, frame);
  file.image = std::move(frame.gbuffer);
  return file;
}

// Composites what the fragments hold, as the renderer does, over nothing.
Image composited(const GBufferImage& gbuffer, const View& view, RenderSettings settings, const Kernels& kernels) {
  settings.background = Background::transparent;
  Frame frame;
  shade_gbuffer(gbuffer, view, {}, nullptr, settings, kernels, frame);
  return std::move(frame.rgba);
}

void write_truth(const std::string& path, const Image& picture, const Image& variance) {
  const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
  std::vector<float> error(pixels * 3);
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) error[i * 3 + c] = std::sqrt(variance.pixels[i * 4 + c]);
  std::vector<ExrChannel> channels;
  const char* names[4] = {"R", "G", "B", "A"};
  for (std::size_t c = 0; c < 4; ++c) channels.push_back({names[c], &picture.pixels[c], nullptr, 4});
  for (std::size_t c = 0; c < 3; ++c) channels.push_back({std::string("error.") + names[c], &error[c], nullptr, 3});
  write_exr(path, picture.width, picture.height, channels);
}

void run_reference(const Options& options) {
  const Stopwatch watch;
  validate(options.machine);
  const Kernels& kernels = select_kernels(options.machine.isa);
  if (options.rays < 1 || options.rays > 1 << 24)
    throw usage_error("--rays {}: expected 1 to {}", options.rays, 1 << 24);
  if (!options.output.ends_with(".exr")) throw usage_error("-o {}: expected a name that ends in .exr", options.output);
  check_writable(options.output);
  RenderSettings settings;
  const std::array<int, 2> size = parse_size(options.size);
  settings.width = size[0];
  settings.height = size[1];
  settings.samples = options.samples;
  settings.threads = options.machine.threads;
  validate(settings);
  std::vector<Light> lights = parse_lights(options.lighting);
  Progress progress(options.machine.quiet ? Progress::Show::never : Progress::Show::on_terminal);
  Image picture, variance;
  run_with_threads(settings.threads, [&] {
    progress.begin("reading " + printable(options.scene));
    const GBufferFile file = rasterize(options, kernels, settings);
    lights.insert(lights.begin(), file.lights.begin(), file.lights.end());
    progress.begin("preparing the environment");
    const Light360 around = load_environment(options.lighting, kernels);
    lights.insert(lights.end(), around.shown.lights.begin(), around.shown.lights.end());
    std::vector<reference::ShadeLight> exact;
    for (const Light& light : lights) exact.push_back(reference_light(light));
    progress.begin("integrating");
    const Truth truth = integrate(file.image, *file.view, exact, around.map, options, progress);
    picture = composited(truth.radiance, *file.view, settings, kernels);
    variance = composited(truth.variance, *file.view, settings, kernels);
    // Behind it, the environment as a render shows it.
    GBufferImage nothing;
    nothing.width = settings.width;
    nothing.height = settings.height;
    nothing.samples = settings.samples;
    nothing.counts.assign(std::size_t(settings.width) * std::size_t(settings.height), 0);
    Frame back;
    shade_gbuffer(nothing, *file.view, {}, around.shown.environment.get(), settings, kernels, back);
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
      for (std::size_t c = 0; c < 4; ++c)
        picture.pixels[i + c] += (1 - picture.pixels[i + 3]) * (c < 3 ? back.rgba.pixels[i + c] : 1);
    progress.begin("writing " + printable(options.output));
    write_truth(options.output, picture, variance);
  });
  progress.finish();
  if (options.machine.quiet) return;
  double error = 0, light = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); i += 4) {
    error += std::sqrt(double(variance.pixels[i + 1]));
    light += double(picture.pixels[i + 1]);
  }
  note(fmt::format("{} x {}, {} rays: {:.1f} s; mean standard error {:.2g} of the mean radiance (green)",
                   settings.width, settings.height, 3 * options.rays, watch.ms() / 1000,
                   light > 0 ? error / light : 0));
}

}  // namespace

void add_reference(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("reference", "Ground truth of a frame lit by an environment, by Monte Carlo");
  auto options = std::make_shared<Options>();
  command->add_option("scene", options->scene, "A .gltf or .glb file")->required();
  command->add_option("-o,--output", options->output, "An .exr file")->type_name("FILE")->required();
  const std::string group = "Picture";
  command->add_option("--size", options->size, "Pixels")->type_name("WxH")->capture_default_str()->group(group);
  command->add_option("--samples", options->samples, "Samples per pixel: 1, 2, 4, 8 or 16")
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  command->add_option("--rays", options->rays, "Rounds of three directions for each surface in a pixel")
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  command->add_option("--seed", options->seed, "Of the random numbers")
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  add_camera_options(*command, options->camera);
  add_lighting_options(*command, options->lighting);
  add_running_options(*command, options->machine);
  command->footer(footer);
  command->callback([options] { run_reference(*options); });
}

}  // namespace tessera::cli

// tessera render: a glTF scene into a picture.
#include <algorithm>
#include <optional>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "cli/camera.hpp"
#include "cli/commands.hpp"
#include "cli/lighting.hpp"
#include "cli/machine.hpp"
#include "cli/parse.hpp"
#include "cli/picture.hpp"
#include "cli/profile.hpp"
#include "cli/report.hpp"
#include "cli/text.hpp"
#include "cli/texture_options.hpp"
#include "frame/dispatch.hpp"
#include "frame/gbuffer_file.hpp"
#include "frame/settings_file.hpp"
#include "io/gltf.hpp"

namespace tessera::cli {
namespace {

struct Options {
  std::string scene, size = "1920x1080", aovs;
  std::string settings;        // a file
  std::optional<int> samples;  // not given: that file's, or the default
  CameraOptions camera;
  LightingOptions lighting;
  TextureOptions textures;
  PictureOptions picture;
  MachineOptions machine;
};

// Which layers are wanted, and where they go.
struct LayerPlan {
  FrameRequest request;
  std::string layers_path;   // of a file of their own, beside a PNG
  std::string gbuffer_path;  // always a file of its own: it may be deep
};

LayerPlan plan_layers(const std::string& text, const PicturePlan& picture) {
  LayerPlan plan;
  if (text.empty()) return plan;
  for (const std::string& name : parse_words("--aov", text)) {
    const std::vector<std::string>& known = aov_names();
    if (name == "gbuffer") {
      plan.request.gbuffer = true;
    } else if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw usage_error("--aov '{}': unknown layer; expected gbuffer or some of {}", name, fmt::join(known, ", "));
    } else if (std::find(plan.request.aovs.begin(), plan.request.aovs.end(), name) == plan.request.aovs.end()) {
      plan.request.aovs.push_back(name);
    }
  }
  if (picture.path == "-" && (plan.request.gbuffer || !picture.exr))
    throw usage_error("--aov {}: these layers need a file of their own, and '-o -' leaves no name for it", text);
  if (plan.request.gbuffer) plan.gbuffer_path = picture.beside("gbuffer");
  if (!plan.request.aovs.empty() && !picture.exr) plan.layers_path = picture.beside("aov");
  return plan;
}

void write_gbuffer(const std::string& path, const GBufferImage& image, const View& view,
                   const std::vector<Light>& lights) {
  const auto attributes = gbuffer_attributes(image, view, lights);
  if (!image.is_flat()) {
    write_deep_gbuffer(path, image, attributes);
    return;
  }
  FlatPlanes planes;
  const std::vector<ExrChannel> channels = flat_gbuffer_channels(image, planes);
  write_exr(path, image.width, image.height, channels, attributes);
}

void warn_about(const GltfReport& report) {
  for (const std::string& warning : report.warnings) warn(warning);
}

void run_render(const Options& options) {
  const Stopwatch total;
  RunReport run;
  run.command = "render";
  run.scene = options.scene;
  run.output = options.picture.output;
  validate(options.machine);
  const Kernels& kernels = select_kernels(options.machine.isa);
  const PicturePlan picture = plan_picture(options.picture, kernels);
  const LayerPlan layers = plan_layers(options.aovs, picture);
  check_machine_outputs(options.machine, picture.path);
  RenderSettings settings;
  const std::array<int, 2> size = parse_size(options.size);
  if (!options.settings.empty()) read_settings(options.settings, settings);
  settings.width = size[0];
  settings.height = size[1];
  settings.samples = options.samples.value_or(settings.samples);
  settings.threads = options.machine.threads;
  settings.trace = !options.machine.trace.empty();
  apply_lighting_options(options.lighting, settings);
  apply_texture_options(options.textures, settings);
  set_background(options.picture, false, kernels, settings);
  validate(settings);
  const std::vector<Light> extra_lights = parse_lights(options.lighting);

  Progress progress(options.machine.quiet ? Progress::Show::never : Progress::Show::on_terminal);
  const auto with_threads = [&](const std::function<void()>& work) { run_with_threads(settings.threads, work); };

  progress.begin("reading " + printable(options.scene));
  Stopwatch watch;
  GltfReport report;
  Scene scene;
  with_threads([&] { scene = load_gltf(options.scene, &report); });
  run.load_ms = watch.ms();
  run.end_phase("read");
  run.scene_triangles = scene.triangles.size();
  // What the file brings travels with a G-buffer; what the command line adds, it adds to `shade` again.
  const std::vector<Light> file_lights = scene.lights;
  scene.lights.insert(scene.lights.end(), extra_lights.begin(), extra_lights.end());
  const Camera camera =
      choose_camera(options.camera, scene, static_cast<double>(settings.width) / settings.height, kernels);
  const View view = make_view(camera, settings.width, settings.height, kernels);

  progress.begin("preparing the environment");
  watch = {};
  ChosenEnvironment environment;
  with_threads([&] { environment = make_environment(options.lighting, settings, !scene.lights.empty(), kernels); });
  run.environment_ms = watch.ms();
  run.end_phase("environment");
  scene.lights.insert(scene.lights.end(), environment.lights.begin(), environment.lights.end());
  set_background(options.picture, environment.neutral, kernels, settings);

  progress.begin("preparing the scene");
  Frame frame;
  {
    std::unique_ptr<Renderer> renderer;
    with_threads(
        [&] { renderer = std::make_unique<Renderer>(scene, environment.environment.get(), kernels, settings); });
    run.end_phase("prepare");
    progress.begin("rendering");
    settings.progress = [&](std::size_t done, std::size_t all) { progress.set_fraction(done, all); };
    renderer->render(view, settings, layers.request, frame);
  }
  run.frame = frame.statistics;
  run.end_phase("render");

  progress.begin("writing " + printable(picture.path));
  with_threads([&] { write_picture(picture, frame, settings.background, kernels, run.encode_ms, run.write_ms); });
  watch = {};
  if (!layers.layers_path.empty()) write_layers(layers.layers_path, frame);
  if (!layers.gbuffer_path.empty()) write_gbuffer(layers.gbuffer_path, frame.gbuffer, view, file_lights);
  run.write_ms += watch.ms();
  run.end_phase("write");
  progress.finish();

  run.width = settings.width;
  run.height = settings.height;
  run.samples = settings.samples;
  run.total_ms = total.ms();
  if (!options.machine.quiet) {
    warn_about(report);
    if (scene.triangles.empty()) warn(options.scene + ": nothing to see: the scene has no triangles");
    for (const std::string& warning : environment.warnings) warn(warning);
    if (environment.neutral) note("no --env and no lights: lit by a neutral studio");
    if (!layers.layers_path.empty()) note("layers: " + layers.layers_path);
    if (!layers.gbuffer_path.empty()) note("G-buffer: " + layers.gbuffer_path);
    tell(run);
  }
  report_to(options.machine, run);
}

std::string footer() {
  return fmt::format(R"(Examples:
  tessera render scene.glb --env courtyard.exr -o out.png
  tessera render scene.glb --orbit 30,20 --background transparent --samples 16 -o out.png
  tessera render scene.glb --eye 0,1,4 --target 0,0.5,0 --fov 30 --light point:2,3,2:40:1,0.9,0.8 -o out.png
  tessera render scene.glb --env courtyard.exr -o - --size 640x360 | display

{}

Layers (--aov), float channels of the EXR that -o names; beside NAME.png they go to NAME.aov.exr:
  {}
  gbuffer    all that 'tessera shade' needs to light the picture again, in NAME.gbuffer.exr
             (a deep EXR where a pixel holds several surfaces))",
                     lighting_help, fmt::join(aov_names(), ", "));
}

}  // namespace

void add_render(CLI::App& program) {
  CLI::App* command = program.add_subcommand("render", "Renders a glTF scene into a PNG or EXR");
  auto options = std::make_shared<Options>();
  command->add_option("scene", options->scene, "A .gltf or .glb file")->required();
  command->add_option("--size", options->size, "Pixels")->type_name("WxH")->capture_default_str()->group("Picture");
  add_picture_options(*command, options->picture);
  command->add_option("--samples", options->samples, "Samples per pixel: 1, 2, 4, 8 or 16")
      ->type_name("N")
      ->default_str(std::to_string(RenderSettings{}.samples))
      ->group("Picture");
  command
      ->add_option("--settings", options->settings,
                   "A file of 'tessera tune': samples, and options of light and textures; those given here win")
      ->type_name("FILE.json")
      ->group("Picture");
  command->add_option("--aov", options->aovs, "More layers to write, with commas between them: see below")
      ->type_name("LIST")
      ->group("Picture");
  add_camera_options(*command, options->camera);
  add_lighting_options(*command, options->lighting);
  add_texture_options(*command, options->textures);
  add_machine_options(*command, options->machine);
  command->footer(footer());
  command->callback([options] { run_render(*options); });
}

}  // namespace tessera::cli

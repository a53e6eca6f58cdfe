// tessera shade: a G-buffer from a file, ours or another program's, into a picture.
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "cli/camera.hpp"
#include "cli/commands.hpp"
#include "cli/lighting.hpp"
#include "cli/machine.hpp"
#include "cli/picture.hpp"
#include "cli/profile.hpp"
#include "cli/report.hpp"
#include "cli/text.hpp"
#include "frame/dispatch.hpp"
#include "frame/gbuffer_file.hpp"

namespace tessera::cli {
namespace {

struct Options {
  std::string gbuffer;
  bool no_file_lights = false;
  CameraOptions camera;
  LightingOptions lighting;
  PictureOptions picture;
  MachineOptions machine;
};

// The file's own view, or the one of the options. Only the eye and the rays of the background are used.
View choose_view(const Options& options, const GBufferFile& file, const Kernels& kernels) {
  if (options.camera.eye.empty()) {
    if (file.view) return *file.view;
    throw usage_error("{}: the file does not say where the eye was: add --eye x,y,z (and --target, --up, --fov)",
                      options.gbuffer);
  }
  Bounds bounds;  // of the whole picture: its surfaces' box
  for (int k = 0; k < 3; ++k) {
    const AlignedVector<float>& plane = file.image.planes[static_cast<std::size_t>(k)];
    if (plane.empty()) continue;
    const auto [least, most] = std::minmax_element(plane.begin(), plane.end());
    bounds.center[k] = 0.5 * (static_cast<double>(*least) + static_cast<double>(*most));
  }
  return make_view(placed_camera(options.camera, bounds), file.image.width, file.image.height, kernels);
}

void run_shade(const Options& options) {
  const Stopwatch total;
  RunReport run;
  run.command = "shade";
  run.scene = options.gbuffer;
  run.output = options.picture.output;
  validate(options.machine);
  const Kernels& kernels = select_kernels(options.machine.isa);
  const PicturePlan picture = plan_picture(options.picture, kernels);
  check_machine_outputs(options.machine, picture.path);
  const std::vector<Light> extra_lights = parse_lights(options.lighting);
  RenderSettings settings;
  settings.threads = options.machine.threads;
  settings.trace = !options.machine.trace.empty();
  apply_lighting_options(options.lighting, settings);
  set_background(options.picture, false, kernels, settings);

  Progress progress(options.machine.quiet ? Progress::Show::never : Progress::Show::on_terminal);
  const auto with_threads = [&](const std::function<void()>& work) { run_with_threads(settings.threads, work); };
  progress.begin("reading " + printable(options.gbuffer));
  Stopwatch watch;
  GBufferFile file;
  with_threads([&] { file = read_gbuffer(options.gbuffer); });
  run.load_ms = watch.ms();
  run.end_phase("read");
  settings.width = file.image.width;
  settings.height = file.image.height;
  settings.samples = file.image.samples;
  validate(settings);
  const View view = choose_view(options, file, kernels);
  std::vector<Light> lights;
  if (!options.no_file_lights) lights = file.lights;
  lights.insert(lights.end(), extra_lights.begin(), extra_lights.end());

  progress.begin("preparing the environment");
  watch = {};
  ChosenEnvironment environment;
  with_threads([&] { environment = make_environment(options.lighting, settings, !lights.empty(), kernels); });
  run.environment_ms = watch.ms();
  run.end_phase("environment");
  lights.insert(lights.end(), environment.lights.begin(), environment.lights.end());
  set_background(options.picture, environment.neutral, kernels, settings);

  progress.begin("shading");
  settings.progress = [&](std::size_t done, std::size_t all) { progress.set_fraction(done, all); };
  Frame frame;
  shade_gbuffer(file.image, view, lights, environment.environment.get(), settings, kernels, frame);
  run.frame = frame.statistics;
  run.end_phase("shade");

  progress.begin("writing " + printable(picture.path));
  with_threads([&] { write_picture(picture, frame, settings.background, kernels, run.encode_ms, run.write_ms); });
  progress.finish();
  run.end_phase("write");
  run.width = settings.width;
  run.height = settings.height;
  run.samples = settings.samples;
  run.total_ms = total.ms();
  if (!options.machine.quiet) {
    for (const std::string& warning : environment.warnings) warn(warning);
    if (environment.neutral) note("no --env and no lights: lit by a neutral studio");
    tell(run);
  }
  report_to(options.machine, run);
}

// One line per channel, made from the table that reads them.
std::string layer_list() {
  std::string text;
  for (const GBufferPlane& plane : gbuffer_plane_names)
    text += fmt::format("  {:<14}{}\n", plane.name,
                        plane.required ? "required" : fmt::format("{:g} where the file has none", plane.absent));
  return text;
}

std::string footer() {
  return fmt::format(
      R"(A G-buffer comes from 'tessera render SCENE --aov gbuffer -o NAME.png' (as NAME.gbuffer.exr), and then gives the same
pixels as that render, bit for bit, under the same --env, --light and --background. Or from any program that writes
these float channels into an EXR:
{}  triangle      optional, uint: which triangle was seen
  coverage_mask optional, uint: bit s tells that sample s is covered. Without it a pixel is empty where the normal is 0

position: world space, +Y up. normal: unit length, on the eye's side. albedo and emissive: linear Rec.709 (emissive is
radiance). roughness: perceptual, 0 to 1. alpha: 1 opaque. unlit: 1 shows albedo without light. depth.Z: reversed, larger is
nearer. Several surfaces in a pixel: a deep EXR.

Examples:
  tessera render scene.glb --env a.exr --aov gbuffer -o scene.png
  tessera shade scene.gbuffer.exr --env b.exr -o other-light.png

{})",
      layer_list(), lighting_help);
}

}  // namespace

void add_shade(CLI::App& program) {
  CLI::App* command = program.add_subcommand("shade", "Lights a G-buffer from an EXR, without its scene");
  auto options = std::make_shared<Options>();
  command->add_option("gbuffer", options->gbuffer, "An EXR with the layers named below")->required();
  add_picture_options(*command, options->picture);
  const std::string group = "Camera, for files that do not tell theirs";
  CameraOptions& camera = options->camera;
  auto* eye = command->add_option("--eye", camera.eye, "Where the eye was")->type_name("X,Y,Z")->group(group);
  command->add_option("--target", camera.target, "What it looked at: matters only for --background env")
      ->type_name("X,Y,Z")
      ->needs(eye)
      ->group(group);
  command->add_option("--up", camera.up, "Upwards (default: 0,1,0)")->type_name("X,Y,Z")->needs(eye)->group(group);
  command->add_option("--fov", camera.fov, "Vertical field of view, degrees")
      ->type_name("DEGREES")
      ->needs(eye)
      ->capture_default_str()
      ->group(group);
  add_lighting_options(*command, options->lighting);
  command->add_flag("--no-file-lights", options->no_file_lights, "Leave out the lights that the G-buffer brings")
      ->group("Light");
  add_machine_options(*command, options->machine);
  command->footer(footer());
  command->callback([options] { run_shade(*options); });
}

}  // namespace tessera::cli

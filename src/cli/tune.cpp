// tessera tune: the cheapest settings that stay within an error, measured on a scene.
#include <algorithm>
#include <cstdio>
#include <limits>
#include <optional>
#include <set>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "cli/camera.hpp"
#include "cli/commands.hpp"
#include "cli/lighting.hpp"
#include "cli/machine.hpp"
#include "cli/parse.hpp"
#include "cli/picture.hpp"
#include "cli/text.hpp"
#include "cli/texture_options.hpp"
#include "cli/tune_report.hpp"
#include "cli/tune_subject.hpp"
#include "frame/dispatch.hpp"
#include "frame/settings_file.hpp"
#include "io/gltf.hpp"
#include "io/output_file.hpp"

namespace tessera::cli {
namespace {

struct Options {
  std::string scene, size = "1920x1080", results, chart;
  double max_error = 1;
  std::optional<double> max_p99;
  int frames = 5;
  std::optional<int> samples;
  CameraOptions camera;
  LightingOptions lighting;
  TextureOptions textures;
  PictureOptions picture;  // its output is the file of settings
  MachineOptions machine;
};

PictureError check(const Options& options) {
  validate(options.machine);
  if (!(options.max_error >= 0 && options.max_error <= 255))
    throw usage_error("--max-error {}: expected 0 to 255 display steps", options.max_error);
  if (options.max_p99 && !(*options.max_p99 >= 0 && *options.max_p99 <= 255))
    throw usage_error("--max-p99 {}: expected 0 to 255 display steps", *options.max_p99);
  if (options.frames < 1 || options.frames > 1000) throw usage_error("--frames {}: expected 1 to 1000", options.frames);
  if ((options.picture.output == "-") + (options.results == "-") + (options.chart == "-") > 1)
    throw usage_error("only one of -o, --results and --chart can be standard output");
  for (const std::string& path : {options.picture.output, options.results, options.chart})
    if (!path.empty()) check_writable(path);
  return {options.max_error, options.max_p99.value_or(std::numeric_limits<double>::infinity())};
}

// What a person has chosen goes into settings and is not varied: the keys of that.
std::set<std::string> take_given(const Options& options, RenderSettings& settings) {
  settings.samples = options.samples.value_or(settings.samples);
  apply_lighting_options(options.lighting, settings);
  apply_texture_options(options.textures, settings);
  const LightingOptions& light = options.lighting;
  std::set<std::string> given;
  for (const auto& [key, chosen] : {std::pair{"samples", options.samples.has_value()},
                                    {"env-lobe", !light.lobe.empty()},
                                    {"env-fresnel", !light.fresnel.empty()},
                                    {"specular-occlusion", light.specular_occlusion != 0},
                                    {"env-albedo", !light.albedo.empty()},
                                    {"env-size", light.size.has_value()},
                                    {"env-texels", !light.texels.empty()},
                                    {"env-irradiance", !light.irradiance.empty()},
                                    {"light-cutoff", light.cutoff.has_value()},
                                    {"texture-filter", !options.textures.filter.empty()},
                                    {"color-texels", !options.textures.colors.empty()}})
    if (chosen) given.insert(key);
  return given;
}

// Sizes of reflections that are worth a try.
std::vector<int> sizes_of(const Environment& environment) {
  std::vector<int> sizes;
  for (int size = std::min(environment.data().background.size(), 512); size >= 32; size /= 2) sizes.push_back(size);
  return sizes;
}

TuneTraits traits_of(const Scene& scene, const ChosenEnvironment& environment, const Look& look) {
  TuneTraits traits = cli::traits_of(scene);
  traits.exposure = look.exposure;
  if (environment.environment == nullptr) return traits;
  const EnvironmentData& data = environment.environment->data();
  traits.environment = true;
  traits.irradiance_cube = !data.irradiance.empty();
  traits.irradiance_from_cube = data.uses_cube;
  if (environment.bake) traits.environment_sizes = sizes_of(*environment.environment);
  return traits;
}

void write_text(const std::string& path, const std::string& text) {
  OutputFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

void run_tune(const Options& options) {
  const PictureError limit = check(options);
  const Kernels& kernels = select_kernels(options.machine.isa);
  const Look look = plan_look(options.picture, kernels);
  RenderSettings settings;
  const std::array<int, 2> size = parse_size(options.size);
  settings.width = size[0];
  settings.height = size[1];
  settings.threads = options.machine.threads;
  settings.hash = false;
  set_background(options.picture, false, kernels, settings);
  const std::set<std::string> given = take_given(options, settings);
  validate(settings);
  if (settings.background == Background::transparent)
    throw usage_error("--background transparent: a display shows no such thing; expected env or a colour");
  const std::vector<Light> extra_lights = parse_lights(options.lighting);

  Progress progress(options.machine.quiet ? Progress::Show::never : Progress::Show::on_terminal);
  const auto with_threads = [&](const std::function<void()>& work) { run_with_threads(settings.threads, work); };
  progress.begin("reading " + printable(options.scene));
  GltfReport read;
  Scene scene;
  with_threads([&] { scene = load_gltf(options.scene, &read); });
  scene.lights.insert(scene.lights.end(), extra_lights.begin(), extra_lights.end());
  const Camera camera =
      choose_camera(options.camera, scene, static_cast<double>(settings.width) / settings.height, kernels);
  const View view = make_view(camera, settings.width, settings.height, kernels);

  progress.begin("preparing");
  ChosenEnvironment environment;
  with_threads(
      [&] { environment = make_environment(options.lighting, settings, !scene.lights.empty(), kernels, true); });
  scene.lights.insert(scene.lights.end(), environment.lights.begin(), environment.lights.end());
  set_background(options.picture, environment.neutral, kernels, settings);
  std::unique_ptr<Renderer> renderer;
  with_threads([&] { renderer = std::make_unique<Renderer>(scene, environment.environment.get(), kernels, settings); });

  TuneReport report;
  report.scene = options.scene;
  report.limit = limit;
  report.frames = options.frames;
  report.width = settings.width;
  report.height = settings.height;
  report.base = settings;
  report.knobs = make_knobs(traits_of(scene, environment, look), given);

  Environments environments(std::move(environment.environment), environment.bake);
  TuneSubject subject(*renderer, environments, view, look, kernels);
  const auto settings_of = [&](const KnobChoice& choice) { return report.settings_of(choice); };
  const std::vector<int> counts = report.knobs.counts();
  report.pixels = subject.set_exact(settings_of(KnobChoice(counts.size(), 0)));
  if (report.pixels == 0) throw input_error("{}: the camera sees nothing of the scene: nothing to tune", options.scene);

  progress.begin("measuring each setting alone");
  KnobSearch knob_search;
  knob_search.choices = counts;
  knob_search.besides = {report.knobs.defaults()};
  knob_search.rounds = options.frames;
  knob_search.limit = limit.mean;
  knob_search.error = [&](const KnobChoice& choice) { return subject.error(settings_of(choice)); };
  knob_search.cost = [&](const KnobChoice& choice) { return subject.frame_ms(settings_of(choice)); };
  knob_search.progress = [&](bool combining, std::size_t done, std::size_t total) {
    if (combining && done == 1) progress.begin("measuring combinations");
    progress.set_fraction(done, total);
  };
  report.points = search(knob_search);
  progress.finish();
  report.chosen = cheapest_within(report.points, limit);
  report.isa = subject.statistics().isa;
  report.threads = subject.statistics().threads;

  const KnobPoint& chosen = report.points[report.chosen];
  const std::string about = fmt::format("{} at {} x {}: {} ({}, {} threads)", options.scene, report.width,
                                        report.height, result_of(chosen), report.isa, report.threads);
  if (!options.results.empty()) write_text(options.results, results_of(report));
  if (!options.chart.empty()) write_text(options.chart, chart_of(report));
  if (!options.picture.output.empty()) write_settings(options.picture.output, settings_of(chosen.choice), about);
  if (options.machine.quiet) return;
  for (const std::string& warning : read.warnings) warn(warning);
  for (const std::string& warning : environment.warnings) warn(warning);
  // Standard output may already have something else.
  const bool taken = options.picture.output == "-" || options.results == "-" || options.chart == "-";
  const std::string table = table_of(report);
  if (taken)
    std::fputs(table.c_str(), stderr);
  else
    print(table);
}

constexpr const char* footer = R"(Examples:
  tessera tune scene.glb --env courtyard.exr --max-error 2 -o settings.json --chart tune.svg
  tessera render scene.glb --env courtyard.exr --settings settings.json -o out.png
  tessera tune scene.glb --env courtyard.exr --samples 4 --max-p99 8 --results results.json

Varied are, as far as the scene has what they change (the exact choice first; a setting that is given is kept):
  --samples             16, 8, 4, 2, 1
  --env-lobe            taps4, fis8, taps2, shifted, n=v ('tessera chart ibl' compares them)
  --env-fresnel         f0, kS
  --specular-occlusion  with (Lagarde and de Rousiers 2014), without
  --env-albedo          table, fit, small-fit: the environment BRDF
  --env-size            512 or what the picture has, down to 32: texels along a face of the reflections
  --env-texels          half, rgb9e5
  --env-irradiance      cube, sh
  --light-cutoff        none; 0.001, 0.01, 0.1 lux at an exposure of 0
  --texture-filter      file, nearest-mip, no-mips, nearest
  --color-texels        half, 8bit

Errors count display steps, the 256 values of an 8-bit channel after exposure and tone curve, against the exact settings' picture,
over the pixels that show any of the scene: the mean absolute difference of all channels, and the largest difference of a pixel's
channels that 99 % of the pixels do not exceed. They are the same on every machine.
Cost is the time of the fastest of --frames frames with everything prepared, on --threads threads of this machine; all settings
take turns.
Each setting is varied alone; then those values are combined beside which no other is both nearer and clearly (5 %) cheaper. Of
more than 72 combinations those are measured that the single ones promise to be the cheapest within the limit, or on the frontier,
and then neighbours of what was found there.
Chosen is the cheapest within the limits; of those that cost at most 2 % more, the one with the smallest mean error.)";

}  // namespace

void add_tune(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("tune", "Measures on a scene which settings are the cheapest within an error");
  auto options = std::make_shared<Options>();
  command->add_option("scene", options->scene, "A .gltf or .glb file")->required();
  const std::string group = "Search";
  command->add_option("--max-error", options->max_error, "The largest mean error, in display steps")
      ->type_name("STEPS")
      ->capture_default_str()
      ->group(group);
  command
      ->add_option("--max-p99", options->max_p99,
                   "Also the largest difference of 99 % of the pixels, in display steps (default: any)")
      ->type_name("STEPS")
      ->group(group);
  command->add_option("--frames", options->frames, "Timed frames of each choice")
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  command->add_option("--samples", options->samples, "Samples per pixel, not varied: 1, 2, 4, 8 or 16")
      ->type_name("N")
      ->group(group);
  command
      ->add_option("-o,--output", options->picture.output,
                   "The cheapest settings as JSON, for 'tessera render --settings'; - writes to standard output")
      ->type_name("FILE.json")
      ->group(group);
  command->add_option("--results", options->results, "Everything that was measured, as JSON")
      ->type_name("FILE.json")
      ->group(group);
  command->add_option("--chart", options->chart, "The frontier of cost and error as a picture")
      ->type_name("FILE.svg")
      ->group(group);
  command->add_option("--size", options->size, "Pixels")->type_name("WxH")->capture_default_str()->group("Picture");
  add_look_options(*command, options->picture);
  add_camera_options(*command, options->camera);
  add_lighting_options(*command, options->lighting);
  add_texture_options(*command, options->textures);
  add_running_options(*command, options->machine);
  command->footer(footer);
  command->callback([options] { run_tune(*options); });
}

}  // namespace tessera::cli

// tessera bake: an environment's picture into what rendering needs, or into faces for other engines.
#include <filesystem>
#include <optional>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "cli/commands.hpp"
#include "cli/lighting.hpp"
#include "cli/machine.hpp"
#include "cli/parse.hpp"
#include "cli/prefilter_check.hpp"
#include "cli/text.hpp"
#include "frame/dispatch.hpp"
#include "frame/environment_file.hpp"
#include "io/image_file.hpp"

namespace tessera::cli {
namespace {

constexpr const char* footer =
    R"(The picture: equirectangular, a cross (4:3 or 3:4) or a strip of faces (6:1 or 1:6); .hdr, .exr of any compression, or
.png and .jpg, which are taken as sRGB. Or the six faces px nx py ny pz nz, as files or as a folder. Orientation is told by
'tessera render --help'; a baked environment keeps its rotation and intensity.

Levels of reflection hold radiance convolved with the GGX lobe (n = v = r) of roughness k / (levels - 1), each at half the
size of the one before. Irradiance is nine harmonics (exact solid angles), or a cube where a bright sun makes them negative.

--cube writes mK_px ... of every level K and irradiance_px ..., in OpenGL's and Vulkan's orientation.
--sh prints the harmonics of the radiance, L_lm by orthonormal real Y_lm over world x, y, z (+Y up).
--extract-light takes the brightest compact source out: rendering puts a directional light in its place.
--check compares levels of reflection with brute force in double precision, sums over all texels of the sharpest level; errors
are parts of the level's RMS. seam: the RMS step across edges of the cube, of that beside them (1: edges do not show).

Examples:
  tessera bake courtyard.exr -o courtyard.tsra
  tessera render scene.glb --env courtyard.tsra -o out.png
  tessera bake courtyard.hdr --rotation 90 --cube out --format rgbe
  tessera bake sunset.exr --extract-light --sh
  tessera bake sunset.exr --levels 9 --check 1000)";

struct Options {
  std::vector<std::string> pictures;
  std::string output, cube, format = "exr", layout = "auto", irradiance = "auto";
  double rotation = 0, intensity = 1, firefly = 0, window = 0;
  int size = 0, background = 0, levels = 0, samples = 0;
  int check = -1;  // texels per level; 0: all; -1: no check
  bool harmonics = false, extract = false;
  MachineOptions machine;
};

void check_power(const char* option, int value) {
  if (value != 0 && (value < 1 || value > max_cube_size || (value & (value - 1)) != 0))
    throw usage_error("{} {}: expected a power of two up to {}", option, value, max_cube_size);
}

void check_range(const char* option, double value, double low, double high) {
  if (!(value >= low && value <= high)) throw usage_error("{} {}: expected {} to {}", option, value, low, high);
}

EnvironmentSettings settings_of(const Options& options) {
  check_range("--rotation", options.rotation, -36000, 36000);
  check_range("--intensity", options.intensity, 0, 1e6);
  check_range("--firefly", options.firefly, 0, 1e30);
  check_range("--sh-window", options.window, 0, 1000);
  check_power("--size", options.size);
  check_power("--background-size", options.background);
  check_range("--levels", options.levels, 0, 13);
  check_range("--samples", options.samples, 0, 1 << 20);
  EnvironmentSettings settings;
  settings.rotation = static_cast<float>(options.rotation * radians_per_degree);
  settings.intensity = static_cast<float>(options.intensity);
  settings.background_size = options.background;
  settings.specular_size = options.size;
  settings.levels = options.levels;
  settings.samples = options.samples;
  settings.firefly_limit = static_cast<float>(options.firefly);
  settings.sh_window = static_cast<float>(options.window);
  settings.extract_light = options.extract;
  settings.keep_cube = true;
  if (options.irradiance == "sh")
    settings.irradiance = IrradianceForm::harmonics;
  else if (options.irradiance == "cube")
    settings.irradiance = IrradianceForm::cube;
  else if (options.irradiance != "auto")
    throw usage_error("--irradiance '{}': expected auto, sh or cube", options.irradiance);
  return settings;
}

EnvironmentData bake(const Options& options, const EnvironmentSettings& settings, const Kernels& kernels,
                     Progress& progress) {
  progress.begin("reading " + printable(options.pictures[0]));
  if (options.pictures.size() == 1 && is_baked_environment(options.pictures[0])) {
    if (options.rotation != 0 || options.intensity != 1 || options.extract)
      throw usage_error("{}: is baked already: nothing in it can be turned, scaled or taken out", options.pictures[0]);
    return read_environment(options.pictures[0]);
  }
  const EnvironmentPicture picture = read_environment_picture(options.pictures, options.layout, kernels);
  progress.begin("baking");
  return build_environment(picture, settings, kernels).data();
}

void write_faces(const Options& options, const std::string& name, const CubeLevel& level) {
  constexpr const char* faces[6] = {"px", "nx", "py", "ny", "pz", "nz"};
  const int n = level.size;
  for (int face = 0; face < 6; ++face) {
    std::vector<float> rgb;
    for (const float* texel = level.face(face); texel != level.face(face) + level.face_floats(); texel += 4)
      rgb.insert(rgb.end(), texel, texel + 3);
    const std::string path = (std::filesystem::path(options.cube) /
                              fmt::format("{}_{}.{}", name, faces[face], options.format == "exr" ? "exr" : "hdr"))
                                 .string();
    if (options.format == "exr")
      write_exr(path, n, n, {{"R", &rgb[0], nullptr, 3}, {"G", &rgb[1], nullptr, 3}, {"B", &rgb[2], nullptr, 3}});
    else
      write_hdr(path, n, n, rgb.data());
  }
}

void write_cube(const Options& options, const EnvironmentData& data, const Kernels& kernels) {
  std::error_code error;
  std::filesystem::create_directories(options.cube, error);
  if (error) throw output_error("{}: cannot be made: {}", options.cube, error.message());
  for (int level = 0; level < data.specular.levels(); ++level)
    write_faces(options, fmt::format("m{}", level), data.specular.load(level, kernels));
  if (!data.irradiance.empty()) write_faces(options, "irradiance", data.irradiance.load(0, kernels));
}

std::string harmonics_text(const IrradianceSh& sh) {
  constexpr int bands[9][2] = {{0, 0}, {1, -1}, {1, 0}, {1, 1}, {2, -2}, {2, -1}, {2, 0}, {2, 1}, {2, 2}};
  std::string text = " l  m             R             G             B\n";
  const IrradianceSh radiance = radiance_harmonics(sh);
  for (std::size_t k = 0; k < 9; ++k) {
    const auto& c = radiance.coefficients[k];
    text += fmt::format("{:2} {:2} {:13.6g} {:13.6g} {:13.6g}\n", bands[k][0], bands[k][1], c[0], c[1], c[2]);
  }
  return text;
}

void tell(const Options& options, const EnvironmentData& data, double ms) {
  const std::string name = printable(options.pictures[0]);
  for (const std::string& warning : environment_warnings(name, data.report, true)) warn(warning);
  if (data.report.fireflies != 0) note(fmt::format("{} texels dimmed to {}", data.report.fireflies, options.firefly));
  const double* mean = data.statistics.mean;
  note(fmt::format("mean radiance {:.4g} {:.4g} {:.4g}, brightest texel {:.4g}", mean[0], mean[1], mean[2],
                   data.statistics.brightest));
  note(fmt::format("reflections {0} x {0}, {1} levels; background {2} x {2}; irradiance from {3}", data.specular.size(),
                   data.specular.levels(), data.background.size(), data.uses_cube ? "a cube" : "harmonics"));
  if (data.light) {
    const Light light = directional_light(*data.light);
    note(fmt::format(
        "light taken out: directional:{:.5f},{:.5f},{:.5f}:{:.6g}:{:.4f},{:.4f},{:.4f}, {:.3f} degrees across",
        light.direction[0], light.direction[1], light.direction[2], light.intensity, light.color[0], light.color[1],
        light.color[2], 2 * double(data.light->angular_radius) / radians_per_degree));
  } else if (options.extract) {
    note("no compact source stands out: nothing taken out");
  }
  note(fmt::format("{:.0f} ms", ms));
}

void run_bake(const Options& options) {
  validate(options.machine);
  const Kernels& kernels = select_kernels(options.machine.isa);
  const bool check = options.check >= 0;
  if (options.output.empty() && options.cube.empty() && !options.harmonics && !check)
    throw usage_error("nothing to do: add -o FILE.tsra, --cube FOLDER, --sh or --check N");
  if (options.output == "-" && (options.harmonics || check))
    throw usage_error("-o and {} cannot both be standard output", options.harmonics ? "--sh" : "--check");
  if (options.format != "exr" && options.format != "rgbe")
    throw usage_error("--format '{}': expected exr or rgbe", options.format);
  const EnvironmentSettings settings = settings_of(options);
  const Stopwatch watch;
  Progress progress(options.machine.quiet ? Progress::Show::never : Progress::Show::on_terminal);
  EnvironmentData data;
  std::string checked;
  double ms = 0;
  run_with_threads(options.machine.threads, [&] {
    data = bake(options, settings, kernels, progress);
    progress.begin("writing");
    if (!options.output.empty()) write_environment(options.output, data);
    if (!options.cube.empty()) write_cube(options, data, kernels);
    ms = watch.ms();
    if (!check) return;
    progress.begin("comparing with brute force");
    checked =
        table_of(check_prefilter(data.specular, data.lod_curve, std::size_t(options.check), kernels)) +
        fmt::format("the brightest texel is {:.3g} times the median\n", brightest_over_median(data.specular, kernels));
  });
  progress.finish();
  if (options.harmonics) print(harmonics_text(data.sh));
  if (!checked.empty()) print(checked);
  if (!options.machine.quiet) tell(options, data, ms);
}

}  // namespace

void add_bake(CLI::App& program) {
  CLI::App* command = program.add_subcommand("bake", "Bakes an environment's picture into reflections and irradiance");
  auto options = std::make_shared<Options>();
  command->add_option("picture", options->pictures, "A picture, a folder of faces, or six faces")->required();
  command->add_option("-o,--output", options->output, "Where to: a .tsra file")->type_name("FILE");
  std::string group = "For other engines";
  command->add_option("--cube", options->cube, "Write faces of all levels into a folder")
      ->type_name("FOLDER")
      ->group(group);
  command->add_option("--format", options->format, "Of the faces: exr or rgbe")->capture_default_str()->group(group);
  command->add_flag("--sh", options->harmonics, "Print spherical harmonics")->group(group);
  group = "Picture";
  command->add_option("--layout", options->layout, "auto, equirect, cross or strip")
      ->capture_default_str()
      ->group(group);
  command->add_option("--rotation", options->rotation, "Turn about +Y")
      ->type_name("DEGREES")
      ->capture_default_str()
      ->group(group);
  command->add_option("--intensity", options->intensity, "Multiply radiance")
      ->type_name("FACTOR")
      ->capture_default_str()
      ->group(group);
  command->add_option("--firefly", options->firefly, "Dim texels brighter than this radiance to it (0: none)")
      ->type_name("RADIANCE")
      ->capture_default_str()
      ->group(group);
  command->add_flag("--extract-light", options->extract, "Take the dominant light out")->group(group);
  group = "Baking";
  command->add_option("--size", options->size, "Of reflections' faces (0: up to 256)")
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  command->add_option("--levels", options->levels, "Of reflections (0: down to 4 x 4)")
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  command->add_option("--background-size", options->background, "Of the visible faces (0: as the picture, up to 1024)")
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  command->add_option("--samples", options->samples, "Filter by this many points a texel instead of exact sums (0)")
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  command->add_option("--irradiance", options->irradiance, "auto, sh or cube")->capture_default_str()->group(group);
  command->add_option("--sh-window", options->window, "Damp ringing: lambda of Sloan's window, such as 0.01")
      ->type_name("LAMBDA")
      ->capture_default_str()
      ->group(group);
  command->add_option("--check", options->check, "Print how far N texels of each level are from brute force (0: all)")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
  add_running_options(*command, options->machine);
  command->footer(footer);
  command->callback([options] { run_bake(*options); });
}

}  // namespace tessera::cli

#include "cli/picture.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "cli/parse.hpp"
#include "io/image_file.hpp"

namespace tessera::cli {
namespace fs = std::filesystem;
namespace {

// How a surface looks best whose lighting nobody chose: on a plain light grey.
constexpr const char* neutral_background = "#b4b4b4";

void append_layers(const Frame& frame, std::vector<ExrChannel>& channels) {
  for (const AovLayer& layer : frame.aovs)
    for (std::size_t k = 0; k < layer.channels.size(); ++k) {
      ExrChannel channel{layer.channels[k], nullptr, nullptr, 1};
      if (layer.u32.empty())
        channel.f32 = layer.f32[k].data();
      else
        channel.u32 = layer.u32.data();
      channels.push_back(channel);
    }
}

const std::map<std::string, std::string> exr_attributes = {{"Software", "tessera " TESSERA_VERSION}};

}  // namespace

void add_picture_options(CLI::App& command, PictureOptions& options) {
  const std::string group = "Picture";
  command
      .add_option("-o,--output", options.output,
                  "The picture: .png for looking at, .exr for linear light in floats; - writes to standard output")
      ->type_name("FILE")
      ->required()
      ->group(group);
  command
      .add_option("--format", options.format,
                  "png or exr, whatever the file is called (default: by its ending; - is png)")
      ->type_name("NAME")
      ->group(group);
  add_look_options(command, options);
}

void add_look_options(CLI::App& command, PictureOptions& options) {
  const std::string group = "Picture";
  command
      .add_option("--exposure", options.exposure, "Brighter by so many stops; a PNG's alone: an EXR stays as computed")
      ->type_name("STOPS")
      ->capture_default_str()
      ->group(group);
  command.add_option("--tonemap", options.tonemap, "A PNG's tone curve: none, reinhard, aces or khronos-neutral")
      ->type_name("NAME")
      ->capture_default_str()
      ->group(group);
  command
      .add_option(
          "--background", options.background,
          "Behind the scene: env (the environment), transparent, or a colour: '#rrggbb' (sRGB) or r,g,b (linear)")
      ->type_name("WHAT")
      ->group(group);
  command
      .add_option("--background-blur", options.background_blur, "Blurs the environment as a background: 0 (sharp) to 1")
      ->type_name("AMOUNT")
      ->capture_default_str()
      ->group(group);
}

std::string PicturePlan::beside(const std::string& what) const {
  return fs::path(path).replace_extension(what + ".exr").string();
}

std::vector<unsigned char> encode_picture(const Look& look, const Image& image, int channels, const Kernels& kernels) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  std::vector<unsigned char> bytes(width * height * static_cast<std::size_t>(channels));
  parallel_for(height, [&](std::size_t y) {
    kernels.encode({image.at(0, static_cast<int>(y)), width, look.exposure, look.curve,
                    bytes.data() + y * width * static_cast<std::size_t>(channels), channels});
  });
  return bytes;
}

Look plan_look(const PictureOptions& options, const Kernels& kernels) {
  Look look;
  look.curve = parse_tone_curve(options.tonemap);
  if (!(options.exposure >= -60 && options.exposure <= 60))
    throw usage_error("--exposure {}: expected -60 to 60 stops", options.exposure);
  const float stops = static_cast<float>(options.exposure);
  kernels.evaluate(MathFunction::exp2, &stops, &stops, &look.exposure, 1);
  return look;
}

PicturePlan plan_picture(const PictureOptions& options, const Kernels& kernels) {
  PicturePlan plan;
  plan.path = options.output;
  std::string format = options.format;
  if (format.empty() && options.output != "-") {
    format = fs::path(options.output).extension().string();
    std::transform(format.begin(), format.end(), format.begin(), [](unsigned char c) { return std::tolower(c); });
    if (format != ".png" && format != ".exr")
      throw usage_error("-o '{}': expected a name that ends in .png or .exr (or say --format)", options.output);
    format.erase(0, 1);
  }
  if (!format.empty() && format != "png" && format != "exr")
    throw usage_error("--format '{}': expected png or exr", format);
  plan.exr = format == "exr";
  plan.look = plan_look(options, kernels);
  check_writable(plan.path);
  return plan;
}

void check_writable(const std::string& path) {
  if (path == "-") return;
  const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
  std::error_code error;
  if (fs::is_directory(path, error)) throw output_error("{}: is a directory", path);
  if (!fs::is_directory(folder, error)) throw output_error("{}: there is no folder '{}'", path, folder.string());
  // A device or pipe is written in place; anything else is replaced.
  const bool in_place = fs::exists(path, error) && !fs::is_regular_file(path, error);
  if (::access(in_place ? path.c_str() : folder.c_str(), W_OK) != 0)
    throw output_error("{}: cannot be written: {}", path, std::strerror(errno));
}

void set_background(const PictureOptions& options, bool neutral, const Kernels& kernels, RenderSettings& settings) {
  const std::string wish = !options.background.empty() ? options.background : neutral ? neutral_background : "env";
  const BackgroundChoice choice = parse_background(wish, kernels);
  settings.background = choice.kind;
  std::copy_n(choice.color, 3, settings.background_color);
  settings.background_blur = static_cast<float>(options.background_blur);
}

void write_picture(const PicturePlan& plan, const Frame& frame, Background background, const Kernels& kernels,
                   double& encode_ms, double& write_ms) {
  const Image& image = frame.rgba;
  const Stopwatch watch;
  if (plan.exr) {
    std::vector<ExrChannel> channels;
    const char* const names[] = {"R", "G", "B", "A"};
    for (std::size_t k = 0; k < 4; ++k) channels.push_back({names[k], image.pixels.data() + k, nullptr, 4});
    append_layers(frame, channels);
    write_exr(plan.path, image.width, image.height, channels, exr_attributes);
    write_ms += watch.ms();
    return;
  }
  const int channels = background == Background::transparent ? 4 : 3;
  const std::vector<unsigned char> bytes = encode_picture(plan.look, image, channels, kernels);
  encode_ms += watch.ms();
  const Stopwatch writing;
  write_png(plan.path, image.width, image.height, channels, bytes.data());
  write_ms += writing.ms();
}

void write_layers(const std::string& path, const Frame& frame) {
  std::vector<ExrChannel> channels;
  append_layers(frame, channels);
  write_exr(path, frame.rgba.width, frame.rgba.height, channels, exr_attributes);
}

}  // namespace tessera::cli

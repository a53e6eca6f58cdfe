// The picture as a file: what `render` and `shade` share.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "frame/frame.hpp"

namespace tessera::cli {

struct PictureOptions {
  std::string output, format;
  double exposure = 0;  // stops
  std::string tonemap = "khronos-neutral";
  std::string background;  // empty: the environment, or a plain grey in place of the neutral one
  double background_blur = 0;
};

/// The file, and how the picture looks.
void add_picture_options(CLI::App& command, PictureOptions& options);
/// Only how it looks: exposure, tone curve, background.
void add_look_options(CLI::App& command, PictureOptions& options);

/// From linear light to what a display shows.
struct Look {
  ToneCurve curve = ToneCurve::none;
  float exposure = 1;  // factor
};
Look plan_look(const PictureOptions& options, const Kernels& kernels);

/// image as 8-bit sRGB of 3 or 4 channels, straight alpha. Runs on the threads of the caller's arena.
std::vector<unsigned char> encode_picture(const Look& look, const Image& image, int channels, const Kernels& kernels);

/// Everything that can be wrong about the options, found before the work begins.
struct PicturePlan {
  std::string path;
  bool exr = false;
  Look look;

  /// "out/a.png" and "aov" -> "out/a.aov.exr"
  [[nodiscard]] std::string beside(const std::string& what) const;
};
PicturePlan plan_picture(const PictureOptions& options, const Kernels& kernels);

/// Throws Error(output) if the folder of path is not there or cannot be written.
void check_writable(const std::string& path);

/// background and its blur; neutral: the environment is the one that nobody asked for.
void set_background(const PictureOptions& options, bool neutral, const Kernels& kernels, RenderSettings& settings);

/// Writes the picture, and into an EXR the layers too. Milliseconds spent encoding and writing are added.
void write_picture(const PicturePlan& plan, const Frame& frame, Background background, const Kernels& kernels,
                   double& encode_ms, double& write_ms);

/// Layers alone, as an EXR.
void write_layers(const std::string& path, const Frame& frame);

}  // namespace tessera::cli

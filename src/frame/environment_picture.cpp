// Pictures of environments, from files.
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "frame/environment_file.hpp"
#include "io/image_file.hpp"

namespace tessera {
namespace {

namespace fs = std::filesystem;
constexpr const char* face_names[6] = {"px", "nx", "py", "ny", "pz", "nz"};

// What a screen would show, as light: sRGB undone. Alpha is not looked at later.
void decode_srgb(Image& image, const Kernels& kernels) {
  const std::size_t row = std::size_t(image.width) * std::size_t(image.channels);
  parallel_for(std::size_t(image.height), [&](std::size_t y) {
    float* values = image.at(0, int(y));
    kernels.evaluate(MathFunction::srgb_to_linear, values, values, values, row);
  });
}

Image read_light(const std::string& path, const Kernels& kernels) {
  PixelType type = PixelType::f32;
  Image image = read_image(path, &type);
  if (type == PixelType::u8 || type == PixelType::u16) decode_srgb(image, kernels);
  return image;
}

// The six faces in a folder: NAME.anything or m0_NAME.anything.
std::vector<std::string> faces_of(const std::string& folder) {
  std::map<std::string, std::string> by_stem;
  std::error_code error;
  std::vector<fs::path> entries;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    entries.push_back(it->path());
  if (error) throw input_error("{}: cannot be read: {}", folder, error.message());
  std::sort(entries.begin(), entries.end());
  for (const fs::path& path : entries) by_stem.emplace(path.stem().string(), path.string());
  std::vector<std::string> faces;
  for (const char* name : face_names) {
    auto found = by_stem.find(name);
    if (found == by_stem.end()) found = by_stem.find(std::string("m0_") + name);
    if (found == by_stem.end()) throw input_error("{}: no face {} (or m0_{}) in this folder", folder, name, name);
    faces.push_back(found->second);
  }
  return faces;
}

}  // namespace

EnvironmentPicture read_environment_picture(const std::vector<std::string>& paths, const std::string& layout,
                                            const Kernels& kernels) {
  if (paths.size() == 1) {
    std::error_code error;
    if (fs::is_directory(paths[0], error)) return read_environment_picture(faces_of(paths[0]), layout, kernels);
    Image image = read_light(paths[0], kernels);
    const EnvironmentLayout chosen = parse_layout(layout, image.width, image.height);
    return arrange(std::move(image), chosen, paths[0]);
  }
  if (paths.size() != 6) throw usage_error("{} pictures: expected one, or the six faces of a cube", paths.size());
  std::array<Image, 6> faces;
  std::array<std::string, 6> names;
  for (std::size_t k = 0; k < 6; ++k) {
    faces[k] = read_light(paths[k], kernels);
    names[k] = paths[k];
  }
  return arrange_faces(faces, names);
}

}  // namespace tessera

#include "precompute/environment_source.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"

namespace tessera {
namespace {

constexpr std::size_t pixel_limit = std::size_t{1} << 29;  // kernels' 32-bit offsets

void check_size(const Image& image, const std::string& name) {
  if (image.width < 1 || image.height < 1 || image.channels < 1)
    throw input_error("{}: the picture has no pixels", name);
  if (std::size_t(image.width) * std::size_t(image.height) >= pixel_limit) {
    throw input_error("{}: the picture has {} x {} pixels; fewer than 2^29 are possible", name, image.width,
                      image.height);
  }
}

// Where a layout has a face: in units of faces from the top left; turned: rotated by half a turn.
struct Place {
  int column, row;
  bool turned;
};
struct Grid {
  int columns, rows;
  Place places[6];
};

constexpr Grid horizontal_cross = {
    4, 3, {{2, 1, false}, {0, 1, false}, {1, 0, false}, {1, 2, false}, {1, 1, false}, {3, 1, false}}};
constexpr Grid vertical_cross = {
    3, 4, {{2, 1, false}, {0, 1, false}, {1, 0, false}, {1, 2, false}, {1, 1, false}, {1, 3, true}}};
constexpr Grid horizontal_strip = {
    6, 1, {{0, 0, false}, {1, 0, false}, {2, 0, false}, {3, 0, false}, {4, 0, false}, {5, 0, false}}};

// Copies face `from` of a picture of faces, at a place of its grid, to face `to` of a vertical strip.
void copy_face(const Image& image, const Place& place, Image& strip, int to) {
  const int n = strip.width, channels = strip.channels;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int x = place.turned ? n - 1 - i : i, y = place.turned ? n - 1 - j : j;
      std::copy_n(image.at(place.column * n + x, place.row * n + y), channels, strip.at(i, to * n + j));
    }
  }
}

}  // namespace

EnvironmentLayout layout_by_size(int width, int height) {
  const auto whole = [&](int columns, int rows) {
    return width % columns == 0 && height % rows == 0 && width / columns == height / rows;
  };
  if (whole(4, 3)) return EnvironmentLayout::horizontal_cross;
  if (whole(3, 4)) return EnvironmentLayout::vertical_cross;
  if (whole(6, 1)) return EnvironmentLayout::horizontal_strip;
  if (whole(1, 6)) return EnvironmentLayout::vertical_strip;
  return EnvironmentLayout::equirect;
}

EnvironmentLayout parse_layout(const std::string& text, int width, int height) {
  if (text == "auto") return EnvironmentLayout::automatic;
  if (text == "equirect") return EnvironmentLayout::equirect;
  if (text == "cross") return width > height ? EnvironmentLayout::horizontal_cross : EnvironmentLayout::vertical_cross;
  if (text == "strip") return width > height ? EnvironmentLayout::horizontal_strip : EnvironmentLayout::vertical_strip;
  throw usage_error("layout '{}': expected auto, equirect, cross or strip", text);
}

EnvironmentPicture arrange(Image image, EnvironmentLayout layout, const std::string& name) {
  check_size(image, name);
  if (layout == EnvironmentLayout::automatic) layout = layout_by_size(image.width, image.height);
  if (layout == EnvironmentLayout::equirect) return {std::move(image), false};
  const bool upright = layout == EnvironmentLayout::vertical_strip;
  const Grid grid = layout == EnvironmentLayout::horizontal_cross ? horizontal_cross
                    : layout == EnvironmentLayout::vertical_cross ? vertical_cross
                    : upright                                     ? Grid{1, 6, {}}
                                                                  : horizontal_strip;
  const int n = image.width / grid.columns;
  if (n < 1 || image.width != n * grid.columns || image.height != n * grid.rows) {
    throw input_error("{}: {} x {} pixels are not {} x {} square faces", name, image.width, image.height, grid.columns,
                      grid.rows);
  }
  if (upright) return {std::move(image), true};
  Image strip(n, 6 * n, image.channels);
  for (int face = 0; face < 6; ++face) copy_face(image, grid.places[face], strip, face);
  return {std::move(strip), true};
}

EnvironmentPicture arrange_faces(const std::array<Image, 6>& faces, const std::array<std::string, 6>& names) {
  const int n = faces[0].width, channels = faces[0].channels;
  for (std::size_t k = 0; k < 6; ++k) {
    check_size(faces[k], names[k]);
    if (faces[k].width != faces[k].height)
      throw input_error("{}: a cube's face of {} x {} pixels is not square", names[k], faces[k].width, faces[k].height);
    if (faces[k].width != n || faces[k].channels != channels)
      throw input_error("{}: {} x {} pixels of {} channels, but {} has {} x {} of {}", names[k], faces[k].width,
                        faces[k].height, faces[k].channels, names[0], n, n, channels);
  }
  if (std::size_t(n) * std::size_t(n) * 6 >= pixel_limit)
    throw input_error("{}: six faces of {} x {} pixels; fewer than 2^29 in all are possible", names[0], n, n);
  Image strip(n, 6 * n, channels);
  for (int face = 0; face < 6; ++face)
    std::copy(faces[std::size_t(face)].pixels.begin(), faces[std::size_t(face)].pixels.end(), strip.at(0, face * n));
  return {std::move(strip), true};
}

}  // namespace tessera

#include "cli/furnace_picture.hpp"

#include <algorithm>
#include <cmath>

#include "io/image_file.hpp"

namespace tessera::cli {
namespace {

constexpr float furnace_grey = 0.5F;  // linear: what a light of 1 is shown as
constexpr int subsamples = 4;         // along each axis of a pixel

// Linear RGBA, rows from the top.
struct Canvas {
  int width, height;
  std::vector<float> rgba;

  Canvas(int w, int h) : width(w), height(h), rgba(std::size_t(w) * std::size_t(h) * 4, 1.0F) {}
  void set(int x, int y, float r, float g, float b) {
    float* pixel = &rgba[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * 4];
    pixel[0] = r, pixel[1] = g, pixel[2] = b;
  }
};

void draw_spheres(Canvas& canvas, const FurnaceGrid& grid, int size) {
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < canvas.width; ++x) {
      const auto row = std::size_t(x / size);
      double sum = 0;
      for (int s = 0; s < subsamples * subsamples; ++s) {
        // A margin of a twentieth around each sphere.
        const int column = s % subsamples, line = s / subsamples;
        const double u = ((x % size + (column + 0.5) / subsamples) / size * 2 - 1) / 0.95;
        const double v = ((y + (line + 0.5) / subsamples) / size * 2 - 1) / 0.95;
        const double cos2 = 1 - u * u - v * v;
        sum += cos2 > 0 ? grid.at_cosine(row, std::sqrt(cos2)) : 1;
      }
      const float grey = furnace_grey * float(sum / (subsamples * subsamples));
      canvas.set(x, y, grey, grey, grey);
    }
}

void draw_map(Canvas& canvas, const FurnaceGrid& grid, int top, int band) {
  for (std::size_t row = 0; row < grid.roughness.size(); ++row)
    for (int x = 0; x < canvas.width; ++x) {
      const double difference = grid.at_cosine(row, (x + 0.5) / canvas.width) - 1;
      // Three decades: 0 at 1e-3, 1 at 1.
      const auto strength = float(std::clamp(1 + std::log10(std::max(std::abs(difference), 1e-12)) / 3, 0.0, 1.0));
      const float fade = (1 - strength) * (1 - strength);  // linear light: an even look
      for (int y = 0; y < band; ++y) {
        if (difference < 0) {
          canvas.set(x, top + int(row) * band + y, fade, 0.1F + 0.9F * fade, 0.4F + 0.6F * fade);
        } else {
          canvas.set(x, top + int(row) * band + y, 0.6F + 0.4F * fade, fade, fade);
        }
      }
    }
}

}  // namespace

double FurnaceGrid::at_cosine(std::size_t row, double mu) const {
  const auto above = std::size_t(std::lower_bound(NoV.begin(), NoV.end(), mu) - NoV.begin());
  if (above == 0) return at(row, 0);
  if (above >= NoV.size()) return at(row, NoV.size() - 1);
  const double w = (mu - NoV[above - 1]) / (NoV[above] - NoV[above - 1]);
  return (1 - w) * at(row, above - 1) + w * at(row, above);
}

void write_furnace_picture(const std::string& path, const FurnaceGrid& grid, int sphere_size, const Kernels& kernels) {
  const int rows = int(grid.roughness.size()), band = std::max(sphere_size / 6, 4), gap = std::max(sphere_size / 24, 2);
  Canvas canvas(sphere_size * rows, sphere_size + gap + band * rows);
  draw_spheres(canvas, grid, sphere_size);
  draw_map(canvas, grid, sphere_size + gap, band);
  std::vector<unsigned char> bytes(canvas.rgba.size());
  kernels.encode({canvas.rgba.data(), canvas.rgba.size() / 4, 1, ToneCurve::none, bytes.data()});
  write_png(path, canvas.width, canvas.height, 4, bytes.data());
}

}  // namespace tessera::cli

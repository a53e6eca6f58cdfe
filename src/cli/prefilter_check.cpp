#include "cli/prefilter_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.hpp"
#include "precompute/prefilter.hpp"
#include "reference/convolution.hpp"

namespace tessera::cli {
namespace {

using reference::Vec3;

struct Sums {
  double squares = 0, errors = 0, largest = 0;
};

// Some texels of a level.
Sums compare(const CubeLevel& level, const std::vector<std::size_t>& chosen, double roughness,
             const reference::CubeSum& truth) {
  const std::size_t n = std::size_t(level.size);
  std::vector<Vec3> axes;
  for (const std::size_t i : chosen)
    axes.push_back(reference::cube_texel_direction(int(i / (n * n)), int(i % n), int(i / n % n), level.size));
  const std::vector<Vec3> expected = truth.convolved(axes, roughness);
  Sums sums;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const float* texel = &level.texels[chosen[k] * 4];
    const double values[3] = {expected[k].x, expected[k].y, expected[k].z};
    for (int c = 0; c < 3; ++c) {
      const double error = std::abs(double(texel[c]) - values[c]);
      sums.squares += values[c] * values[c];
      sums.errors += error * error;
      sums.largest = std::max(sums.largest, error);
    }
  }
  return sums;
}

double seam_of(const Cube& cube, int level, const Kernels& kernels) {
  const int n = cube.size() >> level, row = n + 2;  // with borders, which hold the neighbours' edges
  std::vector<float> texels(std::size_t{6} * std::size_t(row) * std::size_t(row) * 4);
  for (int k = 0; k < 6 * row; ++k) {
    const std::size_t first = cube_texel_index(cube.size(), cube.levels(), level, k / row, -1, k % row - 1);
    const std::size_t floats = std::size_t(row) * 4;
    kernels.unpack_half(cube.texels().data() + first * 4, texels.data() + std::size_t(k) * floats, floats);
  }
  double across = 0, inside = 0;
  for (int face = 0; face < 6; ++face) {
    const auto texel = [&](int i, int j) {
      return &texels[((std::size_t(face) * std::size_t(row) + std::size_t(j + 1)) * std::size_t(row) +
                      std::size_t(i + 1)) *
                     4];
    };
    const auto add = [](double& sum, const float* a, const float* b) {
      for (int c = 0; c < 3; ++c) sum += (double(a[c]) - double(b[c])) * (double(a[c]) - double(b[c]));
    };
    for (int k = 0; k < n; ++k)
      for (const auto& [edge, outwards] : {std::pair{0, -1}, {n - 1, 1}}) {
        add(across, texel(edge, k), texel(edge + outwards, k));
        add(inside, texel(edge, k), texel(edge - outwards, k));
        add(across, texel(k, edge), texel(k, edge + outwards));
        add(inside, texel(k, edge), texel(k, edge - outwards));
      }
  }
  return inside > 0 ? std::sqrt(across / inside) : across > 0 ? INFINITY : 1;
}

}  // namespace

reference::SpherePicture as_sphere(const CubeLevel& level) {
  reference::SpherePicture faces{level.size, 6 * level.size, {}, true};
  for (std::size_t i = 0; i < level.texels.size(); i += 4)
    faces.rgb.insert(faces.rgb.end(), &level.texels[i], &level.texels[i] + 3);
  return faces;
}

std::vector<LevelError> check_prefilter(const Cube& cube, float curve, std::size_t texels, const Kernels& kernels) {
  const reference::CubeSum truth(as_sphere(cube.load(0, kernels)));
  std::vector<LevelError> result;
  for (int k = 1; k < cube.levels(); ++k) {
    const CubeLevel level = cube.load(k, kernels);
    const double roughness = double(roughness_of_level(k, cube.levels(), curve));
    const std::size_t all = level.texels.size() / 4, count = texels == 0 ? all : std::min(texels, all);
    constexpr std::size_t piece = 64;
    std::vector<Sums> pieces((count + piece - 1) / piece);
    parallel_for(pieces.size(), [&](std::size_t p) {
      std::vector<std::size_t> chosen;
      for (std::size_t i = p * piece; i < std::min(count, (p + 1) * piece); ++i) {
        // One from each of `count` equal parts, not at the same place of each: parts may follow rows.
        const double within = count == all ? 0 : std::fmod(double(i) * 0.6180339887498949, 1);
        chosen.push_back(std::min(std::size_t((double(i) + within) * double(all) / double(count)), all - 1));
      }
      pieces[p] = compare(level, chosen, roughness, truth);
    });
    Sums sums;
    for (const Sums& part : pieces) {
      sums.squares += part.squares;
      sums.errors += part.errors;
      sums.largest = std::max(sums.largest, part.largest);
    }
    const double scale = std::max(std::sqrt(sums.squares), std::numeric_limits<double>::min());
    result.push_back({k, level.size, roughness, count, std::sqrt(sums.errors) / scale,
                      sums.largest / scale * std::sqrt(3.0 * double(count)), seam_of(cube, k, kernels)});
  }
  return result;
}

double brightest_over_median(const Cube& cube, const Kernels& kernels) {
  const CubeLevel level = cube.load(0, kernels);
  std::vector<double> luminance;
  for (std::size_t i = 0; i < level.texels.size(); i += 4)
    luminance.push_back(0.2126 * double(level.texels[i]) + 0.7152 * double(level.texels[i + 1]) +
                        0.0722 * double(level.texels[i + 2]));
  const auto middle = luminance.begin() + std::ptrdiff_t(luminance.size() / 2);
  std::nth_element(luminance.begin(), middle, luminance.end());
  return *std::max_element(middle, luminance.end()) / *middle;
}

std::string table_of(const std::vector<LevelError>& errors) {
  std::string text = "level  size  roughness  texels  RMS error  largest   seam\n";
  for (const LevelError& e : errors)
    text += fmt::format("{:5} {:5} {:10.3f} {:7} {:10.1e} {:8.1e} {:6.2f}\n", e.level, e.size, e.roughness, e.texels,
                        e.rms, e.largest, e.seam);
  return text;
}

}  // namespace tessera::cli

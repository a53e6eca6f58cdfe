#include "precompute/irradiance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/parallel.hpp"
#include "precompute/angles.hpp"
#include "precompute/cube.hpp"

namespace tessera {
namespace {

constexpr double pi = std::numbers::pi;

// Integrals over the width of each column: of 1 (the same for all), cos phi, sin phi, cos 2 phi, sin 2 phi.
struct Columns {
  double width;
  std::vector<double> cos1, sin1, cos2, sin2;
};

// A difference of sines at the ends is a product at the middle, which keeps its digits: sin b - sin a = 2 cos m sin h
// with m = (a + b) / 2, h = (b - a) / 2.
Columns integrate_columns(int count, float rotation, const Kernels& kernels) {
  std::vector<float> once, twice;
  for (int i = 0; i < count; ++i) {
    const double phi = ((i + 0.5) / count - 0.5) * 2 * pi - double(rotation);
    once.push_back(float(phi));
    twice.push_back(float(2 * phi));
  }
  Columns columns{2 * pi / count, evaluate(MathFunction::cos, once, kernels),
                  evaluate(MathFunction::sin, once, kernels), evaluate(MathFunction::cos, twice, kernels),
                  evaluate(MathFunction::sin, twice, kernels)};
  const std::vector<double> half = evaluate(MathFunction::sin, {float(pi / count), float(2 * pi / count)}, kernels);
  for (int i = 0; i < count; ++i) {
    columns.cos1[std::size_t(i)] *= 2 * half[0];
    columns.sin1[std::size_t(i)] *= 2 * half[0];
    columns.cos2[std::size_t(i)] *= half[1];
    columns.sin2[std::size_t(i)] *= half[1];
  }
  return columns;
}

// Integrals over the height of a row of products of s = sin(theta) and c = cos(theta), theta from the top.
struct Row {
  double s, sc, ss, scc, sss, ssc;
};

std::vector<Row> integrate_rows(int count, const Kernels& kernels) {
  std::vector<float> ends, middles, doubled;
  for (int j = 0; j <= count; ++j) ends.push_back(float(pi * j / count));
  for (int j = 0; j < count; ++j) {
    middles.push_back(float(pi * (j + 0.5) / count));
    doubled.push_back(float(2 * pi * (j + 0.5) / count));
  }
  const std::vector<double> cos_end = evaluate(MathFunction::cos, ends, kernels);
  const std::vector<double> sin_end = evaluate(MathFunction::sin, ends, kernels);
  const std::vector<double> cos_mid = evaluate(MathFunction::cos, middles, kernels);
  const std::vector<double> sin_mid = evaluate(MathFunction::sin, middles, kernels);
  const std::vector<double> cos_twice = evaluate(MathFunction::cos, doubled, kernels);
  const std::vector<double> sin_twice = evaluate(MathFunction::sin, doubled, kernels);
  const double h = pi / (2 * count);
  const std::vector<double> sin_h = evaluate(MathFunction::sin, {float(h), float(2 * h)}, kernels);
  std::vector<Row> rows;
  for (std::size_t j = 0; j < std::size_t(count); ++j) {
    Row row{};
    const double c0 = cos_end[j], c1 = cos_end[j + 1], s0 = sin_end[j], s1 = sin_end[j + 1];
    const double sine_rise = 2 * cos_mid[j] * sin_h[0];
    row.s = 2 * sin_mid[j] * sin_h[0];  // cos a - cos b
    row.sc = sin_twice[j] * sin_h[1] / 2;
    row.ss = h - cos_twice[j] * sin_h[1] / 2;
    row.scc = row.s * (c0 * c0 + c0 * c1 + c1 * c1) / 3;
    row.sss = row.s - row.scc;
    row.ssc = sine_rise * (s0 * s0 + s0 * s1 + s1 * s1) / 3;
    rows.push_back(row);
  }
  return rows;
}

// What the coefficients are factors of.
std::array<double, 9> harmonic_basis(double x, double y, double z) {
  return {1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y};
}

using Coefficients = std::array<std::array<double, 3>, 9>;

// What a row adds to the integrals of radiance times harmonic_basis, where x = sin(theta) cos(phi), y = cos(theta), z =
// sin(theta) sin(phi).
Coefficients project_row(const float* texels, const Columns& columns, const Row& row) {
  double sums[5][3] = {};
  for (std::size_t i = 0; i < columns.cos1.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double radiance = double(texels[i * 3 + std::size_t(c)]);
      sums[0][c] += radiance;
      sums[1][c] += radiance * columns.cos1[i];
      sums[2][c] += radiance * columns.sin1[i];
      sums[3][c] += radiance * columns.cos2[i];
      sums[4][c] += radiance * columns.sin2[i];
    }
  }
  Coefficients result{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double one = sums[0][c] * columns.width, cosine = sums[1][c], sine = sums[2][c];
    const double cos2 = sums[3][c], sin2 = sums[4][c];
    result[0][c] = row.s * one;
    result[1][c] = row.sc * one;
    result[2][c] = row.ss * sine;
    result[3][c] = row.ss * cosine;
    result[4][c] = row.ssc * cosine;
    result[5][c] = row.ssc * sine;
    result[6][c] = 3 * row.sss * (one - cos2) / 2 - row.s * one;
    result[7][c] = row.sss * sin2 / 2;
    result[8][c] = row.sss * (one + cos2) / 2 - row.scc * one;
  }
  return result;
}

// Ramamoorthi and Hanrahan 2001, "An efficient representation for irradiance environment maps": E / pi is the sum of
// (1, 2/3, 1/4 by band) L_lm Y_lm; the squares of the Y_lm's constants, here with their factors.
constexpr double band_factors[9] = {1 / (4 * pi),   1 / (2 * pi),  1 / (2 * pi),   1 / (2 * pi),  15 / (16 * pi),
                                    15 / (16 * pi), 5 / (64 * pi), 15 / (16 * pi), 15 / (64 * pi)};

// Rows apart, then in order: the same for any number of threads.
IrradianceSh sum_of(const std::vector<Coefficients>& parts) {
  IrradianceSh sh;
  for (std::size_t k = 0; k < 9; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (const Coefficients& part : parts) sum += part[k][c];
      sh.coefficients[k][c] = float(sum * band_factors[k]);
    }
  }
  return sh;
}

// What a texel of a face adds, its radiance constant over it: Gauss-Legendre with two points a side, in parts of at
// most 1/64 of the face. The integrals then err by less than 1e-9 of themselves.
void add_face_texel(const float* rgb, int face, int x, int y, int size, const Turn& turn, Coefficients& sum) {
  const double cosine = double(turn.cosine), sine = double(turn.sine);
  constexpr double node = 0.577350269189625764509;
  const int parts = std::max(64 / size, 1);
  const double half = 1.0 / (double(size) * parts);
  std::array<double, 9> basis{};
  for (int j = 0; j < 2 * parts; ++j) {
    for (int i = 0; i < 2 * parts; ++i) {
      const auto coordinate = [&](int texel, int k) {
        const double middle = (2.0 * (texel * parts + k / 2) + 1) * half - 1;
        return middle + (k % 2 == 0 ? -node : node) * half;
      };
      const double s = coordinate(x, i), t = coordinate(y, j);
      const double length2 = 1 + s * s + t * t, length = std::sqrt(length2), area = half * half / (length2 * length);
      const auto [px, py, pz] = face_direction(face, s, t);
      const std::array<double, 9> values =
          harmonic_basis((px * cosine + pz * sine) / length, py / length, (pz * cosine - px * sine) / length);
      for (std::size_t k = 0; k < 9; ++k) basis[k] += values[k] * area;
    }
  }
  for (std::size_t k = 0; k < 9; ++k)
    for (std::size_t c = 0; c < 3; ++c) sum[k][c] += basis[k] * double(rgb[c]);
}

}  // namespace

IrradianceSh project_irradiance(const EquirectView& source, float rotation, const Kernels& kernels) {
  const Columns columns = integrate_columns(source.width, rotation, kernels);
  const std::vector<Row> rows = integrate_rows(source.height, kernels);
  std::vector<Coefficients> parts(rows.size());
  parallel_for(rows.size(), [&](std::size_t j) {
    parts[j] = project_row(source.texels + j * std::size_t(source.width) * 3, columns, rows[j]);
  });
  return sum_of(parts);
}

IrradianceSh project_irradiance(const CubeFacesView& source, float rotation, const Kernels& kernels) {
  const Turn turn = turn_by(rotation, kernels);
  const int n = source.size;
  std::vector<Coefficients> parts(std::size_t(n) * 6);
  parallel_for(parts.size(), [&](std::size_t row) {
    const float* texels = source.texels + row * std::size_t(n) * 3;
    for (int x = 0; x < n; ++x) add_face_texel(texels + 3 * x, int(row) / n, x, int(row) % n, n, turn, parts[row]);
  });
  return sum_of(parts);
}

double irradiance(const IrradianceSh& sh, std::size_t channel, double x, double y, double z) {
  const std::array<double, 9> values = harmonic_basis(x, y, z);
  double sum = 0;
  for (std::size_t k = 0; k < 9; ++k) sum += values[k] * double(sh.coefficients[k][channel]);
  return sum;
}

IrradianceSh windowed(const IrradianceSh& sh, float lambda) {
  IrradianceSh out = sh;
  const float band[3] = {1, 1 / (1 + 4 * lambda), 1 / (1 + 36 * lambda)};
  for (std::size_t k = 0; k < 9; ++k)
    for (float& value : out.coefficients[k]) value *= band[k == 0 ? 0 : k < 4 ? 1 : 2];
  return out;
}

IrradianceSh radiance_harmonics(const IrradianceSh& sh) {
  // The constants of Y_lm in front of 1, y, z, x, xy, yz, 3zz - 1, xz, xx - yy: 1/2 sqrt(1/pi) ...
  constexpr double constants[9] = {0.28209479177387814, 0.48860251190291992, 0.48860251190291992,
                                   0.48860251190291992, 1.0925484305920792,  1.0925484305920792,
                                   0.31539156525252005, 1.0925484305920792,  0.54627421529603959};
  IrradianceSh out;
  for (std::size_t k = 0; k < 9; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      out.coefficients[k][c] = float(double(sh.coefficients[k][c]) / band_factors[k] * constants[k]);
  return out;
}

double least_irradiance(const IrradianceSh& sh) {
  constexpr int n = 32;
  double least = 1;
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const CubeDirection d = texel_direction(face, i, j, n);
        for (std::size_t c = 0; c < 3; ++c) {
          const double mean = double(sh.coefficients[0][c]);
          if (mean > 0) least = std::min(least, irradiance(sh, c, double(d.x), double(d.y), double(d.z)) / mean);
        }
      }
  return least;
}

}  // namespace tessera

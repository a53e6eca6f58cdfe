#include "precompute/lobe.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tessera {
namespace {

// The golden ratio's multiples, modulo 1: with the even steps of u a spiral whose points lie as far apart as they can.
// Exact in integers. Against brute force over a cube's texels this set errs a quarter to a third less than Hammersley's
// (van der Corput's digits in place of the multiples), at every roughness and count.
double golden_turn(std::uint32_t i) { return double(i * 2654435769u) * 0x1p-32; }

}  // namespace

Lobe ggx_lobe(float roughness, int count, int cube_size, const Kernels& kernels) {
  const double alpha = double(roughness) * double(roughness), rest = alpha * alpha - 1;
  const std::size_t n = std::size_t(count);
  std::vector<float> phi(n), cosine(n), sine(n), ratio(n), log_ratio(n);
  for (std::size_t i = 0; i < n; ++i) phi[i] = float(2 * std::numbers::pi * golden_turn(std::uint32_t(i)));
  kernels.evaluate(MathFunction::cos, phi.data(), phi.data(), cosine.data(), n);
  kernels.evaluate(MathFunction::sin, phi.data(), phi.data(), sine.data(), n);

  // cos^2(theta_h) = (1 - u) / (1 + (alpha^2 - 1) u). Only light above the horizon counts, theta_h < pi/4: u < u_max.
  const double u_max = 1 / (1 + alpha * alpha);
  Lobe lobe;
  double total = 0;
  std::vector<double> weights(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double u = (double(i) + 0.5) / count * u_max;
    const double q = 1 + rest * u;
    const double cos2 = (1 - u) / q, sin2 = alpha * alpha * u / q;
    const double NoL = cos2 - sin2, sin_l = 2 * std::sqrt(cos2 * sin2);
    lobe.x.push_back(float(sin_l * double(cosine[i])));
    lobe.y.push_back(float(sin_l * double(sine[i])));
    lobe.z.push_back(float(NoL));
    weights[i] = NoL;
    total += NoL;
    // The point stands for a solid angle 1 / (N pdf), pdf = D / (4 u_max), D = q^2 / (pi alpha^2); a texel of level 0
    // has 4 pi / (6 size^2). A level is worth a factor of four.
    ratio[i] = float(6 * u_max * alpha * alpha / count * double(cube_size) * double(cube_size) / (q * q));
  }
  kernels.evaluate(MathFunction::log2, ratio.data(), ratio.data(), log_ratio.data(), n);
  // The integral of D n.l over light directions is the mean of n.l over u times 4 u_max; D = alpha^2 / (pi t^2).
  lobe.alpha2 = float(alpha * alpha);
  lobe.scale = float(alpha * alpha / std::numbers::pi / (4 * u_max * total / count));
  for (std::size_t i = 0; i < n; ++i) {
    lobe.weight.push_back(float(weights[i] / total));
    lobe.lod.push_back(0.5f * log_ratio[i]);
  }
  return lobe;
}

}  // namespace tessera

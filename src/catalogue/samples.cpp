#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "catalogue/method.hpp"

namespace tessera::catalogue {
namespace {

// One draw: what several inputs of one sample have in common.
struct Sample {
  double theta, phi;  // of the half vector
};

class Sampler {
 public:
  explicit Sampler(unsigned seed) : random_(seed) {}

  Sample sample() {
    // A third of the angles uniform, the others logarithmic towards the normal.
    const double theta =
        uniform(0, 3) < 1 ? uniform(0, std::numbers::pi / 2) : std::numbers::pi / 2 * std::pow(10, uniform(-7, 0));
    return {theta, uniform(0, 2 * std::numbers::pi)};
  }

  double draw(const Method& method, Quantity quantity, const Sample& sample) {
    const Domain domain = domain_of(method, quantity);
    switch (quantity) {
      case Quantity::NoH:
        return std::cos(sample.theta);
      case Quantity::sin2:
        return std::pow(std::sin(sample.theta), 2);
      case Quantity::XoH:
        return std::sin(sample.theta) * std::cos(sample.phi);
      case Quantity::YoH:
        return std::sin(sample.theta) * std::sin(sample.phi);
      case Quantity::alpha:
      case Quantity::alpha_y:
        return logarithmic(domain);
      case Quantity::NoV:
      case Quantity::NoL:
        return uniform(0, 2) < 1 ? uniform(domain.low, domain.high) : logarithmic(domain);
      case Quantity::VoH:
        return uniform(0, 4) < 3 ? uniform(domain.low, domain.high) : std::pow(10, uniform(-7, 0));
      default:
        return uniform(domain.low, domain.high);
    }
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double logarithmic(const Domain& domain) { return std::exp(uniform(std::log(domain.low), std::log(domain.high))); }

  std::mt19937_64 random_;
};

}  // namespace

Domain domain_of(const Method& method, Quantity quantity) {
  switch (quantity) {
    case Quantity::NoV:
    case Quantity::NoL:  // as the shading loop clamps them
    case Quantity::alpha:
    case Quantity::alpha_y:
      return {1e-4, 1};
    case Quantity::LoV:
    case Quantity::XoH:
    case Quantity::YoH:
      return {-1, 1};
    case Quantity::eta:
      return {1, 3};
    case Quantity::metal_eta:
      return {0.03, 10};
    case Quantity::metal_k:
      return {0.3, 12};
    case Quantity::gamma:
      return {0.5, 4};
    case Quantity::phi:
      return {0, 2 * std::numbers::pi};
    case Quantity::error_scale:
      return {-1, 6};
    case Quantity::error_power:
      return {2, 10};
    case Quantity::any:
      return {method.low, method.high};
    default:
      return {0, 1};
  }
}

std::vector<std::vector<float>> draw_inputs(const Method& method, std::size_t count, unsigned seed) {
  Sampler sampler(seed);
  std::vector<std::vector<float>> inputs(method.inputs.size(), std::vector<float>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Sample sample = sampler.sample();
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      const Domain domain = domain_of(method, method.inputs[k]);
      // 1e-4 as a float lies below 1e-4 as a double; inside the domain all the same.
      inputs[k][i] =
          std::clamp(float(sampler.draw(method, method.inputs[k], sample)), float(domain.low), float(domain.high));
    }
  }
  return inputs;
}

}  // namespace tessera::catalogue

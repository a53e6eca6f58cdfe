// Pseudo-random numbers for Monte Carlo: the same sequence on every machine.
#pragma once
#include <cstdint>

namespace tessera::reference {

/// SplitMix64: Steele, Lea, Flood 2014, Fast Splittable Pseudorandom Number Generators. Period 2^64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(mix(seed)) {}

  std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15u); }
  /// Uniform in [0,1), a multiple of 2^-53.
  double uniform() { return double(bits() >> 11) * 0x1p-53; }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace tessera::reference

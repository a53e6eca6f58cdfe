// Random bit patterns, fast enough for a thousand million of them.
#pragma once
#include <bit>
#include <cstdint>
#include <cstdlib>

namespace tessera::test {

/// How many patterns each kernel gets: TESSERA_FUZZ_COUNT, or a million.
inline std::uint64_t fuzz_count() {
  const char* wish = std::getenv("TESSERA_FUZZ_COUNT");
  return wish != nullptr ? std::strtoull(wish, nullptr, 10) : 1000000;
}

/// Marsaglia 2003, Xorshift RNGs; every pattern but all zeros appears.
class RandomBits {
 public:
  explicit RandomBits(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 1) {}
  std::uint64_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return state_;
  }
  /// Fills with floats of any bits: NaN, infinities, subnormals, both signs.
  void fill(float* out, std::size_t count) {
    for (std::size_t i = 0; i < count; i += 2) {
      const std::uint64_t bits = next();
      out[i] = std::bit_cast<float>(std::uint32_t(bits >> 32));
      if (i + 1 < count) out[i + 1] = std::bit_cast<float>(std::uint32_t(bits));
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace tessera::test

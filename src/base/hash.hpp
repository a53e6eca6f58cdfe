// FNV-1a (Fowler, Noll, Vo) over 32-bit words: names the content of decoded pixels. Not for security.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

namespace tessera {

class PixelHash {
 public:
  void add(std::uint32_t word) { state_ = (state_ ^ word) * 0x100000001b3ull; }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
  void add(const float* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) add(values[i]);
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ull;
};

}  // namespace tessera

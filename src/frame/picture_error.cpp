#include "frame/picture_error.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace tessera {

PictureError picture_error(std::span<const unsigned char> rgb, std::span<const unsigned char> exact,
                           std::span<const std::uint8_t> counts) {
  assert(rgb.size() == counts.size() * 3 && exact.size() == rgb.size());
  std::uint64_t sum = 0, pixels = 0;
  std::array<std::uint64_t, 256> histogram{};  // of the largest channel difference
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    std::size_t largest = 0;
    for (std::size_t c = i * 3; c < i * 3 + 3; ++c) {
      const std::size_t difference = rgb[c] > exact[c] ? rgb[c] - exact[c] : exact[c] - rgb[c];
      sum += difference;
      largest = std::max(largest, difference);
    }
    ++histogram[largest];
    ++pixels;
  }
  PictureError error;
  if (pixels == 0) return error;
  error.mean = static_cast<double>(sum) / static_cast<double>(3 * pixels);
  std::size_t value = 0;
  for (std::uint64_t below = histogram[0]; below * 100 < pixels * 99; below += histogram[value]) ++value;
  error.percentile99 = static_cast<double>(value);
  return error;
}

}  // namespace tessera

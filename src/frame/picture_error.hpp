// How far one displayed picture is from another.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace tessera {

/// In display steps: the values 0 .. 255 that an 8-bit picture holds.
struct PictureError {
  double mean = 0;          // absolute difference, over the pixels that count and their three channels
  double percentile99 = 0;  // what the largest channel difference does not exceed in 99 % of these pixels
};

/// rgb and exact: three bytes per pixel; counts: one per pixel, 0 for a pixel that does not count. Summed in integers:
/// the same for any order. Without a pixel that counts, all is 0.
PictureError picture_error(std::span<const unsigned char> rgb, std::span<const unsigned char> exact,
                           std::span<const std::uint8_t> counts);

}  // namespace tessera

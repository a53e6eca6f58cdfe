// SVG text as pixels, and pixels as PNG bytes.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tessera::chart {

struct Picture {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  // rows from the top
};

/// The picture that an SVG describes, `scale` pixels to its unit. Throws Error(output) with the reason.
Picture picture_of_svg(const std::string& svg, double scale);

/// pixels: 0xRRGGBB, rows from the top.
std::string png_of_pixels(int width, int height, const std::vector<std::uint32_t>& pixels);

/// For data: URLs.
std::string base64(const std::string& bytes);

}  // namespace tessera::chart

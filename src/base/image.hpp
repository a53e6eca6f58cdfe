// A picture in memory: interleaved floats, top row first.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "base/aligned.hpp"

namespace tessera {

struct Image {
  int width = 0, height = 0, channels = 0;
  AlignedVector<float> pixels;  // width * height * channels

  Image() = default;
  Image(int w, int h, int c) : width(w), height(h), channels(c), pixels(std::size_t(w) * h * c) {}
  [[nodiscard]] float* at(int x, int y) { return pixels.data() + (std::size_t(y) * width + x) * channels; }
  [[nodiscard]] const float* at(int x, int y) const { return pixels.data() + (std::size_t(y) * width + x) * channels; }
};

/// Someone's memory as a picture of interleaved RGBA floats, rows one after another.
struct FilmView {
  float* rgba;
  int width, height;

  [[nodiscard]] float* at(int x, int y) const {
    return rgba + (std::size_t(y) * std::size_t(width) + std::size_t(x)) * 4;
  }
};

}  // namespace tessera

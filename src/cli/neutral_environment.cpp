#include "cli/neutral_environment.hpp"

#include <algorithm>
#include <cmath>

namespace tessera::cli {
namespace {

struct SoftBox {
  float u, v;  // centre
  float half_width, half_height;
  float radiance;
};

// The eye is at +Z (u = 0.75) unless told otherwise: a key light on its left, a fill on its right, a rim light behind.
constexpr SoftBox soft_boxes[] = {
    {0.88f, 0.27f, 0.060f, 0.090f, 8.0f},
    {0.61f, 0.36f, 0.035f, 0.130f, 3.0f},
    {0.25f, 0.24f, 0.090f, 0.060f, 5.0f},
};

float smooth_step(float x) {
  const float t = std::clamp(x, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// 1 inside, 0 outside, with an edge wide enough for a small map.
float inside(const SoftBox& box, float u, float v) {
  constexpr float edge = 0.02f;
  const float across = std::abs(u - box.u), down = std::abs(v - box.v);
  return smooth_step((box.half_width - across) / edge + 0.5f) * smooth_step((box.half_height - down) / edge + 0.5f);
}

}  // namespace

Image neutral_environment() {
  Image image(256, 128, 3);
  for (int y = 0; y < image.height; ++y) {
    const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height);
    // 0.1 below, 0.25 along the horizon, 0.5 above.
    const float room = 0.1f + 0.15f * smooth_step((1.0f - v) / 0.5f) + 0.25f * smooth_step((0.5f - v) / 0.5f);
    for (int x = 0; x < image.width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(image.width);
      float radiance = room;
      for (const SoftBox& box : soft_boxes) radiance += box.radiance * inside(box, u, v);
      std::fill_n(image.at(x, y), 3, radiance);
    }
  }
  return image;
}

}  // namespace tessera::cli

#include "bench/peers/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/parallel.hpp"

namespace tessera::peers {
namespace {

struct Vector {
  float x, y, z;
};
Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(Vector a, float s) { return {a.x * s, a.y * s, a.z * s}; }
float dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector normalize(Vector a) { return a * (1 / std::sqrt(dot(a, a))); }

// In [0, 1). The mixing steps and constants: Wellons 2018, "Prospecting for hash functions", lowbias32.
float random_of(std::uint32_t pixel, std::uint32_t which) {
  std::uint32_t h = pixel * 16 + which;
  h = (h ^ h >> 16) * 0x7feb352du;
  h = (h ^ h >> 15) * 0x846ca68bu;
  return float((h ^ h >> 16) >> 8) * 0x1p-24f;
}

constexpr int columns = 11, rows = 7;
constexpr float radius = 0.42f;
constexpr float least_roughness = 0.12f;  // far below it single precision tells GGX's peak to no better than 1 %

struct Surface {
  Vector position, normal, color;
  float metallic, roughness, occlusion, bump;
};

Surface floor_at(Vector p) {
  const bool dark = ((int(std::floor(p.x)) + int(std::floor(p.z))) & 1) != 0;
  return {p,    {0, 1, 0}, dark ? Vector{0.1f, 0.12f, 0.15f} : Vector{0.6f, 0.57f, 0.5f}, 0, dark ? 0.3f : 0.6f,
          0.8f, 0.03f};
}

Surface sphere_at(Vector p, Vector centre, int column, int row) {
  const float u = float(column) / (columns - 1), v = float(row) / (rows - 1);
  constexpr float bumps[] = {0.01f, 0.03f, 0.09f};
  return {p,
          normalize(p - centre),
          {0.9f - 0.6f * v, 0.35f + 0.4f * u, 0.25f + 0.6f * v},
          row % 2 == 0 ? 1.0f : 0.0f,
          least_roughness + (1 - least_roughness) * u,
          0.5f + 0.5f * p.y / (2 * radius),
          bumps[(row * columns + column) % 3]};
}

// The nearest surface along a ray that points downwards.
Surface hit(Vector from, Vector along) {
  float nearest = -from.y / along.y;
  Surface surface = floor_at(from + along * nearest);
  for (int i = 0; i < columns * rows; ++i) {
    const int column = i % columns, row = i / columns;
    const Vector centre{float(column - columns / 2), radius, 2 - float(row)}, to = centre - from;
    const float middle = dot(to, along), inside = radius * radius - (dot(to, to) - middle * middle);
    if (inside <= 0) continue;
    const float distance = middle - std::sqrt(inside);
    if (distance >= nearest) continue;
    nearest = distance;
    surface = sphere_at(from + along * distance, centre, column, row);
  }
  return surface;
}

}  // namespace

std::vector<float> cast_gbuffer(int width, int height) {
  const std::size_t plane = std::size_t(width) * std::size_t(height);
  std::vector<float> out(12 * plane);
  const Vector from{eye[0], eye[1], eye[2]}, forward = normalize(Vector{0, 0.3f, -1.5f} - from);
  const Vector up{0, -forward.z, forward.y};  // of the camera, which does not look aside
  constexpr float half_height = 0.36f;        // tangent of half the vertical angle: the top row still sees the floor
  parallel_for(std::size_t(height), [&](std::size_t y) {
    for (std::size_t x = 0; x < std::size_t(width); ++x) {
      const float s = (2 * float(x) + 1 - float(width)) / float(height), t = 1 - (2 * float(y) + 1) / float(height);
      const Surface at = hit(from, normalize(forward + Vector{s, 0, 0} * half_height + up * (t * half_height)));
      const auto pixel = std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x);
      const auto jitter = [&](std::uint32_t which) { return 2 * random_of(pixel, which) - 1; };
      const Vector n = normalize(at.normal + Vector{jitter(0), jitter(1), jitter(2)} * at.bump);
      const float values[12] = {at.position.x,
                                at.position.y,
                                at.position.z,
                                n.x,
                                n.y,
                                n.z,
                                at.color.x * (1 + 0.1f * jitter(3)),
                                at.color.y * (1 + 0.1f * jitter(4)),
                                at.color.z * (1 + 0.1f * jitter(5)),
                                at.metallic,
                                std::clamp(at.roughness + 0.05f * jitter(6), least_roughness, 1.0f),
                                std::clamp(at.occlusion + 0.1f * jitter(7), 0.2f, 1.0f)};
      for (std::size_t p = 0; p < 12; ++p) out[p * plane + pixel] = values[p];
    }
  });
  return out;
}

std::vector<float> place_lights(int count) {
  std::vector<float> records;
  for (int i = 0; i < count; ++i) {
    // Points that fill the square evenly: Roberts 2018, the R2 sequence.
    const float u = std::fmod(0.5f + 0.7548777f * float(i), 1.0f), v = std::fmod(0.5f + 0.5698403f * float(i), 1.0f);
    const float power = 160 / std::sqrt(float(count)), warmth = random_of(std::uint32_t(i), 8);
    const float record[] = {
        12 * u - 6, 2 + 2 * random_of(std::uint32_t(i), 9), 3 - 9 * v,      count > 4 ? 11.0f : 60.0f,
        power,      power * (0.7f + 0.3f * warmth),         power * warmth, 0};
    records.insert(records.end(), std::begin(record), std::end(record));
  }
  return records;
}

Radiance sky(float x, float y, float z) {
  if (y < 0) return {0.22f, 0.2f, 0.18f};
  const float cloud = ((int(std::floor(8 * x)) ^ int(std::floor(8 * z))) & 1) != 0 ? 1.25f : 0.8f;
  const bool sun = x * 0.48f + y * 0.64f + z * 0.6f > 0.99f;
  const float add = sun ? 30.0f : 0.0f;
  return {(0.9f - 0.7f * y) * cloud + add, (0.9f - 0.5f * y) * cloud + 0.9f * add, (1 - 0.2f * y) * cloud + 0.8f * add};
}

}  // namespace tessera::peers

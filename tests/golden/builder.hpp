// Puts meshes into a Scene.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>

#include "scene/scene.hpp"

namespace tessera::golden {

using Point = std::array<double, 3>;

/// SplitMix64: integers, the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  double uniform() { return static_cast<double>(next() >> 11) / 9007199254740992.0; }
  double between(double lo, double hi) { return lo + (hi - lo) * uniform(); }

 private:
  std::uint64_t state_;
};

class Builder {
 public:
  explicit Builder(Scene& scene) : scene_(scene) {}

  int material(const Material& m) {
    scene_.materials.push_back(m);
    return static_cast<int>(scene_.materials.size()) - 1;
  }

  /// RGBA8 image from a function of the texel.
  int texture(int width, int height, const Sampler& sampler, const std::function<std::array<int, 4>(int, int)>& texel) {
    SourceImage image;
    image.name = "generated";
    image.width = width;
    image.height = height;
    image.channels = 4;
    image.pixels.resize(std::size_t(width) * height * 4);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::array<int, 4> t = texel(x, y);
        for (int k = 0; k < 4; ++k) image.pixels[(std::size_t(y) * width + x) * 4 + k] = static_cast<std::byte>(t[k]);
      }
    scene_.images.push_back(std::move(image));
    scene_.textures.push_back({static_cast<int>(scene_.images.size()) - 1, sampler});
    return static_cast<int>(scene_.textures.size()) - 1;
  }

  void begin_part(int material, bool tangents = false, bool colors = false) {
    const MaterialBinding binding{material, tangents, colors};
    binding_ = 0;
    while (binding_ < scene_.bindings.size() && !(scene_.bindings[binding_] == binding)) ++binding_;
    if (binding_ == scene_.bindings.size()) scene_.bindings.push_back(binding);
    scene_.parts.push_back(
        {"node", "mesh", static_cast<std::uint32_t>(scene_.triangles.size()), 0, static_cast<int>(binding_)});
  }

  std::uint32_t vertex(const Point& p, const Point& n, double u, double v) {
    for (const double c : p) scene_.positions.push_back(static_cast<float>(c));
    VertexAttributes a{};
    for (int k = 0; k < 3; ++k) a.normal[k] = static_cast<float>(n[k]);
    for (float& c : a.color) c = 1;
    for (auto& set : a.uv) set[0] = static_cast<float>(u), set[1] = static_cast<float>(v);
    scene_.attributes.push_back(a);
    return static_cast<std::uint32_t>(scene_.attributes.size()) - 1;
  }
  VertexAttributes& attributes(std::uint32_t v) { return scene_.attributes[v]; }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    scene_.triangles.push_back({{a, b, c}, static_cast<std::uint32_t>(binding_)});
    ++scene_.parts.back().triangle_count;
  }

  /// corner + s * side + t * up, s and t in 0..1, seen from the side of cross(side, up). UVs cover 0..uv_scale.
  std::array<std::uint32_t, 4> quad(const Point& corner, const Point& side, const Point& up, double uv_scale = 1) {
    Point n = {side[1] * up[2] - side[2] * up[1], side[2] * up[0] - side[0] * up[2], side[0] * up[1] - side[1] * up[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (double& c : n) c /= length;
    std::array<std::uint32_t, 4> v{};
    for (int k = 0; k < 4; ++k) {
      const double s = k == 1 || k == 2, t = k >= 2;
      v[k] = vertex({corner[0] + s * side[0] + t * up[0], corner[1] + s * side[1] + t * up[1],
                     corner[2] + s * side[2] + t * up[2]},
                    n, s * uv_scale, (1 - t) * uv_scale);
    }
    triangle(v[0], v[1], v[2]);
    triangle(v[0], v[2], v[3]);
    return v;
  }

  /// A cube of n x n quads a face pushed out to a sphere.
  void sphere(const Point& center, double radius, int n) {
    static constexpr int axes[6][3][3] = {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                          {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                                          {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}};
    for (const auto& face : axes) {
      const auto first = static_cast<std::uint32_t>(scene_.attributes.size());
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          const double s = 2.0 * i / n - 1, t = 2.0 * j / n - 1;
          Point d{};
          for (int k = 0; k < 3; ++k) d[k] = face[0][k] + s * face[1][k] + t * face[2][k];
          const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
          for (double& c : d) c /= length;
          vertex({center[0] + radius * d[0], center[1] + radius * d[1], center[2] + radius * d[2]}, d, double(i) / n,
                 1 - double(j) / n);
        }
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const std::uint32_t a = first + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
          triangle(a, b, c);
          triangle(a, c, d);
        }
    }
  }

 private:
  Scene& scene_;
  std::size_t binding_ = 0;
};

}  // namespace tessera::golden

// Sampling, observed through the resolve kernel: a triangle with UVs affine in the window, the texel in base colour.
// Every level holds its own random texels, so that a wrong level shows as much as a wrong texel or weight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "kernels/raster/resolve_fixture.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::resolve_test {
namespace {

struct Affine {  // u = c0 + cx x + cy y
  double c0, cx, cy;
  [[nodiscard]] double at(double x, double y) const { return c0 + cx * x + cy * y; }
};

double half_value(std::uint16_t h) {
  const int exponent = h >> 10 & 31, mantissa = h & 1023;
  return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
}

TextureMemory random_texture(int width, int height, TexelFormat format, std::mt19937& random) {
  TextureMemory t;
  int levels = 0;
  for (int size = std::max(width, height); size > 0; size /= 2) {
    const std::size_t numbers = std::size_t(4) * std::max(1, width >> levels) * std::max(1, height >> levels);
    for (std::size_t i = 0; i < numbers; ++i) {
      if (format != TexelFormat::rgba16_float)
        t.bytes.push_back(std::uint8_t(random() % 256));
      else
        t.halves.push_back(std::uint16_t(random() % 0x4400));  // 0 .. 4, half denormals among them
    }
    ++levels;
  }
  t.view = {nullptr,
            format,
            width,
            height,
            levels,
            WrapMode::repeat,
            WrapMode::repeat,
            FilterMode::linear,
            FilterMode::linear,
            FilterMode::linear,
            true};
  return t;
}

// The slow, obvious twin: integer wrapping of texel indices, everything in double.
class Reference {
 public:
  explicit Reference(const TextureMemory& t) : t_(t) {}

  [[nodiscard]] double sample(double u, double v, double lod, int channel) const {
    const TextureView& view = t_.view;
    const FilterMode filter = lod > 0 ? view.minify : view.magnify;
    if (!view.mipmapped) return level(u, v, 0, filter, channel);
    const double fine = std::clamp(lod, 0.0, double(view.levels - 1));
    if (view.mip == FilterMode::nearest) return level(u, v, int(fine + 0.5), filter, channel);
    const int k = int(fine);
    const double a = level(u, v, k, filter, channel);
    const double b = level(u, v, std::min(k + 1, view.levels - 1), filter, channel);
    return a + (fine - k) * (b - a);
  }

  // Whether rounding could choose another texel: only where a nearest filter has its edges.
  [[nodiscard]] bool near_edge(double u, double v, double lod) const {
    const FilterMode filter = lod > 0 ? t_.view.minify : t_.view.magnify;
    if (filter == FilterMode::linear) return false;
    for (int k = 0; k < t_.view.levels; ++k) {
      const double x = u * width(k), y = v * height(k);
      if (std::abs(x - std::round(x)) < 1e-3 || std::abs(y - std::round(y)) < 1e-3) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] int width(int k) const { return std::max(1, t_.view.width >> k); }
  [[nodiscard]] int height(int k) const { return std::max(1, t_.view.height >> k); }

  static int wrap(int i, int n, WrapMode mode) {
    const auto modulo = [](int a, int b) { return (a % b + b) % b; };
    if (mode == WrapMode::repeat) return modulo(i, n);
    if (mode == WrapMode::clamp_to_edge) return std::clamp(i, 0, n - 1);
    const int m = modulo(i, 2 * n);
    return m < n ? m : 2 * n - 1 - m;
  }

  [[nodiscard]] double texel(int x, int y, int k, int channel) const {
    std::size_t first = 0;
    for (int j = 0; j < k; ++j) first += std::size_t(width(j)) * height(j);
    const int wx = wrap(x, width(k), t_.view.wrap_u), wy = wrap(y, height(k), t_.view.wrap_v);
    const std::size_t at = (first + std::size_t(wy) * width(k) + wx) * 4 + channel;
    if (t_.view.format == TexelFormat::rgba16_float) return half_value(t_.halves[at]);
    const double value = t_.bytes[at] / 255.0;
    return t_.view.format == TexelFormat::rgba8_squares && channel < 3 ? value * value : value;
  }

  [[nodiscard]] double level(double u, double v, int k, FilterMode filter, int channel) const {
    if (filter == FilterMode::nearest)
      return texel(int(std::floor(u * width(k))), int(std::floor(v * height(k))), k, channel);
    const double x = u * width(k) - 0.5, y = v * height(k) - 0.5;
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const double fx = x - i, fy = y - j;
    return (1 - fy) * ((1 - fx) * texel(i, j, k, channel) + fx * texel(i + 1, j, k, channel)) +
           fy * ((1 - fx) * texel(i, j + 1, k, channel) + fx * texel(i + 1, j + 1, k, channel));
  }

  const TextureMemory& t_;
};

void expect_like_reference(const Kernels& kernels, TextureMemory& texture, const Affine& u, const Affine& v,
                           const std::string& what) {
  Workbench bench;
  bench.material.alpha_mode = AlphaMode::blend;
  // Texels reach 4, a G-buffer's colours 1.
  for (int c = 0; c < 3; ++c) bench.material.base_color[c] = 0.25f;
  bind(bench.material.base_color_texture, texture);
  add_covering_triangle(bench, [&](double x, double y) {
    VertexAttributes a = plain_attributes();
    a.uv[0][0] = float(u.at(x, y));
    a.uv[0][1] = float(v.at(x, y));
    return a;
  });
  const std::vector<Fragment> fragments = whole_tile();
  const GBuffer out = bench.resolve(kernels, fragments);
  const Reference reference(texture);
  const double w = texture.view.width, h = texture.view.height;
  const double lod = std::log2(std::max(std::hypot(u.cx * w, v.cx * h), std::hypot(u.cy * w, v.cy * h)));
  // Rounding of u and v (2^-24 each time, of up to 40 textures' widths), times texels' largest difference.
  const double tolerance = 1e-4 + 4 * 2e-7 * 40 * std::max(w, h);
  int compared = 0;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const double x = tile_pixel_x(fragments[i].pixel) + 0.5, y = tile_pixel_y(fragments[i].pixel) + 0.5;
    const double uu = u.at(x, y), vv = v.at(x, y);
    if (reference.near_edge(uu, vv, lod)) continue;
    ++compared;
    for (int c = 0; c < 4; ++c) {
      const double expected = reference.sample(uu, vv, lod, c);
      const double found = c < 3 ? 4 * double(out.planes[color + c][i]) : double(out.planes[alpha][i]);
      ASSERT_NEAR(found, c < 3 ? expected : std::min(expected, 1.0), tolerance)
          << kernels.isa << " " << what << " at " << x << ", " << y << " channel " << c << " lod " << lod;
    }
  }
  EXPECT_GT(compared, 800) << what;
}

constexpr WrapMode wraps[] = {WrapMode::repeat, WrapMode::mirrored_repeat, WrapMode::clamp_to_edge};
constexpr FilterMode filters[] = {FilterMode::nearest, FilterMode::linear};
constexpr int sizes[][2] = {{16, 16}, {5, 3}, {1, 1}, {32, 1}, {7, 12}};

// About -1.5 .. 2.7 across the tile, turned a little: beyond the unit square on every side.
constexpr Affine around_u{-1.4373, 0.1131, 0.0171}, around_v{2.3119, -0.0213, -0.1057};

TEST(Sample, EveryWrapFormatAndSize) {
  std::mt19937 random(1);
  for (const Kernels* kernels : runnable_kernels())
    for (const TexelFormat format : {TexelFormat::rgba8_unorm, TexelFormat::rgba16_float, TexelFormat::rgba8_squares})
      for (const auto& size : sizes) {
        TextureMemory texture = random_texture(size[0], size[1], format, random);
        for (const WrapMode wrap_u : wraps)
          for (const WrapMode wrap_v : wraps) {
            texture.view.wrap_u = wrap_u;
            texture.view.wrap_v = wrap_v;
            expect_like_reference(*kernels, texture, around_u, around_v,
                                  std::to_string(size[0]) + "x" + std::to_string(size[1]) + " wrap " +
                                      std::to_string(int(wrap_u)) + std::to_string(int(wrap_v)));
          }
      }
}

TEST(Sample, EveryFilterMagnifiedAndMinified) {
  std::mt19937 random(2);
  for (const Kernels* kernels : runnable_kernels())
    for (const TexelFormat format : {TexelFormat::rgba8_unorm, TexelFormat::rgba16_float, TexelFormat::rgba8_squares}) {
      TextureMemory texture = random_texture(64, 48, format, random);
      for (int f = 0; f < 16; ++f)
        for (const double scale : {0.004, 0.0219, 0.0391, 0.213, 1.07}) {  // lod -2, 0.5, 1.3, 3.8, beyond the last
          texture.view.magnify = filters[f & 1];
          texture.view.minify = filters[f >> 1 & 1];
          texture.view.mip = filters[f >> 2 & 1];
          texture.view.mipmapped = (f & 8) != 0;
          expect_like_reference(*kernels, texture, {0.31, scale, 0.1 * scale}, {-0.21, -0.3 * scale, 0.7 * scale},
                                "filters " + std::to_string(f) + " scale " + std::to_string(scale));
        }
    }
}

// The level follows the longer axis, whichever it is, on textures that are not square.
TEST(Sample, LevelOfTheLongerAxis) {
  std::mt19937 random(3);
  for (const Kernels* kernels : runnable_kernels()) {
    TextureMemory texture = random_texture(128, 16, TexelFormat::rgba16_float, random);
    expect_like_reference(*kernels, texture, {0, 0.05, 0}, {0, 0, 0.01}, "x along u");
    expect_like_reference(*kernels, texture, {0, 0.001, 0}, {0, 0, 0.3}, "y along v");
    expect_like_reference(*kernels, texture, {0, 0, 0.04}, {0, 0.2, 0}, "turned by 90 degrees");
  }
}

TEST(Sample, WhiteStaysExactlyWhite) {
  for (const Kernels* kernels : runnable_kernels()) {
    TextureMemory texture;
    texture.bytes.assign(std::size_t(4) * (64 + 16 + 4 + 1), 255);
    texture.view = trilinear(TexelFormat::rgba8_unorm, 8, 8, 4);
    Workbench bench;
    bind(bench.material.base_color_texture, texture);
    add_covering_triangle(bench, [](float x, float y) {
      VertexAttributes a = plain_attributes();
      a.uv[0][0] = 0.2137f * x;
      a.uv[0][1] = 0.1177f * y;
      return a;
    });
    const GBuffer out = bench.resolve(*kernels, whole_tile());
    for (int i = 0; i < tile_pixels; ++i) ASSERT_EQ(out.planes[color][i], 1.0f) << kernels->isa << " " << i;
  }
}

// No coordinate reads outside the texture (AddressSanitizer watches) or gives a value outside the texels' range.
TEST(Sample, AnyCoordinateIsSafe) {
  const float wild[] = {0.0f,  -0.0f, 1.0f,     -1e-9f,   1e-39f,    8388608.5f,
                        -3e9f, 1e30f, -3.4e38f, INFINITY, -INFINITY, NAN};
  std::mt19937 random(4);
  for (const Kernels* kernels : runnable_kernels())
    for (const auto& size : sizes) {
      TextureMemory texture = random_texture(size[0], size[1], TexelFormat::rgba16_float, random);
      for (const WrapMode wrap : wraps)
        for (const FilterMode filter : filters) {
          texture.view.wrap_u = texture.view.wrap_v = wrap;
          texture.view.magnify = filter;
          Workbench bench;
          bind(bench.material.base_color_texture, texture);
          std::vector<Fragment> fragments;
          for (const float u : wild)
            for (const float v : wild) {
              VertexAttributes a = plain_attributes();
              a.uv[0][0] = u;
              a.uv[0][1] = v;
              const std::uint32_t corner = bench.add_vertex(0, 0, 1, a);
              bench.add_vertex(0, 64, 1, a);
              bench.add_vertex(64, 0, 1, a);
              fragments.push_back({bench.add_triangle(corner, corner + 1, corner + 2), pixel(3, 4), 1});
            }
          const GBuffer out = bench.resolve(*kernels, fragments);
          for (std::size_t i = 0; i < fragments.size(); ++i) {
            ASSERT_GE(out.planes[color][i], 0.0f);
            ASSERT_LE(out.planes[color][i], 4.0f);
          }
        }
    }
}

}  // namespace
}  // namespace tessera::resolve_test

// What lies behind a tile's surfaces: the environment along the pixels' rays, or one colour. In stages, as stages.hpp
// has them.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/light/environment.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/shade/stages.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// Where a block's pixels are, from its first one.
alignas(64) inline constexpr float lane_x[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) inline constexpr float lane_y[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
static_assert(16 % Wide::lanes == 0);

/// The rays of 64 pixels, four blocks in a row, on their way.
struct Rays {
  int first;  // of the tile's pixels
  Footprints fine, coarse;
  alignas(64) float radiance[3][block_size];
};

/// blurred: both levels are looked up.
template <bool blurred, class F>
[[gnu::noinline]] void find_ray_footprints(const BackgroundArgs& args, const UniformLookup& lookup, Rays& rays) {
  const int faces = cube_face_texels(args.cube.size, args.cube.levels);
  for (int i = 0; i < block_size; i += F::lanes) {
    const int pixel = rays.first + i;
    const F x = F(float(args.x + tile_pixel_x(pixel & -16)) + 0.5f) + load<F>(lane_x + pixel % 16);
    const F y = F(float(args.y + tile_pixel_y(pixel & -16)) + 0.5f) + load<F>(lane_y + pixel % 16);
    const auto along = [&](int axis) {
      return mul_add(y, F(args.dy[axis]), mul_add(x, F(args.dx[axis]), F(args.corner[axis])));
    };
    const CubePoint<F> p = cube_point_of_any(Vec3<F>{along(0), along(1), along(2)}, faces);
    rays.fine.set(i, cube_footprint(args.cube, p, lookup.fine));
    if constexpr (blurred) rays.coarse.set(i, cube_footprint(args.cube, p, lookup.coarse));
  }
}

template <bool blurred>
[[gnu::noinline]] void read_rays(const BackgroundArgs& args, Rays& rays) {
  const CubeView cube = args.cube;
  for (int i = 0; i < block_size; i += Float::lanes) {
    Vec3<Float> radiance = read_footprint(HalfTexels{}, cube, rays.fine, i);
    if constexpr (blurred) radiance = radiance + read_footprint(HalfTexels{}, cube, rays.coarse, i);
    store_vector(rays.radiance, i, clamp_radiance(radiance));
  }
}

/// Sets, or adds to what surfaces let through, the radiance behind them.
TESSERA_INLINE void add_behind(const BackgroundArgs& args, int pixel, const Vec3<Float>& behind) {
  const Float L[3] = {behind.x, behind.y, behind.z};
  if (args.remaining == nullptr) {
    for (int k = 0; k < 3; ++k) store(args.rgba[k] + pixel, L[k] + Float(0));
    store(args.rgba[3] + pixel, Float(1));
    return;
  }
  const Float remaining = load<Float>(args.remaining + pixel);
  for (int k = 0; k < 3; ++k) store(args.rgba[k] + pixel, load<Float>(args.rgba[k] + pixel) + remaining * L[k]);
  store(args.rgba[3] + pixel, select(remaining > Float(0), Float(1), load<Float>(args.rgba[3] + pixel)));
}

/// Whether any of the pixels from `first` on shows what is behind it.
inline bool is_open(const BackgroundArgs& args, int first) {
  if (args.remaining == nullptr) return true;
  Float most(0);
  for (int i = 0; i < block_size; i += Float::lanes) most = max(most, load<Float>(args.remaining + first + i));
  return any(most > Float(0));
}

template <bool blurred>
inline void environment_behind(const BackgroundArgs& args, const UniformLookup& lookup) {
  Rays rays;
  for (int y = 0; y < args.height; y += 4)
    for (int x = 0; x < args.width; x += block_size / 4) {
      rays.first = tile_pixel(x, y);
      if (!is_open(args, rays.first)) continue;
      find_ray_footprints<blurred, Wide>(args, lookup, rays);
      read_rays<blurred>(args, rays);
      for (int i = 0; i < block_size; i += Float::lanes)
        add_behind(args, rays.first + i, load_vector<Float>(rays.radiance, i));
    }
}

inline void color_behind(const BackgroundArgs& args) {
  const Vec3<Float> color = {Float(args.color[0]), Float(args.color[1]), Float(args.color[2])};
  for (int y = 0; y < args.height; y += 4)
    for (int x = 0; x < args.width; x += block_size / 4)
      for (int i = 0; i < block_size; i += Float::lanes) add_behind(args, tile_pixel(x, y) + i, color);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

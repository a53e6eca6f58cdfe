#include "frame/composite.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace tessera {

namespace {

// One pixel's fragments [begin, end), in order. Sums of equal weights are exact, so this and the short cut for a pixel
// that one opaque fragment covers agree to the bit.
void composite_pixel(const TileFragments& tile, std::size_t begin, std::size_t end, int samples, const float* alpha,
                     const std::array<float*, 3>& radiance, int pixel, TilePixels& out) {
  float transmittance[max_samples];
  std::fill_n(transmittance, samples, 1.0f);
  const float per_sample = 1.0f / static_cast<float>(samples);
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t slot = tile.slot(i);
    const float a = alpha[slot];
    float visible = 0;
    for (std::uint32_t bits = tile.fragments[i].samples; bits != 0; bits &= bits - 1) {
      float& t = transmittance[std::countr_zero(bits)];
      visible += t;
      t *= 1 - a;
    }
    const float weight = visible * a * per_sample;
    for (int k = 0; k < 3; ++k) out.rgba[k][pixel] += weight * radiance[k][slot];
    out.rgba[3][pixel] += weight;
  }
  float left = 0;
  for (int s = 0; s < samples; ++s) left += transmittance[s];
  out.remaining[pixel] = left * per_sample;
}

void store_tile(const TilePixels& pixels, const Kernels& kernels, const TileFilm& film) {
  kernels.store_pixels({{pixels.rgba[0], pixels.rgba[1], pixels.rgba[2], pixels.rgba[3]},
                        film.width,
                        film.height,
                        film.rgba,
                        film.row_stride});
}

void add_background(const BackgroundSource& background, const View& view, const Kernels& kernels, TilePixels& pixels,
                    const float* remaining, const TileFilm& film) {
  BackgroundArgs args{};
  for (int k = 0; k < 3; ++k) {
    args.corner[k] = view.ray_corner[k];
    args.dx[k] = view.ray_dx[k];
    args.dy[k] = view.ray_dy[k];
    args.color[k] = background.color[k];
  }
  if (background.kind == Background::environment) args.cube = background.cube;
  args.lod = background.lod;
  args.x = film.x;
  args.y = film.y;
  args.width = film.width;
  args.height = film.height;
  args.remaining = remaining;
  for (int k = 0; k < 4; ++k) args.rgba[k] = pixels.rgba[k];
  kernels.background(args);
}

}  // namespace

void composite_surfaces(const TileFragments& tile, int samples, TilePixels& pixels) {
  std::memset(pixels.rgba, 0, sizeof(pixels.rgba));
  std::fill_n(pixels.remaining, tile_pixels, 1.0f);
  const GBufferView gbuffer = tile.gbuffer();
  const float* alpha = gbuffer.alpha;
  const std::array<float*, 3> radiance = tile.radiance();
  const std::uint32_t whole = (1u << samples) - 1;
  const std::size_t count = tile.fragments.size();
  for (std::size_t i = 0; i < count;) {
    const int pixel = tile.fragments[i].pixel;
    const std::uint32_t slot = tile.slot(i);
    if (tile.fragments[i].samples == whole && alpha[slot] == 1) {  // nothing behind it shows
      for (int k = 0; k < 3; ++k) pixels.rgba[k][pixel] = radiance[k][slot];
      pixels.rgba[3][pixel] = 1;
      pixels.remaining[pixel] = 0;
      do ++i;
      while (i < count && tile.fragments[i].pixel == pixel);
      continue;
    }
    std::size_t end = i + 1;
    while (end < count && tile.fragments[end].pixel == pixel) ++end;
    composite_pixel(tile, i, end, samples, alpha, radiance, pixel, pixels);
    i = end;
  }
}

void composite_background(const BackgroundSource& background, const View& view, const Kernels& kernels,
                          TilePixels& pixels, const TileFilm& film) {
  if (background.kind != Background::transparent)
    add_background(background, view, kernels, pixels, pixels.remaining, film);
  store_tile(pixels, kernels, film);
}

void background_alone(const BackgroundSource& background, const View& view, const Kernels& kernels, TilePixels& pixels,
                      const TileFilm& film) {
  if (background.kind == Background::transparent)
    std::memset(pixels.rgba, 0, sizeof(pixels.rgba));
  else
    add_background(background, view, kernels, pixels, nullptr, film);
  store_tile(pixels, kernels, film);
}

}  // namespace tessera

#include "frame/composite.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace tessera {

CompositeScratch::CompositeScratch()
    : rgba(4 * tile_pixels),
      remaining(tile_pixels),
      x(tile_pixels),
      y(tile_pixels),
      radiance(3 * tile_pixels),
      pixels(tile_pixels) {}

namespace {

// One pixel's fragments [begin, end), in order. Sums of equal weights are exact, so this and the short cut for a pixel
// that one opaque fragment covers agree to the bit.
void composite_pixel(const TileFragments& tile, std::size_t begin, std::size_t end, int samples, const float* alpha,
                     const std::array<float*, 3>& radiance, float* rgba, float& remaining) {
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
    for (int k = 0; k < 3; ++k) rgba[k] += weight * radiance[k][slot];
    rgba[3] += weight;
  }
  float left = 0;
  for (int s = 0; s < samples; ++s) left += transmittance[s];
  remaining = left * per_sample;
}

}  // namespace

void composite_surfaces(const TileFragments& tile, int samples, CompositeScratch& scratch) {
  std::memset(scratch.rgba.data(), 0, scratch.rgba.size() * sizeof(float));
  std::fill(scratch.remaining.begin(), scratch.remaining.end(), 1.0f);
  const GBufferView gbuffer = tile.gbuffer();
  const float* alpha = gbuffer.alpha;
  const std::array<float*, 3> radiance = tile.radiance();
  const std::uint32_t whole = (1u << samples) - 1;
  const std::size_t count = tile.fragments.size();
  for (std::size_t i = 0; i < count;) {
    const std::uint16_t pixel = tile.fragments[i].pixel;
    float* rgba = scratch.rgba.data() + std::size_t{4} * pixel;
    const std::uint32_t slot = tile.slot(i);
    if (tile.fragments[i].samples == whole && alpha[slot] == 1) {  // nothing behind it shows
      for (int k = 0; k < 3; ++k) rgba[k] = radiance[k][slot];
      rgba[3] = 1;
      scratch.remaining[pixel] = 0;
      do ++i;
      while (i < count && tile.fragments[i].pixel == pixel);
      continue;
    }
    std::size_t end = i + 1;
    while (end < count && tile.fragments[end].pixel == pixel) ++end;
    composite_pixel(tile, i, end, samples, alpha, radiance, rgba, scratch.remaining[pixel]);
    i = end;
  }
}

void background_alone(const BackgroundSource& background, const View& view, const Kernels& kernels,
                      CompositeScratch& scratch, const TileFilm& film) {
  if (background.kind == Background::environment) {
    std::memset(scratch.rgba.data(), 0, scratch.rgba.size() * sizeof(float));
    std::fill(scratch.remaining.begin(), scratch.remaining.end(), 1.0f);
    composite_background(background, view, kernels, scratch, film);
    return;
  }
  const float one = background.kind == Background::color ? 1.0f : 0.0f;
  // 0 + makes -0 positive, as compositing does.
  const float pixel[4] = {0.0f + one * background.color[0], 0.0f + one * background.color[1],
                          0.0f + one * background.color[2], one};
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x)
      std::memcpy(
          film.rgba + static_cast<std::size_t>(y) * film.row_stride + std::size_t{4} * static_cast<std::size_t>(x),
          pixel, sizeof(pixel));
}

void composite_background(const BackgroundSource& background, const View& view, const Kernels& kernels,
                          CompositeScratch& scratch, const TileFilm& film) {
  std::uint32_t count = 0;
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) {
      const int pixel = tile_pixel(x, y);
      if (!(scratch.remaining[pixel] > 0)) continue;
      scratch.pixels[count] = static_cast<std::uint16_t>(pixel);
      scratch.x[count] = static_cast<float>(film.x + x) + 0.5f;
      scratch.y[count] = static_cast<float>(film.y + y) + 0.5f;
      ++count;
    }
  if (count != 0 && background.kind != Background::transparent) {
    float* radiance[3] = {scratch.radiance.data(), scratch.radiance.data() + tile_pixels,
                          scratch.radiance.data() + 2 * tile_pixels};
    if (background.kind == Background::environment) {
      BackgroundArgs args{};
      for (int k = 0; k < 3; ++k) {
        args.corner[k] = view.ray_corner[k];
        args.dx[k] = view.ray_dx[k];
        args.dy[k] = view.ray_dy[k];
        args.radiance[k] = radiance[k];
      }
      args.cube = background.cube;
      args.lod = background.lod;
      args.x = scratch.x.data();
      args.y = scratch.y.data();
      args.count = count;
      kernels.background(args);
    } else {
      for (int k = 0; k < 3; ++k) std::fill_n(radiance[k], count, background.color[k]);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint16_t pixel = scratch.pixels[i];
      float* rgba = scratch.rgba.data() + std::size_t{4} * pixel;
      for (int k = 0; k < 3; ++k) rgba[k] += scratch.remaining[pixel] * radiance[k][i];
      rgba[3] = 1;
    }
  }
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; x += 4)  // four pixels of a block's row
      std::memcpy(film.rgba + y * film.row_stride + std::size_t{4} * x,
                  scratch.rgba.data() + std::size_t{4} * tile_pixel(x, y),
                  std::min(4, film.width - x) * 4 * sizeof(float));
}

}  // namespace tessera

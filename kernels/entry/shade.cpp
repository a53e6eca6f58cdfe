// Shading of G-buffers, and the visible background.
#include "kernels/entry/entries.hpp"
#include "kernels/light/environment.hpp"
#include "kernels/shade/background.hpp"
#include "kernels/shade/cull.hpp"
#include "kernels/shade/film.hpp"
#include "kernels/shade/tile.hpp"

namespace tessera::TESSERA_ISA {

namespace {

// The sets that scenes are made of have their own instance; the others run the next larger one.
template <bool plain>
void shade_lit_by_environment(const ShadeArgs& args, std::uint32_t features, std::uint32_t light_count) {
  constexpr std::uint32_t lit = feature_lights | feature_environment;
  if (features == feature_environment) return shade_tile<feature_environment, plain>(args, 0);
  if (features == lit) return shade_tile<lit, plain>(args, light_count);
  return shade_tile<feature_all, plain>(args, light_count);
}

}  // namespace

void shade(const ShadeArgs& args) {
  // What these fragments use and this scene has.
  std::uint32_t features = args.features;
  const std::uint32_t light_count = features & feature_lights ? args.light_count : 0;
  if (light_count == 0) features &= ~feature_lights;
  if (!args.environment.specular.texels) features &= ~feature_environment;
  if (features & feature_environment) {
    return is_plain(args.environment_shading, args.environment)
               ? shade_lit_by_environment<true>(args, features, light_count)
               : shade_lit_by_environment<false>(args, features, light_count);
  }
  switch (features) {
    case 0:
      return shade_tile<0, true>(args, 0);
    case feature_lights:
      return shade_tile<feature_lights, true>(args, light_count);
    case feature_unlit:
      return shade_tile<feature_unlit, true>(args, 0);
    default:
      return shade_tile<feature_all & ~feature_environment, true>(args, light_count);
  }
}

void clamp_surfaces(const GBufferView& g, std::uint32_t count) {
  const auto clamp_plane = [count](float* plane, double low, double high) {
    if (plane == nullptr) return;
    const std::uint32_t padded = (count + max_lanes - 1) / max_lanes * max_lanes;
    for (std::uint32_t i = 0; i < padded; i += Float::lanes)
      store(plane + i, clamp(load<Float>(plane + i), Float(low), Float(high)));
  };
  for (int k = 0; k < 3; ++k) {
    clamp_plane(g.position[k], -max_coordinate, max_coordinate);
    clamp_plane(g.normal[k], -1, 1);
    clamp_plane(g.base_color[k], 0, 1);
    clamp_plane(g.emissive[k], 0, max_radiance);
  }
  clamp_plane(g.metallic, 0, 1);
  clamp_plane(g.roughness, 0, 1);
  clamp_plane(g.occlusion, 0, 1);
}

void background(const BackgroundArgs& args) {
  if (args.cube.texels == nullptr) return color_behind(args);
  const UniformLookup lookup = uniform_lookup(args.cube, args.lod);
  if (lookup.coarse.weight > 0.0f)
    environment_behind<true>(args, lookup);
  else
    environment_behind<false>(args, lookup);
}

std::uint32_t cull_lights(const CullLightsArgs& args) {
  return cull_lights_against(bounding_box(args.position, args.count), args.lights, args.out);
}

void store_pixels(const StorePixelsArgs& args) {
  constexpr int rows = Float::lanes / 4;  // a vector is 4 x rows pixels
  const FilmRows film(args.rgba, args.row_stride);
  for (int y = 0; y < args.height; y += rows) {
    float* out = args.rgba + std::size_t(y) * args.row_stride;
    for (int x = 0; x < args.width; x += 4, out += 16) {
      const int at = (y / 4 * (tile_size / 4) + x / 4) * 16 + y % 4 * 4;
      const Float pixel[4] = {load<Float>(args.channels[0] + at), load<Float>(args.channels[1] + at),
                              load<Float>(args.channels[2] + at), load<Float>(args.channels[3] + at)};
      if (y + rows > args.height || x + 4 > args.width) {
        float whole[4 * Float::lanes];
        store_quads(whole, 16, pixel);
        const int width = 4 * (args.width - x < 4 ? args.width - x : 4);
        for (int row = 0; row < rows && y + row < args.height; ++row)
          for (int i = 0; i < width; ++i)
            out[std::size_t(row) * args.row_stride + std::size_t(i)] = whole[16 * row + i];
      } else {
        film.store(out, pixel);
      }
    }
  }
}

}  // namespace tessera::TESSERA_ISA

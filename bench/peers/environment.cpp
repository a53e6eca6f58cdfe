#include "bench/peers/environment.hpp"

#include <vector>

#include "bench/peers/scene.hpp"
#include "precompute/prefilter.hpp"

namespace tessera::peers {
namespace {

constexpr int cube_size = 256, cube_levels = 9;

CubeLevel painted_sky() {
  CubeLevel level(cube_size);
  float* texel = level.texels.data();
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < cube_size; ++j)
      for (int i = 0; i < cube_size; ++i, texel += 4) {
        const CubeDirection d = texel_direction(face, i, j, cube_size);
        const Radiance radiance = sky(d.x, d.y, d.z);
        texel[0] = radiance.red, texel[1] = radiance.green, texel[2] = radiance.blue, texel[3] = 1;
      }
  return level;
}

}  // namespace

PaintedEnvironment paint_environment(const Kernels& kernels) {
  const CubeLevel level = painted_sky();
  std::vector<float> rgb;
  for (std::size_t i = 0; i < level.texels.size(); i += 4)
    rgb.insert(rgb.end(), level.texels.data() + i, level.texels.data() + i + 3);
  // A curve of 0: level k is for roughness k / 8.
  return {prefiltered(level, cube_levels, 0, kernels, 0),
          project_irradiance(CubeFacesView{rgb.data(), cube_size}, 0, kernels)};
}

}  // namespace tessera::peers

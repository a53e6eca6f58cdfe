#include "precompute/prefilter.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include "precompute/lobe.hpp"

namespace tessera {
namespace {

// The brightest texels of a level, as sources on their own.
struct BrightTexels {
  AlignedVector<float> x, y, z, red, green, blue;

  [[nodiscard]] PointSources view(const Lobe& lobe) const {
    return {x.data(),    y.data(),      z.data(),    red.data(), green.data(),
            blue.data(), int(x.size()), lobe.alpha2, lobe.scale};
  }
};

// Cuts what rises above the brightness of the max_bright-th texel off a level. A sun, a lamp, a window then weigh on
// the prefiltered levels exactly, and what is left is tame enough for points to sum.
constexpr std::size_t max_bright = 512;

BrightTexels cut_bright(CubeLevel& level) {
  const std::size_t count = level.texels.size() / 4;
  std::vector<float> brightness(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float* texel = &level.texels[i * 4];
    brightness[i] = std::max({texel[0], texel[1], texel[2]});
  }
  std::vector<float> sorted = brightness;
  const std::size_t rank = std::min(max_bright, count - 1);
  std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(rank), sorted.end(), std::greater<>());
  const float limit = sorted[rank];

  BrightTexels bright;
  const int n = level.size;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(brightness[i] > limit)) continue;
    const int face = int(i / (std::size_t(n) * std::size_t(n))), x = int(i) % n, y = int(i) / n % n;
    const CubeDirection d = texel_direction(face, x, y, n);
    bright.x.push_back(d.x);
    bright.y.push_back(d.y);
    bright.z.push_back(d.z);
    AlignedVector<float>* channels[3] = {&bright.red, &bright.green, &bright.blue};
    for (std::size_t c = 0; c < 3; ++c) {
      float& value = level.texels[i * 4 + c];
      channels[c]->push_back(std::max(value - limit, 0.0f) * d.solid_angle);
      value = std::min(value, limit);
    }
  }
  return bright;
}

// Points per texel of a level with this roughness: the smooth levels have most of the texels, the rough ones the most
// to sum over.
int samples_for(float roughness, int wanted) {
  if (wanted > 0) return wanted;
  return roughness < 0.25f ? 256 : roughness < 0.45f ? 512 : roughness < 0.6f ? 1024 : 4096;
}

CubeLevel prefilter(const Cube& radiance, const BrightTexels& bright, int size, float roughness, int samples,
                    const Kernels& kernels) {
  CubeLevel level(size);
  const Lobe lobe = ggx_lobe(roughness, samples_for(roughness, samples), radiance.size(), kernels);
  for_cube_rows(size, [&](CubeRows rows) {
    rows.out = level.face(rows.face);
    kernels.prefilter_cube({radiance.view(), lobe.view(), rows, bright.view(lobe)});
  });
  return level;
}

}  // namespace

Cube prefiltered(CubeLevel radiance, int levels, int samples, const Kernels& kernels) {
  Cube specular(radiance.size, levels);
  specular.store(0, radiance, kernels);
  if (levels == 1) return specular;

  const BrightTexels bright = cut_bright(radiance);
  Cube dim(radiance.size, log2_of(radiance.size) + 1);
  dim.store(0, radiance, kernels);
  for (int k = 1; k < dim.levels(); ++k) {
    radiance = halved(radiance);
    dim.store(k, radiance, kernels);
  }
  for (int k = 1; k < levels; ++k) {
    const float roughness = float(k) / float(levels - 1);
    specular.store(k, prefilter(dim, bright, specular.size() >> k, roughness, samples, kernels), kernels);
  }
  return specular;
}

}  // namespace tessera

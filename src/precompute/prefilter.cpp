#include "precompute/prefilter.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "precompute/lobe.hpp"
#include "precompute/sphere_tree.hpp"

namespace tessera {
namespace {

// The brightest texels of a level, as sources on their own.
struct BrightTexels {
  AlignedVector<float> x, y, z, red, green, blue;

  [[nodiscard]] PointSources view(const Lobe& lobe) const {
    return {x.data(),    y.data(),      z.data(),    red.data(), green.data(),
            blue.data(), int(x.size()), lobe.alpha2, lobe.scale};
  }

  // As light that weighs nothing in a mean: what it was cut off from is there already.
  void append_to(SphereCut& cut) const {
    const std::pair<ScratchVector<float>*, const AlignedVector<float>*> planes[] = {
        {&cut.x, &x}, {&cut.y, &y}, {&cut.z, &z}, {&cut.red, &red}, {&cut.green, &green}, {&cut.blue, &blue}};
    for (const auto& [to, from] : planes) to->insert(to->end(), from->begin(), from->end());
    cut.solid_angle.resize(cut.x.size(), 0.0f);
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

// All texels of a level, for a lobe to be summed over.
SphereCut all_texels(const CubeLevel& level) {
  SphereCut cut;
  const int n = level.size;
  const float* rgb = level.texels.data();
  for (int row = 0; row < 6 * n; ++row) {
    for (int i = 0; i < n; ++i, rgb += 4) {
      const CubeDirection d = texel_direction(row / n, i, row % n, n);
      cut.x.push_back(d.x);
      cut.y.push_back(d.y);
      cut.z.push_back(d.z);
      cut.red.push_back(rgb[0] * d.solid_angle);
      cut.green.push_back(rgb[1] * d.solid_angle);
      cut.blue.push_back(rgb[2] * d.solid_angle);
      cut.solid_angle.push_back(d.solid_angle);
    }
  }
  return cut;
}

CubeLevel convolve(int size, const CubeView& radiance, const LobeSamples& lobe, const PointSources& points,
                   const Kernels& kernels) {
  CubeLevel level(size);
  for_cube_rows(size, [&](CubeRows rows) {
    rows.out = level.face(rows.face);
    kernels.prefilter_cube({radiance, lobe, rows, points});
  });
  return level;
}

// From this roughness on, lobes are wide against the texels of faces of exact_size: those are all summed, which errs by
// less than 7e-4 of a level's RMS. Narrower lobes are summed over a tree of the finest texels, as fine as keeps below
// 1e-3.
constexpr int exact_size = 64;
constexpr float exact_roughness = 0.33f;
constexpr float fineness(float roughness) { return roughness < 0.2f ? 0.18f : 0.14f; }
constexpr int block_size = 8;  // texels along a side that share a cut of the tree

// Points per texel, if a number is asked for: filtered importance sampling. They read a level finer than the solid
// angle they stand for asks: less blur at the price of more noise, and half the error at 512 points.
constexpr float finer = 1;

// A picture without its brightest texels, which go by themselves.
class Filter {
 public:
  Filter(CubeLevel radiance, const Kernels& kernels)
      : kernels_(kernels),
        bright_(cut_bright(radiance)),
        finest_(std::move(radiance)),
        tree_(finest_),
        coarse_(finest_) {
    while (coarse_.size > exact_size) coarse_ = halved(coarse_);
  }

  [[nodiscard]] CubeLevel summed(int size, float roughness) const {
    const float alpha = roughness * roughness;
    if (roughness < exact_roughness) return convolve_blocks(size, alpha, fineness(roughness));
    SphereCut all = all_texels(coarse_);
    bright_.append_to(all);
    return convolve(size, {}, {}, all.view(alpha * alpha), kernels_);
  }

  [[nodiscard]] CubeLevel sampled(int size, float roughness, int samples, const Cube& mips) const {
    Lobe lobe = ggx_lobe(roughness, samples, finest_.size, kernels_);
    for (float& lod : lobe.lod) lod -= finer;
    return convolve(size, mips.view(), lobe.view(), bright_.view(lobe), kernels_);
  }

  [[nodiscard]] Cube mips() const {
    Cube cube(finest_.size, log2_of(finest_.size) + 1);
    CubeLevel level = finest_;
    for (int k = 0; k < cube.levels(); ++k) {
      if (k > 0) level = halved(level);
      cube.store(k, level, kernels_);
    }
    return cube;
  }

 private:
  [[nodiscard]] CubeLevel convolve_blocks(int size, float alpha, float width) const {
    CubeLevel level(size);
    const int side = std::min(block_size, size), across = size / side;
    std::vector<std::pair<SphereTree::Scratch, SphereCut>> workers(static_cast<std::size_t>(thread_count()));
    parallel_for(std::size_t{6} * std::size_t(across) * std::size_t(across), [&](std::size_t block) {
      const int face = int(block) / (across * across), i = int(block) % across * side,
                j = int(block) / across % across * side;
      auto& [scratch, cut] = workers[std::size_t(thread_index())];
      tree_.cut(cap_of(face, i, j, side, size), alpha, width, scratch, cut);
      bright_.append_to(cut);
      kernels_.prefilter_cube({{}, {}, {face, size, j, j + side, level.face(face), i, side}, cut.view(alpha * alpha)});
    });
    return level;
  }

  // The smallest cap about a block's middle that holds the centres of its texels.
  static SphereTree::Cap cap_of(int face, int i, int j, int side, int size) {
    const CubeDirection middle = texel_direction(face, i / side, j / side, size / side);
    SphereTree::Cap cap{middle.x, middle.y, middle.z, 0};
    for (int k = 0; k < 4; ++k) {
      const CubeDirection d = texel_direction(face, i + (k & 1) * (side - 1), j + (k >> 1) * (side - 1), size);
      const float x = d.x - cap.x, y = d.y - cap.y, z = d.z - cap.z;
      cap.radius = std::max(cap.radius, std::sqrt(x * x + y * y + z * z));
    }
    return cap;
  }

  const Kernels& kernels_;
  BrightTexels bright_;
  CubeLevel finest_;
  SphereTree tree_;
  CubeLevel coarse_;  // of at most exact_size
};

}  // namespace

float roughness_of_level(int level, int levels, float c) {
  // lod = (levels - 1) r (1 + c (1 - r)), solved for r.
  if (levels == 1) return 0;
  const float x = float(level) / float(levels - 1);
  if (c == 0 || level == 0 || level == levels - 1) return x;
  return 2 * x / (1 + c + std::sqrt((1 + c) * (1 + c) - 4 * c * x));
}

Cube prefiltered(CubeLevel radiance, int levels, int samples, const Kernels& kernels, float curve) {
  Cube specular(radiance.size, levels);
  specular.store(0, radiance, kernels);
  if (levels == 1) return specular;
  const Filter filter(std::move(radiance), kernels);
  const Cube mips = samples > 0 ? filter.mips() : Cube();
  for (int k = 1; k < levels; ++k) {
    const int size = specular.size() >> k;
    const float r = roughness_of_level(k, levels, curve);
    specular.store(k, samples > 0 ? filter.sampled(size, r, samples, mips) : filter.summed(size, r), kernels);
  }
  return specular;
}

Cube irradiance_cube(CubeLevel radiance, const Kernels& kernels) {
  constexpr int size = 32;
  const BrightTexels bright = cut_bright(radiance);
  while (radiance.size > size) radiance = halved(radiance);
  SphereCut all = all_texels(radiance);
  bright.append_to(all);
  Cube cube(size, 1);
  cube.store(0, convolve(size, {}, {}, all.view(1), kernels), kernels);
  return cube;
}

}  // namespace tessera

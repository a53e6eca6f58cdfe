// Shading, and the tables it reads.
#include "guards/kernel_hash.hpp"
#include "precompute/dfg.hpp"

namespace tessera {
namespace {

std::vector<std::uint16_t> random_cube(const Kernels& kernels, Random& random, int size, int levels) {
  const std::vector<float> texels = random.units(4 * cube_texel_count(size, levels), 0, 3);
  std::vector<std::uint16_t> halves(texels.size());
  kernels.pack_half(texels.data(), halves.data(), halves.size());
  return halves;
}

}  // namespace

void hash_shade(const Kernels& kernels, Random& random, Hash& hash) {
  constexpr int size = 16, levels = 5, dfg_size = 16;
  const std::vector<std::uint16_t> cube = random_cube(kernels, random, size, levels);
  std::vector<float> dfg(2 * dfg_size * dfg_size);
  kernels.dfg_table({dfg.data(), dfg_size, 0, dfg_size});
  hash.add(dfg);
  const DfgTable table(dfg.data(), dfg_size);

  GBuffer gbuffer;
  for (auto& plane : gbuffer.planes)
    for (float& x : plane.values) x = random.unit();
  const GBufferView g = gbuffer.view();
  for (std::size_t i = 0; i < GBuffer::capacity; ++i) {
    g.unlit[i] = i % 16 == 0;
    const float z = random.between(-1, 1), r = __builtin_sqrtf(1 - z * z);
    const bool along_x = i % 2;
    for (int k = 0; k < 3; ++k) g.position[k][i] = random.between(-3, 3);
    g.normal[0][i] = along_x ? r : 0;
    g.normal[1][i] = along_x ? 0 : r;
    g.normal[2][i] = z;
    if (i % 8 == 1)  // hostile values: any bits in one plane
      gbuffer.planes[i % gbuffer_planes].values[i] = random.any_bits();
  }
  kernels.clamp_surfaces(g, GBuffer::count);
  const LightView lights[] = {
      {LightType::directional, Falloff::inverse_square, {0, 0, 0}, {0, -1, 0}, {1, 2, 3}, 0, 0, 1},
      {LightType::point, Falloff::windowed_plus_one, {1, 2, 1}, {0, -1, 0}, {9, 9, 5}, 0.04f, 0, 1},
      {LightType::spot, Falloff::inverse_square, {-2, 2, 0}, {0.6f, -0.8f, 0}, {20, 10, 10}, 0, 3, -2},
  };
  EnvironmentView environment{{cube.data(), size, levels}, {cube.data(), size, levels}, {}};
  for (auto& coefficient : environment.irradiance_sh)
    for (float& x : coefficient) x = random.between(-0.2f, 0.5f);
  std::vector<GBuffer::Plane> radiance(3);
  kernels.shade({g,
                 GBuffer::count,
                 feature_all,
                 {0, 1, 6, 1},
                 lights,
                 nullptr,
                 3,
                 environment,
                 table.view(),
                 {radiance[0].values, radiance[1].values, radiance[2].values},
                 0});
  for (const auto& plane : radiance)
    for (std::size_t i = 0; i < GBuffer::count; ++i) hash.add(plane.values[i]);

  environment.lod_curve = 0.5f;
  for (const EnvironmentLobe lobe : {EnvironmentLobe::mirror, EnvironmentLobe::shifted, EnvironmentLobe::taps2,
                                     EnvironmentLobe::taps4, EnvironmentLobe::points8}) {
    // Any bits are texels in the other format.
    environment.specular.format = lobe == EnvironmentLobe::shifted ? CubeFormat::rgb9_e5 : CubeFormat::rgba16_float;
    environment.irradiance = lobe == EnvironmentLobe::taps2 ? environment.specular : CubeView{};
    kernels.shade({g,
                   GBuffer::count,
                   feature_environment,
                   {0, 1, 6, 1},
                   nullptr,
                   nullptr,
                   0,
                   environment,
                   table.view(),
                   {radiance[0].values, radiance[1].values, radiance[2].values},
                   0,
                   {lobe, EnvironmentFresnel::f0, lobe != EnvironmentLobe::mirror,
                    lobe == EnvironmentLobe::taps4     ? EnvironmentAlbedo::fit
                    : lobe == EnvironmentLobe::points8 ? EnvironmentAlbedo::small_fit
                                                       : EnvironmentAlbedo::table}});
    for (const auto& plane : radiance)
      for (std::size_t i = 0; i < GBuffer::count; ++i) hash.add(plane.values[i]);
  }

  float rgba[4][tile_pixels], remaining[tile_pixels];
  for (const float lod : {0.0f, 1.7f, 9.0f})
    for (const bool alone : {false, true}) {
      for (float(&plane)[tile_pixels] : rgba)
        for (float& x : plane) x = random.between(0, 1);
      for (float& x : remaining) x = random.between(-1, 1);
      kernels.background({{-1, 1, -1},
                          {0.07f, 0, 0},
                          {0, -0.07f, 0},
                          environment.background,
                          lod,
                          {},
                          0,
                          0,
                          tile_size,
                          tile_size,
                          alone ? nullptr : remaining,
                          {rgba[0], rgba[1], rgba[2], rgba[3]}});
      for (const float(&plane)[tile_pixels] : rgba)
        for (const float x : plane) hash.add(x);
    }
}

void hash_environment(const Kernels& kernels, Random& random, Hash& hash) {
  constexpr int size = 16, levels = 5, samples = 37;
  const std::vector<float> equirect = random.units(3 * 64 * 32);
  const std::vector<std::uint16_t> cube = random_cube(kernels, random, size, levels);
  std::vector<float> lobe[5];
  for (std::vector<float>& values : lobe) values.resize(samples + max_lanes);
  for (int i = 0; i < samples; ++i) {
    const float z = random.between(0.2f, 1), r = __builtin_sqrtf(1 - z * z);
    lobe[0][i] = i % 2 ? r : 0;
    lobe[1][i] = i % 2 ? 0 : -r;
    lobe[2][i] = z;
    lobe[3][i] = 1.0f / samples;
    lobe[4][i] = random.between(0, 4);
  }
  for (int face = 0; face < 6; ++face) {
    std::vector<float> out(4 * size * size + max_lanes);
    kernels.equirect_to_cube({{equirect.data(), 64, 32}, {0.8f, 0.6f}, 2, {face, size, 0, size, out.data()}});
    hash.add(std::vector<float>(out.begin(), out.begin() + 4 * size * size));
    kernels.prefilter_cube({{cube.data(), size, levels},
                            {lobe[0].data(), lobe[1].data(), lobe[2].data(), lobe[3].data(), lobe[4].data(), samples},
                            {face, size, 0, size, out.data()},
                            {}});
    hash.add(std::vector<float>(out.begin(), out.begin() + 4 * size * size));
    // Points alone, as a weighted mean; a block of a face.
    kernels.prefilter_cube({{},
                            {},
                            {face, size, 4, 12, out.data(), 8, 8},
                            {lobe[0].data(), lobe[1].data(), lobe[2].data(), lobe[3].data(), lobe[4].data(),
                             lobe[2].data(), samples, 0.3f, 1, lobe[2].data()}});
    kernels.faces_to_cube({{equirect.data(), 11}, {0.8f, 0.6f}, 2, {face, size, 0, 3, out.data()}});
    hash.add(std::vector<float>(out.begin(), out.begin() + 4 * size * size));
  }
}

}  // namespace tessera

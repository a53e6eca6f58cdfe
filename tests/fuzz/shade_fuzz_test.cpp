// The whole shading kernel and the tone curves on random bit patterns: total functions.
#include <gtest/gtest.h>

#include <cmath>

#include "fuzz/random_bits.hpp"
#include "kernels/runnable_kernels.hpp"
#include "kernels/shade/shade_scene.hpp"

namespace tessera::test {
namespace {

constexpr std::size_t block = 2048;

TEST(ShadeFuzz, AnyGBufferGivesFiniteRadiance) {
  GBuffer gbuffer(block);
  const Environment environment = Environment::constant(2);
  std::vector<LightView> lights = all_kinds_of_lights();
  const Kernels& kernels = *runnable_kernels().back();
  RandomBits random(11);
  std::vector<float> noise(std::size_t{gbuffer_planes} * block);
  // A pattern in every plane of every pixel.
  for (std::uint64_t done = 0; done < fuzz_count() / gbuffer_planes; done += block) {
    const std::vector<float*> planes = gbuffer.planes();
    for (std::size_t p = 0; p < planes.size(); ++p) {
      random.fill(planes[p], block);
      // Every second value of moderate size, so that not each surface is a degenerate one.
      for (std::size_t i = p % 2; i < block; i += 2)
        planes[p][i] = float(double(std::bit_cast<std::int32_t>(planes[p][i])) * 0x1p-31);
    }
    ShadeArgs args = shade_args(gbuffer, {0.3, 0.2, 3}, lights, &environment);
    const std::uint64_t round = done / block;  // every way to look the environment up
    args.environment_shading.lobe = static_cast<EnvironmentLobe>(round % 5);
    args.environment_shading.fresnel = static_cast<EnvironmentFresnel>(round / 5 % 2);
    args.environment_shading.specular_occlusion = round / 10 % 2 != 0;
    args.environment_shading.albedo = static_cast<EnvironmentAlbedo>(round % 3);
    // The halves' bits taken as words of shared exponents are a cube too: of half the size.
    if (round % 7 == 0) args.environment.specular.format = CubeFormat::rgb9_e5;
    kernels.clamp_surfaces(args.gbuffer, args.count);
    kernels.shade(args);
    for (int c = 0; c < 3; ++c) {
      bool good = true;
      for (std::size_t i = 0; i < block; ++i)
        good &= gbuffer.radiance()[c][i] >= 0 && gbuffer.radiance()[c][i] <= 3.4e38f;
      ASSERT_TRUE(good) << "channel " << c << " of block " << done / block;
    }
  }
}

TEST(ShadeFuzz, AnyFilmGivesTheSamePictureOnTheNarrowestAndTheWidest) {
  const Kernels &narrow = *runnable_kernels().front(), &wide = *runnable_kernels().back();
  RandomBits random(12);
  std::vector<float> rgba(4 * block);
  std::vector<std::uint8_t> out(4 * block), same(4 * block);
  for (std::uint64_t done = 0; done < fuzz_count() / 16; done += block)  // four channels, four curves
    for (int curve = 0; curve <= static_cast<int>(ToneCurve::khronos_neutral); ++curve) {
      random.fill(rgba.data(), rgba.size());
      narrow.encode({rgba.data(), block, 1.5f, static_cast<ToneCurve>(curve), out.data()});
      wide.encode({rgba.data(), block, 1.5f, static_cast<ToneCurve>(curve), same.data()});
      ASSERT_EQ(out, same) << "curve " << curve << " of block " << done / block;
    }
}

}  // namespace
}  // namespace tessera::test

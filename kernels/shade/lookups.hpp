// What a surface point reads of its environment, in steps that other work can go between: gathers keep the load ports
// busy, lights the multipliers, and a core's window of instructions is too short to find the one behind the other. So
// the loop over the lights does one gather beside each light.
#pragma once
#include "kernels/light/environment.hpp"
#include "kernels/shade/surface.hpp"

namespace tessera::TESSERA_ISA {
namespace {

class EnvironmentLookups {
 public:
  static constexpr std::uint32_t count = 6;  // gathers: two rows each of the table and of two levels of the cube

  TESSERA_INLINE EnvironmentLookups(const ShadingPoint<Float>& p, const EnvironmentView& environment,
                                    const DfgView& dfg) {
    dfg_ = dfg_footprint(dfg, p.NoV, p.roughness);
    // The mirror direction, of any length: not waiting for v shortens the longest chain of the loop by a root and a
    // division.
    const Vec3<Float> R = p.n * (p.to_eye_n + p.to_eye_n) - p.to_eye;
    cube_ = cube_lookup(environment.specular, R, p.roughness * Float(environment.specular.levels - 1));
    set(0, dfg.texels, dfg_.above, dfg_.below);
    set(2, environment.specular.texels, cube_.fine.above, cube_.fine.below);
    set(4, environment.specular.texels, cube_.coarse.above, cube_.coarse.below);
  }

  /// Gather number k, k < count, once each.
  TESSERA_INLINE void gather(std::uint32_t k) {
    Float words[4];
    gather_quads(base_[k], words_at_[k], words);
    for (int i = 0; i < 4; ++i) store(words_[k][i], words[i]);
  }

  // After all gathers.
  TESSERA_INLINE EnvironmentBRDF<Float> environment_brdf(const DfgView& dfg, Float NoV) const {
    const auto texels = [&](int k) -> DfgTexels<Float> { return {word(k, 0), word(k, 1), word(k, 2), word(k, 3)}; };
    const DfgTexels<Float> above = texels(0), below = texels(1);
    return blend(dfg, NoV, dfg_, above, below);
  }
  TESSERA_INLINE Vec3<Float> specular() const {
    const auto texels = [&](int k) {
      const Float words[4] = {word(k, 0), word(k, 1), word(k, 2), word(k, 3)};
      return decode_texels(words);
    };
    const TexelPair<Float> a = texels(2), b = texels(3), c = texels(4), d = texels(5);
    return blend(cube_.fine, a, b) + blend(cube_.coarse, c, d);
  }

 private:
  static constexpr int lanes = Float::lanes;

  // Both tables have entries of two words.
  TESSERA_INLINE void set(int k, const void* base, Int above, Int below) {
    base_[k] = base_[k + 1] = static_cast<const float*>(base);
    store(words_at_[k], above << 1);
    store(words_at_[k + 1], below << 1);
  }
  TESSERA_INLINE Float word(int k, int i) const { return load<Float>(words_[k][i]); }

  BilinearFootprint<Float> dfg_;
  CubeLookup<Float> cube_;
  const float* base_[count];
  alignas(64) std::int32_t words_at_[count][lanes];
  alignas(64) float words_[count][4][lanes];
};

}  // namespace
}  // namespace tessera::TESSERA_ISA

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
    const IntQuad words = gather_quads(base_[k], offsets_[k]);
    store(words_[k][0], words.x);
    store(words_[k][1], words.y);
    store(words_[k][2], words.z);
    store(words_[k][3], words.w);
  }

  // After all gathers.
  TESSERA_INLINE void environment_brdf(Float& A, Float& B) const {
    blend(dfg_, decode_dfg(words(0)), decode_dfg(words(1)), A, B);
  }
  TESSERA_INLINE Vec3<Float> specular() const {
    return blend(cube_.fine, decode_texels(words(2)), decode_texels(words(3))) +
           blend(cube_.coarse, decode_texels(words(4)), decode_texels(words(5)));
  }

 private:
  static constexpr int lanes = Float::lanes;

  // Both tables have entries of eight bytes.
  TESSERA_INLINE void set(int k, const void* base, Int above, Int below) {
    base_[k] = base_[k + 1] = base;
    store(offsets_[k], above << 3);
    store(offsets_[k + 1], below << 3);
  }
  TESSERA_INLINE IntQuad words(int k) const {
    return {load_int<Int>(words_[k][0]), load_int<Int>(words_[k][1]), load_int<Int>(words_[k][2]),
            load_int<Int>(words_[k][3])};
  }

  Footprint<Float> dfg_;
  CubeLookup<Float> cube_;
  const void* base_[count];
  alignas(64) std::int32_t offsets_[count][lanes];
  alignas(64) std::int32_t words_[count][4][lanes];
};

}  // namespace
}  // namespace tessera::TESSERA_ISA

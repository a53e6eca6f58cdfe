// Blending two materials by a mask. Layered materials in the sense of Karis 2013, Real Shading in Unreal Engine 4,
// section "Material Layering": the parameters of all layers are one shared set, and are blended linearly before
// anything is shaded, so that a blend costs one evaluation however many layers it has. What that loses against blending
// the layers' shaded results is a question of which parameter is linear in what: the forms below differ in that alone.
//
// mask in [0,1]: 0 is the first layer. Roughness perceptual, in [0.02,1].
#pragma once
#include "kernels/bsdf/distribution.hpp"
#include "kernels/bsdf/masking.hpp"
#include "kernels/math/vector.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// The parameters that layers share: metallic-roughness of glTF 2.0 with Karis' cavity (small-scale occlusion of the
/// specular lobe, 1 = open).
template <class F>
struct LayerParameters {
  Vec3<F> base_color;
  F metallic, roughness, cavity;
};

/// (1 - mask) a + mask b, as two products: accurate relative to the result, where a + mask (b - a) loses the digits of
/// a b that is far smaller than a. For a, b >= 0.
template <class F>
TESSERA_INLINE F mix(F a, F b, F mask) {
  return mul_add(mask, b, (F(1) - mask) * a);
}
template <class F>
TESSERA_INLINE Vec3<F> mix(const Vec3<F>& a, const Vec3<F>& b, F mask) {
  return {mix(a.x, b.x, mask), mix(a.y, b.y, mask), mix(a.z, b.z, mask)};
}

/// Linear in every parameter.
template <class F>
TESSERA_INLINE LayerParameters<F> blend_layers(const LayerParameters<F>& a, const LayerParameters<F>& b, F mask) {
  return {mix(a.base_color, b.base_color, mask), mix(a.metallic, b.metallic, mask), mix(a.roughness, b.roughness, mask),
          mix(a.cavity, b.cavity, mask)};
}

/// D V of the GGX lobe.
template <class F>
TESSERA_INLINE F lobe_of_alpha(F NoH, F sin2, F NoV, F NoL, F alpha) {
  return D_GGX(NoH, sin2, alpha) * V_SmithGGXCorrelated(NoV, NoL, alpha);
}

/// The lobes themselves, each shaded and then blended: what a surface does that is a mixture too fine to see.
template <class F>
TESSERA_INLINE F blend_Shaded(F NoH, F sin2, F NoV, F NoL, F roughness_a, F roughness_b, F mask) {
  const F a = lobe_of_alpha(NoH, sin2, NoV, NoL, roughness_a * roughness_a);
  const F b = lobe_of_alpha(NoH, sin2, NoV, NoL, roughness_b * roughness_b);
  return mix(a, b, mask);
}

/// Perceptual roughness blended, one lobe: Karis 2013.
template <class F>
TESSERA_INLINE F blend_Roughness(F NoH, F sin2, F NoV, F NoL, F roughness_a, F roughness_b, F mask) {
  const F r = mix(roughness_a, roughness_b, mask);
  return lobe_of_alpha(NoH, sin2, NoV, NoL, r * r);
}

/// alpha blended, one lobe.
template <class F>
TESSERA_INLINE F blend_Alpha(F NoH, F sin2, F NoV, F NoL, F roughness_a, F roughness_b, F mask) {
  return lobe_of_alpha(NoH, sin2, NoV, NoL, mix(roughness_a * roughness_a, roughness_b * roughness_b, mask));
}

/// alpha^2 blended, one lobe: the variance of slopes adds up where height fields are mixed (Olano & Baker 2010, LEAN
/// Mapping, section 3).
template <class F>
TESSERA_INLINE F blend_Variance(F NoH, F sin2, F NoV, F NoL, F roughness_a, F roughness_b, F mask) {
  const F alpha_a = roughness_a * roughness_a, alpha_b = roughness_b * roughness_b;
  return lobe_of_alpha(NoH, sin2, NoV, NoL, sqrt(mix(alpha_a * alpha_a, alpha_b * alpha_b, mask)));
}

/// F0 of blended base colour and blended metallic: Karis 2013; glTF 2.0's F0 of each.
template <class F>
TESSERA_INLINE F blend_F0Parameters(F base_a, F metallic_a, F base_b, F metallic_b, F mask) {
  const LayerParameters<F> a = {{base_a, base_a, base_a}, metallic_a, F(1), F(1)};
  const LayerParameters<F> b = {{base_b, base_b, base_b}, metallic_b, F(1), F(1)};
  const LayerParameters<F> both = blend_layers(a, b, mask);
  return mix(F(0.04), both.base_color.x, both.metallic);
}

/// F0 of each layer, blended: exact, for F0 is what reflectance is linear in.
template <class F>
TESSERA_INLINE F blend_F0(F base_a, F metallic_a, F base_b, F metallic_b, F mask) {
  return mix(mix(F(0.04), base_a, metallic_a), mix(F(0.04), base_b, metallic_b), mask);
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

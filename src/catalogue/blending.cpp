// The catalogue's methods: blending of materials.
#include "catalogue/method.hpp"

namespace tessera::catalogue {

std::vector<Method> blending_methods() {
  using Q = Quantity;
  const char* file = "kernels/bsdf/blending.hpp";
  const char* karis = "Karis 2013, Real Shading in Unreal Engine 4, Material Layering";
  const char* shaded = "both layers shaded, then blended";
  const std::vector<Q> lobe = {Q::NoH, Q::sin2, Q::NoV, Q::NoL, Q::any, Q::any, Q::albedo};
  const std::vector<Q> colors = {Q::albedo, Q::albedo, Q::albedo, Q::albedo, Q::albedo};
  return {
      {"blending", "blend_Shaded", "shade, then blend", "(1-m) DV(r1) + m DV(r2)", karis, file, "costs every layer",
       lobe, 0.02, 1, 4e-6, 1e-20, shaded, 1e-12},
      {"blending", "blend_Roughness", "blend roughness", "DV(lerp(r1, r2, m))", karis, file,
       "a smooth and a rough layer: one lobe of middling width stands for a sharp one on a broad one", lobe, 0.02, 1,
       4e-6, 1e-20, shaded, 0},
      {"blending", "blend_Alpha", "blend alpha", "DV with alpha = lerp(r1^2, r2^2, m)", karis, file,
       "as blending roughness, wider", lobe, 0.02, 1, 4e-6, 1e-20, shaded, 0},
      {"blending", "blend_Variance", "blend variance", "DV with alpha^2 = lerp(r1^4, r2^4, m)",
       "Olano & Baker 2010, LEAN Mapping, section 3", file, "as blending roughness, wider still", lobe, 0.02, 1, 4e-6,
       1e-20, shaded, 0},
      {"blending", "blend_F0Parameters", "blend base colour and metallic",
       "lerp(0.04, lerp(b1, b2, m), lerp(k1, k2, m))", karis, file,
       "a metal and a dielectric of different colours: a product of two blends is not the blend of the products",
       colors, 0, 1, 2e-7, 1, "F0 of each layer, blended", 0.26},
      {"blending", "blend_F0", "blend F0", "lerp(lerp(0.04, b1, k1), lerp(0.04, b2, k2), m)",
       "glTF 2.0, appendix B.3.5", file, "", colors, 0, 1, 2e-7, 1, "F0 of each layer, blended", 1e-12},
  };
}

}  // namespace tessera::catalogue

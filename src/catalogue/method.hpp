// The catalogue: every method with its source, its domain and the bounds that its tests and its chart hold it to.
#pragma once
#include <string>
#include <vector>

namespace tessera::catalogue {

/// What an input of a term holds, and so which values it may take. The sampler (samples.hpp) draws from the whole
/// domain, crowded where methods fail: small angles, small alpha, grazing directions.
enum class Quantity {
  NoH,   // cosine in [0,1]; drawn as an angle, down to 1e-7
  sin2,  // 1 - NoH^2 of the same angle, to float precision
  NoV,
  NoL,        // cosines in [1e-4,1]
  VoH,        // cosine in [0,1]
  LoV,        // cosine in [-1,1]
  alpha,      // [1e-4,1], logarithmic
  alpha_y,    // a second one
  roughness,  // perceptual, [0,1]
  F0,         // reflectance in [0,1]
  F82,        // reflectance at 82 degrees, [0,1]
  albedo,     // [0,1]
  eta,        // relative index of refraction of a dielectric, [1.0,3]
  metal_eta,
  metal_k,  // complex index, [0.1,5] and [0.5,10]
  gamma,    // exponent of GTR, [1,4]
  phi,      // azimuth in [0, 2 pi)
  any,      // a real number in the range that Method::range names
};

struct Method {
  std::string family;   // "fresnel", "distribution", "masking", "diffuse", "energy", "function", "dfg", "sampling"
  std::string term;     // its name among the terms (kernels/terms.hpp)
  std::string title;    // as people call it
  std::string formula;  // one line of plain text
  std::string paper;    // author, year, title, equation
  std::string file;     // where its code stands
  std::string fails;    // where it fails, in words; empty: nowhere known
  std::vector<Quantity> inputs;
  /// Arithmetic error: |float - double| <= bound * max(|double|, floor) for the same float inputs, over the whole
  /// domain. floor 0: relative all the way down.
  double arithmetic_bound = 0, arithmetic_floor = 0;
  /// Method error against `truth` (what it is compared with, in words), as the chart measures it; 0: none is known.
  std::string truth;
  double method_bound = 0;
};

/// All methods of all families, in the order in which a page lists them.
const std::vector<Method>& methods();

/// One list per family; methods() strings them together.
std::vector<Method> distribution_methods();
std::vector<Method> fresnel_methods();
std::vector<Method> masking_methods();
std::vector<Method> diffuse_methods();
std::vector<Method> energy_methods();
std::vector<Method> function_methods();

/// `count` values for each input of a method, by its quantities; the same for the same seed.
std::vector<std::vector<float>> draw_inputs(const Method& method, std::size_t count, unsigned seed);

}  // namespace tessera::catalogue

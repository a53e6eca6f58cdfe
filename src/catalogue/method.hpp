// The catalogue: every method with its source, its domain and the bounds that its tests and its chart hold it to.
#pragma once
#include <string>
#include <vector>

namespace tessera::catalogue {

/// What an input of a term holds, and so which values it may take (domain_of). Samples are drawn from all of it,
/// crowded where methods fail: small angles, small alpha, grazing directions.
enum class Quantity {
  NoH,        // cosine; drawn as an angle, down to 1e-7
  sin2,       // 1 - NoH^2 of the same angle, to float precision
  NoV,        // cosine
  NoL,        // cosine
  VoH,        // cosine
  LoV,        // cosine, of either sign
  alpha,      // logarithmic
  alpha_y,    // a second one
  roughness,  // perceptual
  F0,         // reflectance
  F82,        // reflectance at 82 degrees
  albedo,
  eta,  // relative index of refraction of a dielectric
  metal_eta,
  metal_k,      // complex index
  gamma,        // exponent of GTR
  phi,          // azimuth
  any,          // a real number in Method::low .. high
  XoH,          // component of h along the tangent; NoH, XoH and YoH of one sample belong together
  YoH,          // along the bitangent
  edge_tint,    // Gulbrandsen's g
  error_scale,  // Lazanyi & Szirmay-Kalos' a
  error_power,  // and its exponent
};

/// The values that a quantity may take, ends included.
struct Domain {
  double low, high;
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
  double low = 0, high = 1;  // of Quantity::any
  /// Arithmetic error: |float - double| <= bound * max(|double|, floor) for the same float inputs, over the whole
  /// domain. floor 0: relative all the way down.
  double arithmetic_bound = 0, arithmetic_floor = 0;
  /// Method error against `truth` (what it is compared with, in words), as the chart measures it; 0: none is known.
  std::string truth;
  double method_bound = 0;
  bool own_test = false;  // its inputs hang together, or it reads a table: its own tests hold its bounds
  bool may_be_negative = false;
  bool estimate = false;  // its bits may differ between machines: on the chart only
};

/// All methods of all families, in the order in which a page lists them.
const std::vector<Method>& methods();

/// The entry of a term. Throws std::invalid_argument for one that is not there.
const Method& method_of(const std::string& term);

/// One list per family; methods() strings them together.
std::vector<Method> distribution_methods();
std::vector<Method> fresnel_methods();
std::vector<Method> masking_methods();
std::vector<Method> diffuse_methods();
std::vector<Method> energy_methods();
std::vector<Method> function_methods();
std::vector<Method> dfg_methods();
std::vector<Method> blending_methods();

Domain domain_of(const Method& method, Quantity quantity);

/// `count` values for each input of a method, by its quantities; the same for the same seed.
std::vector<std::vector<float>> draw_inputs(const Method& method, std::size_t count, unsigned seed);

}  // namespace tessera::catalogue

#include "catalogue/lookups.hpp"

#include <stdexcept>

namespace tessera::catalogue {
namespace {

constexpr const char* variants = "kernels/texture/variants.hpp";
constexpr const char* stretch = "kernels/shade/stretch.hpp";
constexpr const char* options = "kernels/shade/environment_options.hpp";
constexpr const char* prefilter = "src/precompute/prefilter.cpp";
constexpr const char* ieee = "IEEE 754";
constexpr const char* heitz = "Heitz 2018, Sampling the GGX distribution of visible normals";

std::vector<Lookup> all() {
  return {
      {"sampling", "rgba32f", "RGBA32F", "16 bytes a texel", ieee, variants, ""},
      {"sampling", "rgba16f", "RGBA16F", "8 bytes a texel", ieee, variants, ""},
      {"sampling", "rgb9e5", "RGB9E5", "4 bytes a texel", "OpenGL 4.6, section 8.25", variants,
       "channels far below the brightest: they share its exponent"},
      {"sampling", "r11g11b10f", "R11G11B10F", "4 bytes a texel", "OpenGL 4.6, section 8.5", variants,
       "blue has five bits: greys turn yellow or blue"},
      {"sampling", "linear", "rows", "x + n y", "", variants, ""},
      {"sampling", "tiled4", "4 x 4 tiles", "texels of a tile one after another", "", variants, ""},
      {"sampling", "tiled8", "8 x 8 tiles", "texels of a tile one after another", "", variants, ""},
      {"sampling", "morton", "Morton order", "bits of x and y by turns", "Morton 1966", variants, ""},
      {"sampling", "nearest", "nearest", "one texel", "", variants, ""},
      {"sampling", "bilinear", "bilinear", "four texels", "", variants, ""},
      {"sampling", "trilinear", "trilinear", "four texels of two levels", "Williams 1983, Pyramidal Parametrics",
       variants, ""},
      {"ibl", "ibl-mirror", "n = v = r", "L(R, r)", "Karis 2013", stretch,
       "grazing angles: the round lobe does not stretch"},
      {"ibl", "ibl-shifted", "off-specular peak", "L(lerp(n, R, (1 - a)(sqrt(1 - a) + a)), r)",
       "Lagarde and de Rousiers 2014, listing 22", stretch, "grazing angles: round still"},
      {"ibl", "ibl-taps2", "two taps along the long axis", "sum w L(l, r') / sum w", heitz, stretch,
       "smooth surfaces under small lights: two highlights"},
      {"ibl", "ibl-taps4", "four taps along the long axis", "sum w L(l, r') / sum w", heitz, stretch,
       "the most grazing views of smooth surfaces"},
      {"ibl", "ibl-fis8", "eight points, filtered importance sampling", "sum w L(l, r') / sum w",
       "Krivanek and Colbert 2008; Heitz 2018", stretch, "small lights: points show"},
      {"ibl", "ibl-taps4-f0", "four taps, Fresnel with F0", "F0 A + B in place of kS A + B",
       "Fdez-Aguera 2019; Heitz 2018", options, ""},
      {"ibl", "ibl-prefilter-sums", "prefiltering by sums over a tree", "sum of K(n.l) L dw / sum of K(n.l) dw",
       "Barnes and Hut 1986", prefilter, ""},
      {"ibl", "ibl-prefilter-points", "prefiltering by sampled points", "sum of w L(l, lod)",
       "Krivanek and Colbert 2008", prefilter, "bright lights seen by few points"},
  };
}

}  // namespace

const std::vector<Lookup>& lookups() {
  static const std::vector<Lookup> list = all();
  return list;
}

const Lookup& lookup_of(const std::string& id) {
  for (const Lookup& lookup : lookups())
    if (lookup.id == id) return lookup;
  throw std::invalid_argument("no lookup " + id);
}

}  // namespace tessera::catalogue

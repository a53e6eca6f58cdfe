// Fresnel reflectance, as terms.
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/bsdf/fresnel_other.hpp"
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {
namespace {

constexpr Term<TermScalar> list[] = {
    TESSERA_TERM(F_Schlick),                // F0, VoH
    TESSERA_TERM(F_SchlickGaussian),        // F0, VoH
    TESSERA_TERM(F_SchlickGaussianSingle),  // F0, VoH
    TESSERA_TERM(F_SchlickTwoPercent),      // F0, F0 of the green channel, VoH
    TESSERA_TERM(F_SchlickRough),           // F0, NoV, roughness
    TESSERA_TERM(F_Schlick82),              // F0, F82, VoH
    TESSERA_TERM(F_LazanyiSzirmayKalos),    // F0, a, power, VoH
    TESSERA_TERM(F_Dielectric),             // eta, VoH
    TESSERA_TERM(F_CookTorrance),           // F0, VoH
    TESSERA_TERM(F_Gotanda),                // F0, VoH
    TESSERA_TERM(F_Conductor),              // eta, k, VoH
    TESSERA_TERM(F_Gulbrandsen),            // F0, edge tint, VoH
};

}  // namespace

const TermSpan<TermScalar> fresnel_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

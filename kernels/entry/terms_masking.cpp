// Masking and shadowing, as terms. V_SmithGGXCorrelated stands with the lobe (terms_lobe.cpp).
#include "kernels/bsdf/masking_classic.hpp"
#include "kernels/bsdf/masking_smith.hpp"
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// erf itself is a template and, for double, a function beside it.
template <class F>
TESSERA_INLINE F error_function(F x) {
  return erf(x);
}

constexpr Term<TermScalar> list[] = {
    TESSERA_TERM(V_SmithGGXSeparable),                  // NoV, NoL, alpha
    TESSERA_TERM(V_SmithGGXDirectionCorrelated),        // NoV, NoL, phi, alpha
    TESSERA_TERM(V_SmithGGXHeightDirectionCorrelated),  // NoV, NoL, phi, alpha
    TESSERA_TERM(V_SmithGGXCorrelatedFast),             // NoV, NoL, alpha
    TESSERA_TERM(V_SmithBeckmannSeparable),             // NoV, NoL, alpha
    TESSERA_TERM(V_SmithBeckmannCorrelated),            // NoV, NoL, alpha
    TESSERA_TERM(V_SmithBeckmannRationalSeparable),     // NoV, NoL, alpha
    TESSERA_TERM(V_SmithBeckmannRationalCorrelated),    // NoV, NoL, alpha
    TESSERA_TERM(V_SchlickGGX),                         // NoV, NoL, alpha
    TESSERA_TERM(V_SchlickGGXRemapped),                 // NoV, NoL, roughness
    TESSERA_TERM(V_SchlickBeckmann),                    // NoV, NoL, alpha
    TESSERA_TERM(V_CookTorrance),                       // NoV, NoL, NoH, VoH
    TESSERA_TERM(V_Neumann),                            // NoV, NoL
    TESSERA_TERM(V_Kelemen),                            // VoH
    TESSERA_TERM(V_Implicit),                           // NoV, NoL
    TESSERA_TERM(G1_SmithGGX),                          // mu, alpha
    TESSERA_TERM(G1_SmithBeckmann),                     // mu, alpha
    TESSERA_TERM(G1_SmithBeckmannRational),             // mu, alpha
    TESSERA_TERM(azimuth_between),                      // l.v - NoL NoV, n.(v x l)
    term<&error_function<TermNumber>>("erf"),           // x
};

}  // namespace

const TermSpan<TermScalar> masking_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

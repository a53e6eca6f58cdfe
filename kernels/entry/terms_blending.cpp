// Material blending, as terms.
#include "kernels/bsdf/blending.hpp"
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {
namespace {

constexpr Term<TermScalar> list[] = {
    TESSERA_TERM(blend_Shaded),     // NoH, sin2, NoV, NoL, roughness of a, roughness of b, mask
    TESSERA_TERM(blend_Roughness),  // the same, as the next two
    TESSERA_TERM(blend_Alpha),        TESSERA_TERM(blend_Variance),
    TESSERA_TERM(blend_F0Parameters),  // base colour and metallic of a, of b, mask
    TESSERA_TERM(blend_F0),            // the same
};

}  // namespace

const TermSpan<TermScalar> blending_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

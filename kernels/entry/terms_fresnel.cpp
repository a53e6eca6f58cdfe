// Fresnel reflectance, as terms.
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {
namespace {

constexpr Term<TermScalar> list[] = {
    TESSERA_TERM(F_Schlick),  // F0, VoH
};

}  // namespace

const TermSpan<TermScalar> fresnel_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

// All terms, over this instruction set's vectors or over double.
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {

extern const TermSpan<TermScalar>* const terms[];
const TermSpan<TermScalar>* const terms[] = {&distribution_terms, &fresnel_terms,  &lobe_terms, &masking_terms,
                                             &diffuse_terms,      &blending_terms, &dfg_terms,  &energy_terms,
                                             &function_terms,     &estimate_terms, nullptr};

}  // namespace tessera::TESSERA_ISA

#ifdef TESSERA_PRECISE
namespace tessera {
const TermSpan<double>* const* const precise_terms = TESSERA_ISA::terms;
}
#endif

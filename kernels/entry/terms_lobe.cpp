// Masking, and the specular lobe as the light loop evaluates it, as terms.
#include "kernels/bsdf/ggx_lobe.hpp"
#include "kernels/bsdf/masking.hpp"
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {
namespace {

template <class F>
TESSERA_INLINE F DV_GGX_of_surface(F H2, F NoH, F tangential2, F NoV, F NoL, F alpha) {
  return DV_GGX(ggx_lobe(NoV, alpha), H2, NoH, tangential2, NoL);
}

constexpr Term<TermScalar> list[] = {
    TESSERA_TERM(V_SmithGGXCorrelated),  // NoV, NoL, alpha
    // |l + v|^2, n.(l + v), |l + v - n (n.(l + v))|^2, NoV, NoL, alpha: D * V with one division
    term<&DV_GGX_of_surface<TermNumber>>("DV_GGX"),
};

}  // namespace

const TermSpan<TermScalar> lobe_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

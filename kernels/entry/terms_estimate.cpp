// What the default path gives up for the same bits everywhere, as terms: their names begin with "estimate_", their bits
// differ between machines, and nothing but the chart may run them. The build lets the compiler contract this file alone
// (cmake/kernels.cmake).
#include "kernels/bsdf/light_term.hpp"
#include "kernels/entry/terms.hpp"
#include "kernels/math/estimate.hpp"

namespace tessera::TESSERA_ISA {
namespace {

template <bool estimates>
TESSERA_INLINE TermNumber loose_light(TermNumber H2, TermNumber NoH, TermNumber tangential2, TermNumber NoV,
                                      TermNumber NoL, TermNumber alpha, TermNumber F0, TermNumber VoH) {
  using L = Loose<estimates, TermNumber>;
  return specular_light(L(H2), L(NoH), L(tangential2), L(NoV), L(NoL), L(alpha), L(F0), L(VoH)).value;
}

TESSERA_INLINE TermNumber reciprocal_plain(TermNumber x) { return hardware_reciprocal(x); }
TESSERA_INLINE TermNumber rsqrt_plain(TermNumber x) { return hardware_rsqrt(x); }

constexpr Term<TermScalar> list[] = {
    term<&reciprocal_plain>("estimate_reciprocal"),
    term<&estimated_reciprocal<TermNumber>>("estimate_reciprocal_newton"),
    term<&rsqrt_plain>("estimate_rsqrt"),
    term<&estimated_rsqrt<TermNumber>>("estimate_rsqrt_newton"),
    term<&loose_light<false>>("estimate_light_contracted"),
    term<&loose_light<true>>("estimate_light"),
};

}  // namespace

const TermSpan<TermScalar> estimate_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

// Elementary functions, those that kernels use and cheaper ones by degree, as terms.
#include "kernels/bsdf/light_term.hpp"
#include "kernels/entry/terms.hpp"
#include "kernels/math/approx.hpp"
#include "kernels/math/variants.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// The functions have an overload for double beside the template.
TESSERA_INLINE TermNumber exp2_default(TermNumber x) { return exp2(x); }
TESSERA_INLINE TermNumber log2_default(TermNumber x) { return log2(x); }
TESSERA_INLINE TermNumber pow_default(TermNumber x, TermNumber y) { return pow(x, y); }
TESSERA_INLINE TermNumber acos_default(TermNumber x) { return acos(x); }
TESSERA_INLINE TermNumber rsqrt_third_order(TermNumber x) { return rsqrt_householder(x); }

constexpr Term<TermScalar> list[] = {
    term<&exp2_default>("exp2"),    TESSERA_TERM(exp2_poly2),         TESSERA_TERM(exp2_poly3),
    TESSERA_TERM(exp2_poly4),       TESSERA_TERM(exp2_poly5),         term<&log2_default>("log2"),
    TESSERA_TERM(log2_poly3),       TESSERA_TERM(log2_poly5),         TESSERA_TERM(log2_poly7),
    term<&pow_default>("pow"),      TESSERA_TERM(pow_exp2_log2),      TESSERA_TERM(pow_poly5_7),
    TESSERA_TERM(pow_poly3_5),      TESSERA_TERM(rsqrt_exact),        TESSERA_TERM(rsqrt_newton1),
    TESSERA_TERM(rsqrt_newton2),    TESSERA_TERM(rsqrt_newton3),      term<&rsqrt_third_order>("rsqrt_householder"),
    TESSERA_TERM(reciprocal_exact), TESSERA_TERM(reciprocal_newton2), TESSERA_TERM(reciprocal_newton3),
    term<&acos_default>("acos"),    TESSERA_TERM(acos_poly1),         TESSERA_TERM(acos_poly3),
    TESSERA_TERM(acos_poly5),
    TESSERA_TERM(specular_light),  // |l + v|^2, n.(l + v), tangential part squared, NoV, NoL, alpha, F0, VoH
};

}  // namespace

const TermSpan<TermScalar> function_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

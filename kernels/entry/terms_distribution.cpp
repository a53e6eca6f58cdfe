// Distributions of normals, as terms.
#include "kernels/bsdf/distribution.hpp"
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {
namespace {

constexpr Term<TermScalar> list[] = {
    TESSERA_TERM(D_GGX),  // NoH, sin2 = 1 - NoH^2 taken from the vectors, alpha
};

}  // namespace

const TermSpan<TermScalar> distribution_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

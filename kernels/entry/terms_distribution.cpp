// Distributions of normals, as terms.
#include "kernels/bsdf/distribution.hpp"
#include "kernels/bsdf/distribution_other.hpp"
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {
namespace {

constexpr Term<TermScalar> list[] = {
    TESSERA_TERM(D_GGX),                  // NoH, sin2 = 1 - NoH^2 taken from the vectors, alpha
    TESSERA_TERM(D_GGX_naive),            // NoH, alpha
    TESSERA_TERM(D_Beckmann),             // NoH, sin2, alpha
    TESSERA_TERM(D_BlinnPhong),           // sin2, alpha
    TESSERA_TERM(D_BlinnPhong_naive),     // NoH, alpha
    TESSERA_TERM(D_GTR),                  // NoH, sin2, alpha, gamma
    TESSERA_TERM(D_GTR1),                 // NoH, sin2, alpha
    TESSERA_TERM(D_GGXAnisotropic),       // XoH, YoH, NoH, alpha_x, alpha_y
    TESSERA_TERM(D_BeckmannAnisotropic),  // XoH, YoH, NoH, alpha_x, alpha_y
};

}  // namespace

const TermSpan<TermScalar> distribution_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

// Diffuse lobes and their share of the light, as terms: one channel. Lobes that are proportional to the albedo are
// given for albedo 1.
#include "kernels/bsdf/diffuse.hpp"
#include "kernels/bsdf/diffuse_eon.hpp"
#include "kernels/bsdf/diffuse_split.hpp"
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {
namespace {

template <class F>
TESSERA_INLINE F lambert(F albedo) {
  return Fd_Lambert(Vec3<F>{albedo, albedo, albedo}).x;
}

constexpr Term<TermScalar> list[] = {
    term<&lambert<TermNumber>>("Fd_Lambert"),  // albedo
    TESSERA_TERM(Fd_Burley),                   // roughness, NoV, NoL, LoH
    TESSERA_TERM(Fd_Frostbite),                // roughness, NoV, NoL, LoH
    TESSERA_TERM(Fd_OrenNayar),                // sigma, NoV, NoL, LoV
    TESSERA_TERM(Fd_Fujii),                    // roughness, NoV, NoL, LoV
    TESSERA_TERM(Fd_EON),                      // albedo, roughness, NoV, NoL, LoV
    TESSERA_TERM(Fd_EONExact),                 // albedo, roughness, NoV, NoL, LoV
    TESSERA_TERM(Fd_AshikhminShirley),         // F0, NoV, NoL
    TESSERA_TERM(kd_Fresnel),                  // F, metallic
    TESSERA_TERM(kd_AlbedoScaled),             // F0, A, B, metallic
    TESSERA_TERM(kd_Coupled),                  // E(v), E(l), Eavg, metallic
};

}  // namespace

const TermSpan<TermScalar> diffuse_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

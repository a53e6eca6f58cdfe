// Diffuse lobes and their share of the light, as terms: one channel, albedo first, so that their costs compare.
#include "kernels/bsdf/diffuse.hpp"
#include "kernels/bsdf/diffuse_eon.hpp"
#include "kernels/bsdf/diffuse_split.hpp"
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {
namespace {

using N = TermNumber;

TESSERA_INLINE N Lambert(N albedo) { return Fd_Lambert(Vec3<N>{albedo, albedo, albedo}).x; }
// albedo * function(parameter, NoV, NoL, third cosine)
template <N (*function)(N, N, N, N)>
TESSERA_INLINE N with_albedo(N albedo, N parameter, N NoV, N NoL, N cosine) {
  return albedo * function(parameter, NoV, NoL, cosine);
}
TESSERA_INLINE N AshikhminShirley(N albedo, N f0, N NoV, N NoL) { return albedo * Fd_AshikhminShirley(f0, NoV, NoL); }
TESSERA_INLINE N EON(N albedo, N roughness, N NoV, N NoL, N LoV) { return Fd_EON(albedo, roughness, NoV, NoL, LoV); }

constexpr Term<TermScalar> list[] = {
    term<&Lambert>("Fd_Lambert"),                         // albedo
    term<&with_albedo<Fd_Burley<N>>>("Fd_Burley"),        // albedo, roughness, NoV, NoL, LoH
    term<&with_albedo<Fd_Frostbite<N>>>("Fd_Frostbite"),  // albedo, roughness, NoV, NoL, LoH
    term<&with_albedo<Fd_OrenNayar<N>>>("Fd_OrenNayar"),  // albedo, sigma, NoV, NoL, LoV
    term<&with_albedo<Fd_Fujii<N>>>("Fd_Fujii"),          // albedo, roughness, NoV, NoL, LoV
    term<&EON>("Fd_EON"),                                 // albedo, roughness, NoV, NoL, LoV
    TESSERA_TERM(Fd_EONExact),                            // albedo, roughness, NoV, NoL, LoV
    term<&AshikhminShirley>("Fd_AshikhminShirley"),       // albedo, F0, NoV, NoL
    TESSERA_TERM(kd_Fresnel),                             // F, metallic
    TESSERA_TERM(kd_AlbedoScaled),                        // F0, A, B, metallic
    TESSERA_TERM(kd_Coupled),                             // E(v), E(l), Eavg, metallic
};

}  // namespace

const TermSpan<TermScalar> diffuse_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

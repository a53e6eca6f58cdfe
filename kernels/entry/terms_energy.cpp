// Energy that single scattering loses, and its compensation, as terms.
#include "kernels/bake/dfg.hpp"
#include "kernels/bsdf/energy_compensation.hpp"
#include "kernels/entry/terms.hpp"

namespace tessera::TESSERA_ISA {
namespace {

template <class F>
TESSERA_INLINE F Ems_GGX_table(TermTable table, F NoV, F alpha) {
  return Ems_GGX_lookup(table.texels, table.size, NoV, alpha);
}
template <class F>
TESSERA_INLINE F Ems_GGX_integral(F NoV, F alpha) {
  const Dfg<F> dfg = integrate_dfg(NoV, sqrt(alpha));
  return max(F(1) - (dfg.A + dfg.B), F(0));
}
template <class F>
TESSERA_INLINE F f_KullaConty_table(TermTable table, F single, F f0, F NoV, F NoL, F alpha) {
  return f_KullaConty_lookup(table.texels, table.size, single, f0, NoV, NoL, alpha);
}
template <class F>
TESSERA_INLINE F f_Turquin_table(TermTable table, F single, F f0, F NoV, F alpha) {
  return f_Turquin_lookup(table.texels, table.size, single, f0, NoV, alpha);
}

// A method of both forms: TermOutputs are the weights of radiance and of irradiance / pi.
template <auto function, class... In>
TESSERA_INLINE TermOutputs<2> weights(In... in) {
  const auto split = function(in...);
  return {split.single, split.multiple};
}
template <auto function, class... In>
constexpr Term<TermScalar> split_term(const char* name, TermSignature<ChannelSplit<TermNumber> (*)(In...)>) {
  return term<&weights<function, In...>>(name);
}

constexpr Term<TermScalar> list[] = {
    TESSERA_TERM(Ems_GGX),                // NoV, alpha: 1 - E by polynomial
    TESSERA_TERM(Ems_GGX_table),          // NoV, alpha: from a table (energy_loss.hpp)
    TESSERA_TERM(Ems_GGX_integral),       // NoV, alpha: by quadrature, as tables are baked
    TESSERA_TERM(Emsavg_GGX),             // alpha
    TESSERA_TERM(Favg_Schlick),           // F0
    TESSERA_TERM(Fms_KullaConty),         // F0, Emsavg
    TESSERA_TERM(Fms_KullaConty_slides),  // F0, Emsavg
    TESSERA_TERM(Fms_Hill),               // F0, NoV, alpha
    TESSERA_TERM(scale_Turquin),          // F0, Ems
    // value of the single-scattering lobe, then F0, NoV, NoL, alpha as far as they are needed
    TESSERA_TERM(f_SingleScattering), TESSERA_TERM(f_KullaConty), TESSERA_TERM(f_KullaConty_slides),
    TESSERA_TERM(f_KullaConty_table),
    TESSERA_TERM(f_Turquin),        // without NoL
    TESSERA_TERM(f_Turquin_table),  // without NoL
    TESSERA_TERM(f_Hill),
#define TESSERA_SPLIT_TERM(function) \
  split_term<&function<TermNumber>>(#function, TermSignature<decltype(&function<TermNumber>)>())
    // F0, A, B, then NoV and alpha or roughness as far as they are needed
    TESSERA_SPLIT_TERM(split_SingleScattering),
    TESSERA_SPLIT_TERM(split_KullaConty),     // F0, A, B, alpha
    TESSERA_SPLIT_TERM(split_Turquin),        // F0, A, B
    TESSERA_SPLIT_TERM(split_Hill),           // F0, A, B, NoV, alpha
    TESSERA_SPLIT_TERM(split_FdezAguera),     // F0, A, B
    TESSERA_SPLIT_TERM(split_FdezAguera_kS),  // F0, A, B, NoV, roughness
};

}  // namespace

const TermSpan<TermScalar> energy_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

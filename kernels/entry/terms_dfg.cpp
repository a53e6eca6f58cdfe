// The environment BRDF, as terms: its integral, lookups in tables of it, and fits. NoV and roughness in; A and B out.
#include "kernels/bake/dfg.hpp"
#include "kernels/bsdf/dfg_fit.hpp"
#include "kernels/entry/terms.hpp"
#include "kernels/light/dfg_lookup.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// Both clamped to what the quadrature holds for: n.v >= 1e-10, roughness >= 1e-3.
template <class F>
TESSERA_INLINE Dfg<F> dfg_integral(F NoV, F roughness) {
  return integrate_dfg(clamp(NoV, F(1e-10), F(1)), clamp(roughness, F(1e-3), F(1)));
}

template <auto function, class F>
TESSERA_INLINE TermOutputs<2> pair(F NoV, F roughness) {
  const auto ab = function(NoV, roughness);
  return {{ab.A, ab.B}};
}

template <class Axes, class Filter, class Format>
TESSERA_INLINE TermOutputs<2> look_up(TermTable table, TermNumber NoV, TermNumber roughness) {
  const EnvironmentBRDF<TermNumber> ab = look_up_dfg<Axes, Filter, Format>(table.texels, table.size, NoV, roughness);
  return {{ab.A, ab.B}};
}

#define TESSERA_PAIR(function) term<&pair<&function<TermNumber>, TermNumber>>(#function)
#define TESSERA_LOOKUP(axes, Axes, filter, Filter, format, Format) \
  term<&look_up<Axes, Filter, Format>>("dfg_" #axes "_" #filter "_" #format)
#define TESSERA_LOOKUPS_OF(axes, Axes, filter, Filter)                 \
  TESSERA_LOOKUP(axes, Axes, filter, Filter, float, DfgFloatFormat),   \
      TESSERA_LOOKUP(axes, Axes, filter, Filter, half, DfgHalfFormat), \
      TESSERA_LOOKUP(axes, Axes, filter, Filter, unorm16, DfgUnormFormat)
#define TESSERA_LOOKUPS(axes, Axes)                                                                           \
  TESSERA_LOOKUPS_OF(axes, Axes, nearest, DfgNearest), TESSERA_LOOKUPS_OF(axes, Axes, bilinear, DfgBilinear), \
      TESSERA_LOOKUPS_OF(axes, Axes, cubic, DfgCubic)

constexpr Term<TermScalar> list[] = {
    TESSERA_PAIR(dfg_integral),
    TESSERA_PAIR(dfg_Lazarov),
    TESSERA_PAIR(dfg_Karis),
    TESSERA_PAIR(dfg_MaterialX),
    TESSERA_PAIR(dfg_fit),
    TESSERA_PAIR(dfg_fit_small),
    TESSERA_LOOKUPS(linear, DfgLinearAxes),
    TESSERA_LOOKUPS(root, DfgRootAxes),
    TESSERA_LOOKUPS(warped, DfgWarpedAxes),
};

}  // namespace

const TermSpan<TermScalar> dfg_terms = span_of(list);

}  // namespace tessera::TESSERA_ISA

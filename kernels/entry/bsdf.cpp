// The BSDF's terms over arrays.
#include "kernels/bsdf/distribution.hpp"
#include "kernels/bsdf/fresnel.hpp"
#include "kernels/bsdf/ggx_lobe.hpp"
#include "kernels/bsdf/masking.hpp"
#include "kernels/entry/entries.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// Reads and writes whole vectors, then the rest through a small copy: arrays of callers need no padding.
template <int Inputs, class Term>
inline void for_each_vector(const BsdfTermArgs& args, Term term) {
  std::size_t i = 0;
  Float in[max_term_inputs];
  for (; i + Float::lanes <= args.count; i += Float::lanes) {
    for (int k = 0; k < Inputs; ++k) in[k] = load<Float>(args.in[k] + i);
    store(args.out + i, term(in));
  }
  if (i == args.count) return;
  float rest[Float::lanes];
  for (int k = 0; k < Inputs; ++k) {
    for (std::size_t lane = 0; lane < std::size_t{Float::lanes}; ++lane)
      rest[lane] = args.in[k][i + lane < args.count ? i + lane : i];
    in[k] = load<Float>(rest);
  }
  store(rest, term(in));
  for (std::size_t lane = 0; i + lane < args.count; ++lane) args.out[i + lane] = rest[lane];
}

}  // namespace

void evaluate_bsdf(const BsdfTermArgs& args) {
  switch (args.term) {
    case BsdfTerm::D_GGX:
      return for_each_vector<3>(args, [](const Float* in) { return D_GGX(in[0], in[1], in[2]); });
    case BsdfTerm::V_SmithGGXCorrelated:
      return for_each_vector<3>(args, [](const Float* in) { return V_SmithGGXCorrelated(in[0], in[1], in[2]); });
    case BsdfTerm::F_Schlick:
      return for_each_vector<2>(args, [](const Float* in) { return F_Schlick(in[0], in[1]); });
    case BsdfTerm::DV_GGX:
      return for_each_vector<6>(
          args, [](const Float* in) { return DV_GGX(ggx_lobe(in[3], in[5]), in[0], in[1], in[2], in[4]); });
  }
}

}  // namespace tessera::TESSERA_ISA

// How a function becomes a Term: included by kernels/entry/terms_*.cpp. With TESSERA_PRECISE they are compiled over
// double instead of vectors of floats.
#pragma once
#include "kernels/simd.hpp"
#include "kernels/terms.hpp"

namespace tessera::TESSERA_ISA {

#ifdef TESSERA_PRECISE
using TermScalar = double;
#else
using TermScalar = float;
#endif

// One list per entry file, collected by terms.cpp.
extern const TermSpan<TermScalar> distribution_terms, fresnel_terms, lobe_terms, energy_terms;
extern const TermSpan<TermScalar> masking_terms, diffuse_terms;
extern const TermSpan<TermScalar> blending_terms;
extern const TermSpan<TermScalar> dfg_terms;
extern const TermSpan<TermScalar> function_terms, estimate_terms;

namespace {

#ifdef TESSERA_PRECISE
using TermNumber = double;
inline constexpr std::size_t term_lanes = 1;
#else
using TermNumber = Float;
inline constexpr std::size_t term_lanes = Float::lanes;
#endif

/// What a function with several results returns: out[0], out[1] ...
template <int N>
struct TermOutputs {
  TermNumber value[N];
};

template <class Result>
struct TermResult {
  static constexpr int count = 1;
  TESSERA_INLINE static const TermNumber& get(const Result& r, int) { return r; }
};
template <int N>
struct TermResult<TermOutputs<N>> {
  static constexpr int count = N;
  TESSERA_INLINE static const TermNumber& get(const TermOutputs<N>& r, int i) { return r.value[i]; }
};

TESSERA_INLINE Float load_term(const float* p, Float) { return load<Float>(p); }
TESSERA_INLINE double load_term(const double* p, double) { return *p; }
TESSERA_INLINE void store_term(float* p, Float x) { store(p, x); }
TESSERA_INLINE void store_term(double* p, double x) { *p = x; }

/// What TermArgs::table holds; a function that reads it takes this first.
struct TermTable {
  const float* texels;
  int size;
};

template <class Signature>
struct TermSignature;
template <class Result, class... In>
struct TermSignature<Result (*)(In...)> {
  static constexpr int inputs = sizeof...(In), outputs = TermResult<Result>::count;
  static constexpr bool table = false;
};
template <class Result, class... In>
struct TermSignature<Result (*)(TermTable, In...)> {
  static constexpr int inputs = sizeof...(In), outputs = TermResult<Result>::count;
  static constexpr bool table = true;
};

// function(table?, in[0], in[1] ...), as many as it takes.
template <auto function, class... Given>
TESSERA_INLINE auto call_term(const TermNumber* in, Given... given) {
  using Signature = TermSignature<decltype(function)>;
  if constexpr (int(sizeof...(Given)) == Signature::inputs + (Signature::table ? 1 : 0)) {
    return function(given...);
  } else {
    return call_term<function>(in + 1, given..., *in);
  }
}

// `vectors` whole vectors from and to the arrays. One copy of the code per term, with everything inlined into its loop:
// what a chart times, and what instructions.py counts.
template <auto function>
[[gnu::noinline, gnu::flatten]] void run_vectors(const TermArgs<TermScalar>& args, std::size_t vectors) {
  using Signature = TermSignature<decltype(function)>;
  const TermArgs<TermScalar> a = args;
  for (std::size_t i = 0; i < vectors * term_lanes; i += term_lanes) {
    TermNumber in[Signature::inputs];
    for (int k = 0; k < Signature::inputs; ++k) in[k] = load_term(a.in[k] + i, TermNumber());
    const auto evaluate = [&]() {
      if constexpr (Signature::table) {
        return call_term<function>(in, TermTable{a.table, a.table_size});
      } else {
        return call_term<function>(in);
      }
    };
    const auto result = evaluate();
    using Result = TermResult<decltype(evaluate())>;
    for (int k = 0; k < Signature::outputs; ++k) store_term(a.out[k] + i, Result::get(result, k));
  }
}

// Whole vectors in place, the rest through a small copy: arrays of callers need no padding.
template <auto function>
void run_term(const TermArgs<TermScalar>& args) {
  using Signature = TermSignature<decltype(function)>;
  const std::size_t vectors = args.count / term_lanes, done = vectors * term_lanes;
  run_vectors<function>(args, vectors);
  if (done == args.count) return;
  TermScalar in[Signature::inputs][term_lanes], out[Signature::outputs][term_lanes];
  TermArgs<TermScalar> rest = args;
  for (int k = 0; k < Signature::inputs; ++k) {
    for (std::size_t lane = 0; lane < term_lanes; ++lane)
      in[k][lane] = args.in[k][done + lane < args.count ? done + lane : done];
    rest.in[k] = in[k];
  }
  for (int k = 0; k < Signature::outputs; ++k) rest.out[k] = out[k];
  run_vectors<function>(rest, 1);
  for (int k = 0; k < Signature::outputs; ++k)
    for (std::size_t lane = 0; done + lane < args.count; ++lane) args.out[k][done + lane] = out[k][lane];
}

template <auto function>
constexpr Term<TermScalar> term(const char* name) {
  using Signature = TermSignature<decltype(function)>;
  static_assert(Signature::inputs <= max_term_inputs && Signature::outputs <= max_term_outputs);
  return {name, Signature::inputs, Signature::outputs, run_term<function>};
}

template <int N>
constexpr TermSpan<TermScalar> span_of(const Term<TermScalar> (&list)[N]) {
  return {list, N};
}

}  // namespace
}  // namespace tessera::TESSERA_ISA

// A term whose name is its function's.
#define TESSERA_TERM(function) term<&function<TermNumber>>(#function)

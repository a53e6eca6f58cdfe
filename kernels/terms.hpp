// The catalogue's methods as functions over arrays: each is the very function of kernels/ that the shading loop calls
// (or could call), behind one signature, for tests, charts and tables. A term is found by its name, which is the name
// of its function.
//
// The same list exists twice: over float, once per instruction set (Kernels::terms), and over double, compiled from
// the same templates (precise_terms). The difference of the two is a term's arithmetic error; the difference between
// the double form and ground truth is the error of its method.
#pragma once
#include <cstddef>

namespace tessera {

inline constexpr int max_term_inputs = 8;
inline constexpr int max_term_outputs = 3;

template <class Number>
struct TermArgs {
  const Number* in[max_term_inputs];
  Number* out[max_term_outputs];
  std::size_t count;
  // For terms that read a table: size x size texels, row j = perceptual roughness, column i = NoV; what a texel holds,
  // and where its nodes lie, stands with the term.
  const float* table;
  int table_size;
};

template <class Number>
struct Term {
  const char* name;
  int inputs, outputs;
  void (*run)(const TermArgs<Number>&);
};

template <class Number>
struct TermSpan {
  const Term<Number>* first;
  int count;
};

/// The terms over double. libm's functions stand in for Tessera's own, so no bit of a picture may come from here.
extern const TermSpan<double>* const* const precise_terms;

/// From a null-terminated list of spans; null if there is none of that name.
template <class Number>
inline const Term<Number>* find_term(const TermSpan<Number>* const* spans, const char* name) {
  for (; *spans != nullptr; ++spans)
    for (int i = 0; i < (*spans)->count; ++i) {
      const char *a = (*spans)->first[i].name, *b = name;
      while (*a != 0 && *a == *b) ++a, ++b;
      if (*a == *b) return &(*spans)->first[i];
    }
  return nullptr;
}

}  // namespace tessera

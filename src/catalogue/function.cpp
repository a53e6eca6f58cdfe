// The catalogue's methods: elementary functions, and what machines' own estimates would buy.
#include "catalogue/method.hpp"

namespace tessera::catalogue {
namespace {

using Q = Quantity;

struct Range {
  double low, high;
};
constexpr Range exponents = {-126, 127}, positive = {1e-6, 16}, powers = {0.01, 4}, wide = {1e-4, 1e4},
                cosines = {-1, 1};

const char* const own = "kernels/math/approx.hpp";
const char* const variants = "kernels/math/variants.hpp";
const char* const libm = "libm in double";

// bound: of the method, as relative or absolute as `floor` makes it.
Method function(std::string term, std::string title, std::string formula, std::string paper, const char* file,
                Range range, double arithmetic, double floor, double bound) {
  Method method;
  method.family = "function";
  method.term = std::move(term);
  method.title = std::move(title);
  method.formula = std::move(formula);
  method.paper = std::move(paper);
  method.file = file;
  method.inputs = {Q::any};
  method.low = range.low;
  method.high = range.high;
  method.arithmetic_bound = arithmetic;
  method.arithmetic_floor = floor;
  method.truth = libm;
  method.method_bound = bound;
  return method;
}

void add_exponential(std::vector<Method>& list) {
  const char* fit = "this project; minimax by Lawson's iteration";
  list.push_back(function("exp2", "exp2, default", "2^n P6(f), |f| <= 1/2", fit, own, exponents, 1.2e-7, 0, 1.2e-7));
  list.push_back(function("exp2_poly2", "exp2, degree 2", "2^n P2(f)", fit, variants, exponents, 3e-7, 0, 1.8e-3));
  list.push_back(function("exp2_poly3", "exp2, degree 3", "2^n P3(f)", fit, variants, exponents, 3e-7, 0, 7.6e-5));
  list.push_back(function("exp2_poly4", "exp2, degree 4", "2^n P4(f)", fit, variants, exponents, 3e-7, 0, 2.7e-6));
  list.push_back(function("exp2_poly5", "exp2, degree 5", "2^n P5(f)", fit, variants, exponents, 3e-7, 0, 2e-7));
  const auto first = list.size();
  list.push_back(function("log2", "log2, default", "e + log2(1 + f), degree 9, 1/ln 2 in two parts", fit, own, positive,
                          3e-7, 1, 1e-6));
  list.push_back(function("log2_poly3", "log2, degree 3", "e + f P2(f)", fit, variants, positive, 2e-6, 1, 8.6e-4));
  list.push_back(function("log2_poly5", "log2, degree 5", "e + f P4(f)", fit, variants, positive, 2e-6, 1, 1.5e-5));
  list.push_back(function("log2_poly7", "log2, degree 7", "e + f P6(f)", fit, variants, positive, 2e-6, 1, 4e-7));
  for (auto i = first; i < list.size(); ++i) list[i].may_be_negative = true;
}

void add_powers(std::vector<Method>& list) {
  const auto first = list.size();
  list.push_back(function("pow", "pow, default", "2^(y log2 x), the logarithm in two floats",
                          "this project; artanh series", own, powers, 1.2e-7, 0, 1.2e-7));
  list.push_back(function("pow_exp2_log2", "exp2(y log2 x)", "the defaults, composed", "common practice", variants,
                          powers, 6e-6, 0, 6e-6));
  list.push_back(function("pow_poly5_7", "exp2 of degree 5, log2 of degree 7", "2^(y log2 x)", "common practice",
                          variants, powers, 6e-6, 0, 6e-6));
  list.push_back(function("pow_poly3_5", "exp2 of degree 3, log2 of degree 5", "2^(y log2 x)", "common practice",
                          variants, powers, 6e-6, 0, 1.3e-4));
  for (auto i = first; i < list.size(); ++i) {
    list[i].inputs = {Q::any, Q::any};
    if (i > first) list[i].fails = "large powers: the logarithm's error, magnified by y";
  }
}

void add_roots(std::vector<Method>& list) {
  const char* lomont = "Lomont 2003, Fast Inverse Square Root";
  const char* ieee = "IEEE 754";
  list.push_back(
      function("rsqrt_exact", "1 / sqrt(x), default", "division and square root", ieee, variants, wide, 2e-7, 0, 2e-7));
  list.push_back(function("rsqrt_newton1", "bit trick, 1 Newton step", "y (1.5 - x/2 y^2)", lomont, variants, wide,
                          3e-7, 0, 1.8e-3));
  list.push_back(function("rsqrt_newton2", "bit trick, 2 Newton steps", "y (1.5 - x/2 y^2)", lomont, variants, wide,
                          3e-7, 0, 5e-6));
  list.push_back(function("rsqrt_newton3", "bit trick, 3 Newton steps", "y (1.5 - x/2 y^2)", lomont, variants, wide,
                          3e-7, 0, 4e-7));
  list.push_back(function("rsqrt_householder", "bit trick, third order, Newton", "y (1 + h/2 + 3/8 h^2), h = 1 - x y^2",
                          "Lomont 2003; Householder 1970", variants, wide, 2e-7, 0, 2e-7));
  list.push_back(function("reciprocal_exact", "1 / x, default", "division", ieee, variants, wide, 7e-8, 0, 7e-8));
  list.push_back(function("reciprocal_newton2", "bit trick, 2 Newton steps", "y + y (1 - x y)", lomont, variants, wide,
                          3e-7, 0, 3e-4));
  list.push_back(function("reciprocal_newton3", "bit trick, 3 Newton steps", "y + y (1 - x y)", lomont, variants, wide,
                          3e-7, 0, 3e-7));
}

void add_arc_cosine(std::vector<Method>& list) {
  const char* form = "Abramowitz & Stegun 1964, 4.4.45; own coefficients";
  list.push_back(function("acos", "acos, default", "pi/2 - asin, or 2 asin sqrt((1-x)/2)", "this project; minimax", own,
                          cosines, 4e-7, 1, 4e-7));
  list.push_back(function("acos_poly1", "acos, degree 1", "sqrt(1-x) P1(x)", form, variants, cosines, 6e-7, 1, 3.3e-3));
  list.push_back(function("acos_poly3", "acos, degree 3", "sqrt(1-x) P3(x)", form, variants, cosines, 6e-7, 1, 4e-5));
  list.push_back(function("acos_poly5", "acos, degree 5", "sqrt(1-x) P5(x)", form, variants, cosines, 6e-7, 1, 1.2e-6));
}

Method light(std::string term, std::string title, std::string formula, const char* file, bool estimate) {
  Method method =
      function(std::move(term), std::move(title), std::move(formula),
               "Walter et al. 2007, eq. 33; Heitz 2014, eq. 99; Schlick 1994, eq. 15", file, {0, 1}, 0, 0, 0);
  method.truth = "the same formula in double";
  method.inputs = {Q::any, Q::any, Q::any, Q::NoV, Q::NoL, Q::alpha, Q::F0, Q::VoH};
  method.own_test = true;
  method.estimate = estimate;
  return method;
}

void add_estimates(std::vector<Method>& list) {
  const char* file = "kernels/math/estimate.hpp";
  const char* fails = "the bits differ between machines, makers and compilers: never in a picture";
  list.push_back(light("specular_light", "a light, default", "D V F n.l, one division, two roots",
                       "kernels/bsdf/light_term.hpp", false));
  list.push_back(light("estimate_light_contracted", "a light, contraction allowed",
                       "D V F n.l as the compiler fuses it", file, true));
  list.push_back(light("estimate_light", "a light, contraction and estimates", "and with rcp, rsqrt and a Newton step",
                       file, true));
  for (const bool newton : {false, true})
    for (const std::string name : {"rsqrt", "reciprocal"}) {
      Method method = function("estimate_" + name + (newton ? "_newton" : ""),
                               newton ? "hardware estimate, 1 Newton step" : "hardware estimate",
                               name == "rsqrt" ? "RSQRTPS, VRSQRT14PS, FRSQRTE" : "RCPPS, VRCP14PS, FRECPE",
                               "Intel and Arm instruction sets", file, wide, 0, 0, newton ? 3e-5 : 4e-3);
      method.estimate = true;
      list.push_back(method);
    }
  for (Method& method : list)
    if (method.estimate) method.fails = fails;
}

}  // namespace

std::vector<Method> function_methods() {
  std::vector<Method> list;
  add_exponential(list);
  add_powers(list);
  add_roots(list);
  add_arc_cosine(list);
  add_estimates(list);
  return list;
}

}  // namespace tessera::catalogue

// The catalogue's methods: the environment BRDF.
#include "catalogue/method.hpp"

namespace tessera::catalogue {
namespace {

using Q = Quantity;

Method dfg(std::string term, std::string title, std::string formula, std::string paper, std::string file,
           std::string fails, double method_bound) {
  Method method;
  method.family = "dfg";
  method.term = std::move(term);
  method.title = std::move(title);
  method.formula = std::move(formula);
  method.paper = std::move(paper);
  method.file = std::move(file);
  method.fails = std::move(fails);
  method.inputs = {Q::NoV, Q::roughness};
  method.truth = "quadrature of the GGX lobe in double";
  method.method_bound = method_bound;
  return method;
}

std::vector<Method> fits() {
  const char* file = "kernels/bsdf/dfg_fit.hpp";
  std::vector<Method> list = {
      dfg("dfg_Lazarov", "Lazarov's fit", "A, B from min(g 0.475, 2^(-9.28 NoV)), g = 1 - r",
          "Lazarov 2013, Getting More Physical in Call of Duty: Black Ops II", file,
          "fitted to Blinn-Phong and another masking: off by up to 0.5", 0),
      dfg("dfg_Karis", "Karis's mobile fit", "A, B from min((1-r)^2, 2^(-9.28 NoV))",
          "Karis 2014, Physically Based Shading on Mobile, EnvBRDFApprox", file,
          "fitted to another masking: off by up to 0.46", 0),
      dfg("dfg_MaterialX", "MaterialX's rational fit", "A = N1/D1, B = N2/D2, biquadratic in NoV and alpha",
          "MaterialX 1.38, mx_ggx_dir_albedo_analytic", file, "NoV and alpha near 0: off by 0.07 to 0.1", 0),
      dfg("dfg_fit", "Tessera's fit",
          "1 - A - B = (1-x)/2 P(x, alpha), B = (1-NoV)^5 Q(y, r), x, y = ratios of NoV to alpha",
          "this project; coordinates derived in kernels/light/dfg_lookup.hpp", file, "", 2e-3),
      dfg("dfg_fit_small", "Tessera's small fit", "as Tessera's fit, with cubics",
          "this project; coordinates derived in kernels/light/dfg_lookup.hpp", file, "", 1.4e-2),
  };
  // The clamps' rounding aside, what float makes of them: exp2 and sums of coefficients up to 630 in the first of ours.
  list[0].arithmetic_bound = list[1].arithmetic_bound = list[2].arithmetic_bound = 2e-6;
  list[3].arithmetic_bound = 6e-4;
  list[4].arithmetic_bound = 4e-6;
  for (Method& method : list) method.arithmetic_floor = 1;
  return list;
}

Method integral() {
  Method method = dfg("dfg_integral", "quadrature", "256 nodes over half-vectors", "this project; kernels/bake/dfg.hpp",
                      "kernels/bake/dfg.hpp", "NoV < 1e-10, roughness < 1e-3: clamped", 1.5e-5);
  method.arithmetic_bound = 1e-5;
  method.arithmetic_floor = 1;
  return method;
}

struct Choice {
  const char *name, *title;
};
constexpr Choice axes[] = {{"linear", "linear axes"}, {"root", "root axes"}, {"warped", "warped axes"}};
constexpr Choice filters[] = {{"nearest", "nearest"}, {"bilinear", "bilinear"}, {"cubic", "cubic"}};
constexpr Choice formats[] = {{"float", "float"}, {"half", "half"}, {"unorm16", "unorm16"}};

const char* failure_of(const std::string& axis) {
  if (axis == "linear") return "NoV < 0.02 or r < 0.05, whatever the size";
  if (axis == "root") return "NoV and r both small: a corner that no size resolves";
  return "";
}

}  // namespace

std::vector<Method> dfg_methods() {
  std::vector<Method> list = fits();
  list.push_back(integral());
  for (const Choice& a : axes)
    for (const Choice& filter : filters)
      for (const Choice& format : formats) {
        const std::string term = std::string("dfg_") + a.name + "_" + filter.name + "_" + format.name;
        Method method = dfg(term, std::string("table, ") + a.title + ", " + filter.title + ", " + format.title,
                            a.name == std::string("warped")
                                ? "1 - A - B and (1 - NoV)^5 - B over s (1 + 2r) / (s + 2r) and root r, s = root NoV"
                                : "A and B over NoV and r",
                            "this project; after Karis 2013, Real Shading in Unreal Engine 4, split sum",
                            "kernels/light/dfg_lookup.hpp", failure_of(a.name), 0);
        method.own_test = true;
        list.push_back(method);
      }
  return list;
}

}  // namespace tessera::catalogue

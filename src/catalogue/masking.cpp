// The catalogue's methods: masking.
#include "catalogue/method.hpp"

namespace tessera::catalogue {

std::vector<Method> masking_methods() {
  using Q = Quantity;
  Method lobe{"masking",
              "DV_GGX",
              "GGX lobe with one division",
              "alpha^2/(2 pi) |H|^4 / ((T + alpha^2 N^2)^2 (NoL root(NoV) + NoV root(NoL)))",
              "Walter et al. 2007, eq. 33 and Heitz 2014, eq. 99, fused",
              "kernels/bsdf/ggx_lobe.hpp",
              "",
              {Q::any, Q::any, Q::any, Q::NoV, Q::NoL, Q::alpha},
              0,
              1,
              1e-5,
              0,
              "D times V in double",
              1e-5};
  lobe.own_test = true;
  return {
      {"masking",
       "V_SmithGGXCorrelated",
       "Smith GGX, height-correlated",
       "0.5 / (NoL sqrt(NoV^2 (1 - a^2) + a^2) + NoV sqrt(NoL^2 (1 - a^2) + a^2))",
       "Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, eq. 99",
       "kernels/bsdf/masking.hpp",
       "",
       {Q::NoV, Q::NoL, Q::alpha},
       0,
       1,
       2e-6,
       0,
       "exact Smith",
       1e-6},
      lobe,
  };
}

}  // namespace tessera::catalogue

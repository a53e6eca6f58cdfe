// Gauss-Legendre quadrature.
#pragma once
#include <functional>
#include <vector>

namespace tessera::reference {

struct QuadratureRule {
  std::vector<double> nodes, weights;  // over [0,1]
};

/// Exact for polynomials of degree 2n - 1. Computed once per n.
const QuadratureRule& gauss_legendre(int n);

/// Integral of f over [a,b], cut into `pieces` equal parts of n nodes each.
double integrate(const std::function<double(double)>& f, double a, double b, int n = 32, int pieces = 1);

}  // namespace tessera::reference

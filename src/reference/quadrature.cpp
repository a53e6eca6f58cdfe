#include "reference/quadrature.hpp"

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

namespace tessera::reference {
namespace {

// Legendre's P_n and its derivative at x, by the three-term recurrence.
void legendre(int n, double x, double* value, double* derivative) {
  double previous = 1, current = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * current - (k - 1) * previous) / k;
    previous = current;
    current = next;
  }
  *value = current;
  *derivative = n * (x * current - previous) / (x * x - 1);
}

QuadratureRule make_rule(int n) {
  QuadratureRule rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), value = 0, derivative = 1;
    for (int step = 0; step < 100; ++step) {
      legendre(n, x, &value, &derivative);
      const double change = value / derivative;
      x -= change;
      if (std::abs(change) < 1e-16) break;
    }
    legendre(n, x, &value, &derivative);
    rule.nodes.push_back(0.5 * (1 - x));
    rule.weights.push_back(1 / ((1 - x * x) * derivative * derivative));
  }
  return rule;
}

}  // namespace

const QuadratureRule& gauss_legendre(int n) {
  static std::mutex mutex;
  static std::map<int, QuadratureRule> rules;
  const std::lock_guard lock(mutex);
  const auto found = rules.find(n);
  return found != rules.end() ? found->second : rules.emplace(n, make_rule(n)).first->second;
}

double integrate(const std::function<double(double)>& f, double a, double b, int n, int pieces) {
  const QuadratureRule& rule = gauss_legendre(n);
  const double width = (b - a) / pieces;
  double sum = 0;
  for (int piece = 0; piece < pieces; ++piece)
    for (int i = 0; i < n; ++i) sum += rule.weights[i] * f(a + width * (piece + rule.nodes[i]));
  return sum * width;
}

}  // namespace tessera::reference

// Two programs timed by turns, so that a machine that slows down slows both.
#pragma once
#include <algorithm>
#include <functional>
#include <vector>

#include "base/stopwatch.hpp"

namespace tessera::determinism {

/// A number's median, and the middle half of what was seen.
struct Spread {
  double median = 0, low = 0, high = 0;
};

inline Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values[n / 2], values[n / 4], values[n - 1 - n / 4]};
}

struct Comparison {
  double first_ms = 0, second_ms = 0;  // medians
  Spread ratio;                        // first / second, pair by pair
  Spread control;                      // first / first: what this machine's noise looks like
};

/// Each round runs first, second, second, first: drift within a round cancels.
inline Comparison compare(const std::function<void()>& first, const std::function<void()>& second, int rounds) {
  const auto time = [](const std::function<void()>& body) {
    const Stopwatch watch;
    body();
    return watch.ms();
  };
  for (int k = 0; k < 2; ++k) first(), second();
  std::vector<double> a, b, ratio, control;
  for (int k = 0; k < rounds; ++k) {
    const double a0 = time(first), b0 = time(second), b1 = time(second), a1 = time(first);
    a.push_back((a0 + a1) / 2);
    b.push_back((b0 + b1) / 2);
    ratio.push_back(a.back() / b.back());
    control.push_back(a0 / a1);
  }
  return {spread_of(a).median, spread_of(b).median, spread_of(ratio), spread_of(control)};
}

}  // namespace tessera::determinism

// Straight lines through measured times.
#pragma once
#include "bench/scaling/parts.hpp"

namespace tessera::scaling {

/// time = fixed + each * x.
struct LinearFit {
  double fixed = 0, each = 0;
};

/// Least squares of the relative errors, over the cases with x from `from` on (at least two).
LinearFit fit_line(const Series& series, double from = 0);

}  // namespace tessera::scaling

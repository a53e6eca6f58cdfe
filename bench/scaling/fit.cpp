#include "bench/scaling/fit.hpp"

namespace tessera::scaling {

LinearFit fit_line(const Series& series, double from) {
  // Minimises the sum of ((fixed + each x) / t - 1)^2: ordinary least squares of 1 over 1/t and x/t.
  double aa = 0, ab = 0, bb = 0, a = 0, b = 0;
  for (const Case& c : series.cases) {
    if (c.x < from) continue;
    const double p = 1 / c.time.median, q = c.x / c.time.median;
    aa += p * p, ab += p * q, bb += q * q, a += p, b += q;
  }
  const double determinant = aa * bb - ab * ab;
  return {(a * bb - b * ab) / determinant, (b * aa - a * ab) / determinant};
}

}  // namespace tessera::scaling

// Cost against error as letters on a terminal.
#pragma once
#include <string>
#include <vector>

namespace tessera::cli {

struct ChartPoint {
  double cost, error;
  char mark;  // where several fall on one place, a letter wins over '.'
};

/// Both axes are logarithmic. Errors under 0.001 share the lowest row, which is called "exact". The row of `limit` is
/// dashed. At least one point; costs above 0.
std::string draw_chart(const std::vector<ChartPoint>& points, double limit);

}  // namespace tessera::cli

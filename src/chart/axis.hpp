// A logarithmic axis: from values to positions, and where its ticks stand.
#pragma once
#include <string>
#include <vector>

namespace tessera::chart {

struct Tick {
  double value;
  bool major;         // a labelled one
  std::string label;  // empty if not major
};

/// Values from 10^low to 10^high onto positions from `from` to `to` (either may be the larger).
struct LogAxis {
  double low = 0, high = 1;
  double from = 0, to = 1;

  /// Not clamped; value must be positive.
  [[nodiscard]] double at(double value) const;
  /// Decades are labelled; on an axis shorter than `sparse` decades, twos and fives too. On a long axis only every
  /// n-th decade, so that at most `most` of them are.
  [[nodiscard]] std::vector<Tick> ticks(int most = 8) const;
};

/// An axis that holds all the positive finite values among `values`, with `margin` (a share of its length) on either
/// side, and at least `least` decades long. Without any such value: 1 to 10.
LogAxis axis_over(const std::vector<double>& values, double least, double margin, double from, double to);

/// 0.002 -> "0.002", 2e-7 -> "2·10⁻⁷", 1e-7 -> "10⁻⁷": as an axis shows it.
std::string tick_label(double value);

}  // namespace tessera::chart

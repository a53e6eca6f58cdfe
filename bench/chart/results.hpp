// Everything that one run measured, and the two files that keep it: results.json and results.csv.
#pragma once
#include <string>
#include <vector>

#include "bench/chart/chart.hpp"

namespace tessera::chart {

/// Where and how a run was made.
struct Machine {
  std::string cpu, compiler, flags, commit, date, version;
  double clock_ghz = 0;           // 0: unknown
  bool quick = false;             // --quick
  std::vector<std::string> isas;  // measured, narrowest first
};

struct Results {
  Machine machine;
  std::vector<Family> families;
};

/// The error that a plot shows.
double measured(const Error& error, Measure measure);

/// results.json; its schema stands in results.md.
std::string to_json(const Results& results);
/// The reverse. The text is not trusted: whatever is wrong with it throws Error(input), which begins with `name` and
/// says where it is wrong. Error maps come back rounded to six digits.
Results from_json(const std::string& text, const std::string& name);
Results read_results(const std::string& path);

/// One row per method, plot and instruction set, as RFC 4180 has it.
std::string to_csv(const Results& results);

}  // namespace tessera::chart

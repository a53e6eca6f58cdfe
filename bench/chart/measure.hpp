// What families share: running terms over float and double, and taking errors.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "bench/chart/chart.hpp"
#include "catalogue/lookups.hpp"
#include "catalogue/method.hpp"

namespace tessera::chart {

/// First output of a term over double, for these float inputs.
std::vector<double> in_double(const std::string& term, const std::vector<std::vector<float>>& inputs,
                              const float* table = nullptr, int table_size = 0, int output = 0);

/// First output of a term on the session's widest instruction set; the others give the same bits.
std::vector<double> in_float(const Session&, const std::string& term, const std::vector<std::vector<float>>& inputs,
                             const float* table = nullptr, int table_size = 0, int output = 0);

/// |found - truth| over all i.
Error absolute_error(const std::vector<double>& found, const std::vector<double>& truth);

/// |found - truth| / max(|truth|, floor); floor must be above 0 where truth may be 0.
Error relative_error(const std::vector<double>& found, const std::vector<double>& truth, double floor);

/// A point with the catalogue's texts, nothing measured yet. id: the term's name in lower case, with hyphens.
Point describe(const std::string& term);
/// The same of a lookup; id: its own, and `suffix` after a hyphen.
Point describe(const catalogue::Lookup& lookup, const std::string& suffix);

/// Whether the session measures this instruction set.
bool runs_on(const Session& session, const std::string& isa);

/// Times a term over all the inputs given, and adds how many instructions its loop has.
void add_cost(Session&, Point&, const std::string& term, std::vector<std::vector<float>> inputs,
              const float* table = nullptr, int table_size = 0);

/// Evenly spaced values, ends included.
std::vector<double> spread(double low, double high, int count);
/// Evenly spaced logarithms.
std::vector<double> spread_logarithmic(double low, double high, int count);

/// An error map filled by value(column, row).
ErrorMap map_over(std::string title, std::string column_name, std::vector<double> columns, std::string row_name,
                  std::vector<double> rows, const std::function<double(double column, double row)>& value);

/// "0.0123", "1.2e-05": a number as findings print it.
std::string number(double value);

}  // namespace tessera::chart

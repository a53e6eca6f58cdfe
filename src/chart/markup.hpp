// Text that goes into HTML, SVG and tables.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace tessera::chart {

/// For element content and attribute values alike; control characters, which XML forbids, become spaces.
std::string escaped(const std::string& text);

/// A coordinate: at most two decimals, no trailing zeros.
std::string coordinate(double value);

/// Three significant digits, as a table shows an amount: "0.00123", "1.2e-07" as "1.20·10⁻⁷"; "–" if it is no number.
std::string amount(double value);

/// Its beginning, at most that many bytes, ending in "…" if anything was left out. Never cuts a character of UTF-8.
std::string shortened(const std::string& text, std::size_t most);

/// Replaces every {{name}} by its value; a name that is missing is an error of the program.
std::string filled_in(const std::string& text, const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace tessera::chart

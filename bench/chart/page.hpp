// index.html: everything in one file that needs no network.
#pragma once
#include <string>

#include "bench/chart/results.hpp"

namespace tessera::chart {

/// other: the run to compare with, or null.
std::string make_page(const Results& results, const Results* other = nullptr);

// Parts of it; each returns HTML.
std::string page_table(const Results& results, const Family& family, const Plot& plot, const Plot* other);
std::string page_maps(const Plot& plot);
/// What the tooltips say, as JSON that may stand inside a <script>.
std::string page_data(const Results& results, const Results* other);

}  // namespace tessera::chart

// The files of a chart: index.html, results.json, results.csv, plots/*.svg and *.png, maps/*.png.
#pragma once
#include <string>

#include "bench/chart/results.hpp"

namespace tessera::chart {

/// Makes the folder if it is not there. Throws Error(output) where a chart could not be written later.
void prepare_folder(const std::string& folder);

/// Writes them into the folder, which is made if it is not there. Each file appears whole or not at all; index.html is
/// written last. Throws Error(output).
void write_chart(const std::string& folder, const Results& results, const Results* other = nullptr);

}  // namespace tessera::chart

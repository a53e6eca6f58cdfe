// What was measured, in words, as JSON and as charts.
#pragma once
#include <string>

#include "bench/scaling/parts.hpp"

namespace tessera::scaling {

/// For every case its time, and how it stands to what is proportional to `x` (of threads: how many times faster).
std::string table_of(const Part& part);

/// One object.
std::string json_of(const Part& part, const std::string& isa, int threads);

/// A whole SVG file; empty for threads.
std::string chart_of(const Part& part, const std::string& isa, int threads);

}  // namespace tessera::scaling

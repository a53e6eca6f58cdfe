// What a result depends on besides the method: the machine and the build.
#pragma once
#include "bench/chart/results.hpp"

namespace tessera::chart {

/// CPU, compiler, flags, commit, date and clock of this machine, build and moment. isas and quick are left alone.
Machine describe_machine();

/// The clock this thread runs at, in GHz, from how long a chain of dependent additions takes; 0 where that is not
/// known. It takes some ten milliseconds.
double measure_clock_ghz();

}  // namespace tessera::chart

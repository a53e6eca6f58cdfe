// Which families there are. The list is made at build time from the files family_*.cpp (cmake/chart.cmake).
#pragma once
#include <string>
#include <vector>

#include "bench/chart/chart.hpp"

namespace tessera::chart {

struct FamilyEntry {
  std::string name;
  Family (*measure)(Session&);
};

/// In the order in which a page shows them.
const std::vector<FamilyEntry>& families();

}  // namespace tessera::chart

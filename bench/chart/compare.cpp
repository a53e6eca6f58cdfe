#include "bench/chart/compare.hpp"

#include <cmath>
#include <set>

#include "chart/markup.hpp"

namespace tessera::chart {

const Plot* matching_plot(const Results& other, const std::string& family, const std::string& plot) {
  for (const Family& f : other.families)
    if (f.id == family)
      for (const Plot& p : f.plots)
        if (p.id == plot) return &p;
  return nullptr;
}

const Point* matching_point(const Plot* other, const std::string& id) {
  if (other != nullptr)
    for (const Point& point : other->points)
      if (point.id == id) return &point;
  return nullptr;
}

double cost_ratio(const Point& mine, const Point* theirs, const std::string& isa) {
  if (theirs == nullptr) return 0;
  const auto a = mine.cost.find(isa), b = theirs->cost.find(isa);
  if (a == mine.cost.end() || b == theirs->cost.end() || !(a->second.ns > 0) || !(b->second.ns > 0)) return 0;
  return a->second.ns / b->second.ns;
}

std::vector<RatioSummary> summarise_ratios(const Results& mine, const Results& theirs) {
  std::vector<RatioSummary> rows;
  for (const Family& family : mine.families)
    for (const std::string& isa : mine.machine.isas) {
      RatioSummary row{family.title, isa, 0, 0, 0, 0, "", ""};
      std::set<std::string> counted;
      for (const Plot& plot : family.plots) {
        const Plot* other = matching_plot(theirs, family.id, plot.id);
        for (const Point& point : plot.points) {
          const double ratio = cost_ratio(point, matching_point(other, point.id), isa);
          if (ratio == 0 || !counted.insert(point.id).second) continue;
          row.geometric_mean += std::log(ratio);
          if (row.methods == 0 || ratio < row.lowest) {
            row.lowest = ratio;
            row.lowest_title = point.title;
          }
          if (row.methods == 0 || ratio > row.highest) {
            row.highest = ratio;
            row.highest_title = point.title;
          }
          ++row.methods;
        }
      }
      if (row.methods == 0) continue;
      row.geometric_mean = std::exp(row.geometric_mean / row.methods);
      rows.push_back(row);
    }
  return rows;
}

std::string name_of_run(const Machine& machine) {
  return "other run: " + shortened(machine.cpu, 60) + ", commit " + shortened(machine.commit, 24);
}

}  // namespace tessera::chart

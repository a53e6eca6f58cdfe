// Writes a synthetic chart, and one compared with another run, for the browser test: sample_page FOLDER
#include <cstdio>

#include "bench/chart/output.hpp"
#include "synthetic.hpp"

int main(int argc, char** argv) {
  using namespace tessera;
  if (argc != 2) return 2;
  const chart::Results results = chart_test::synthetic_results();
  chart::Results other = results;
  other.machine.cpu = "Another CPU";
  for (chart::Family& family : other.families)
    for (chart::Plot& plot : family.plots)
      for (chart::Point& point : plot.points)
        for (auto& [isa, cost] : point.cost) {
          cost.ns *= 1.4;
          cost.low *= 1.4;
          cost.high *= 1.4;
        }
  chart::write_chart(std::string(argv[1]) + "/plain", results);
  chart::write_chart(std::string(argv[1]) + "/compared", results, &other);
  std::puts(argv[1]);
  return 0;
}

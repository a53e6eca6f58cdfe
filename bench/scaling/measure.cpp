#include "bench/scaling/measure.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "base/stopwatch.hpp"

namespace tessera::scaling {
namespace {

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

void measure_in_turns(std::vector<Case*> cases, int rounds, double seconds) {
  std::vector<std::vector<double>> medians(cases.size());
  for (int round = -1; round < rounds; ++round)
    for (std::size_t i = 0; i < cases.size(); ++i)
      run_with_threads(cases[i]->threads, [&] {
        if (round < 0) return cases[i]->frame();
        const bool is_short = medians[i].empty() || medians[i].back() < 1000 * seconds;
        if (is_short) cases[i]->frame();  // what others left in the caches goes
        std::vector<double> frames;
        const Stopwatch all;
        while (frames.size() < 2 || all.ms() < 1000 * seconds) {
          const Stopwatch watch;
          cases[i]->frame();
          frames.push_back(watch.ms());
        }
        medians[i].push_back(median_of(frames));
      });
  for (std::size_t i = 0; i < cases.size(); ++i)
    cases[i]->time = {median_of(medians[i]), *std::min_element(medians[i].begin(), medians[i].end()),
                      *std::max_element(medians[i].begin(), medians[i].end())};
}

}  // namespace tessera::scaling

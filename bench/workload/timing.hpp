// Frame after frame: two untimed ones, then at least fifteen and as many as fit into the time given.
#pragma once
#include <time.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

namespace tessera::workload {

/// Milliseconds per frame: wall clock, and processor time of all threads.
struct Timing {
  double median = 0, min = 0, p90 = 0, cpu_median = 0, cpu_min = 0;
  int frames = 0;
};

inline Timing measure(const std::function<void()>& frame, double seconds) {
  const auto wall = [] {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  const auto cpu = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
  };
  for (int warm = 0; warm < 2; ++warm) frame();
  std::vector<double> walls, cpus;
  const double start = wall();
  while (walls.size() < 15 || (wall() - start < seconds * 1000 && walls.size() < 1000)) {
    const double w = wall(), c = cpu();
    frame();
    walls.push_back(wall() - w);
    cpus.push_back(cpu() - c);
  }
  std::sort(walls.begin(), walls.end());
  std::sort(cpus.begin(), cpus.end());
  return {walls[walls.size() / 2], walls.front(), walls[walls.size() * 9 / 10],
          cpus[cpus.size() / 2],   cpus.front(),  int(walls.size())};
}

}  // namespace tessera::workload

// The session that the program runs its families in: times through Google Benchmark, progress on a terminal.
#pragma once
#include "base/progress.hpp"
#include "bench/chart/chart.hpp"

namespace tessera::chart {

class TimedSession : public Session {
 public:
  explicit TimedSession(Progress& progress) : progress_(progress) {}
  Cost time(std::uint64_t evaluations, const std::function<void()>& body) override;
  void progress(const std::string& what) override;
  int timings = 0;  // how often time() was called

 private:
  Progress& progress_;
};

}  // namespace tessera::chart

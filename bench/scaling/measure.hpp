// Times of frames that take turns: a machine that slows down slows all of them.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace tessera::scaling {

/// Milliseconds per frame: the median over the rounds, the least and the most of a round.
struct Time {
  double median = 0, least = 0, most = 0;
};

struct Case {
  double x = 0;  // what is varied
  int threads = 0;
  std::function<void()> frame;  // runs on the threads of the caller's arena
  Time time{};
  std::string name{};  // of x, where it has one
};

/// One frame of each that is not counted, then rounds: each case in turn for `seconds`, at least two frames, after one
/// that is not counted where frames are shorter than that; a round's value is the median of its frames.
void measure_in_turns(std::vector<Case*> cases, int rounds, double seconds);

}  // namespace tessera::scaling

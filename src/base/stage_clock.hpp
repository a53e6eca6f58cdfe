// Where a thread's time goes: the machine's time-stamp counter, read at the end of each stage of the work. A reading
// costs some ten nanoseconds, a handful of them a tile, so that it is always on.
#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace tessera {

/// Work on a frame, in the order in which it happens: of the whole scene, then inside tiles.
enum class Stage {
  vertices,
  triangles,
  bins,
  coverage,
  alpha_mask,
  collect,
  resolve,
  shade,
  background,
  composite,
  count
};
inline constexpr int stage_count = static_cast<int>(Stage::count), first_tile_stage = static_cast<int>(Stage::coverage);
inline constexpr std::array<const char*, stage_count> stage_names = {"vertices",   "triangles", "bins",    "coverage",
                                                                     "alpha_mask", "collect",   "resolve", "shade",
                                                                     "background", "composite"};

/// Ticks of a clock of constant rate, the same on all cores.
inline std::uint64_t ticks() {
#if defined(__x86_64__)
  return __rdtsc();
#elif defined(__aarch64__)
  std::uint64_t value = 0;
  asm volatile("mrs %0, cntvct_el0" : "=r"(value));
  return value;
#else
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

/// One stretch of one thread's work.
struct StageEvent {
  Stage stage;
  std::uint32_t item;  // number of the tile, or of the piece of the scene
  std::uint64_t begin, end;
};

/// One thread's.
class StageClock {
 public:
  /// Forgets everything; keeps memory. traced: remember each stretch, too.
  void reset(bool traced) {
    ticks_ = {};
    events_.clear();
    traced_ = traced;
  }
  void start(std::uint32_t item) {
    item_ = item;
    last_ = ticks();
  }
  /// Adds the time since the last call to a stage.
  void lap(Stage stage) {
    const std::uint64_t now = ticks();
    ticks_[static_cast<std::size_t>(stage)] += now - last_;
    if (traced_) events_.push_back({stage, item_, last_, now});
    last_ = now;
  }
  [[nodiscard]] const std::array<std::uint64_t, stage_count>& totals() const { return ticks_; }
  [[nodiscard]] const std::vector<StageEvent>& events() const { return events_; }

 private:
  std::array<std::uint64_t, stage_count> ticks_{};
  std::vector<StageEvent> events_;
  std::uint64_t last_ = 0;
  std::uint32_t item_ = 0;
  bool traced_ = false;
};

}  // namespace tessera

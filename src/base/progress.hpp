// How far a long job is, drawn on one line of a terminal.
#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace tessera {

/// A job goes through stages, each of a known number of steps. Nothing is drawn before the job is a second old, nor
/// more than ten times a second; the line is erased at the end.
class Progress {
 public:
  enum class Show { never, on_terminal, always };  // on_terminal: if standard error is one
  explicit Progress(Show show = Show::never);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Starts a stage of `total` steps (0: unknown). Not while another thread advances.
  void begin(std::string_view stage, std::size_t total);
  /// Counts steps done. From any thread.
  void advance(std::size_t steps = 1);
  /// Ends the job and erases the line.
  void finish();

 private:
  void draw(std::int64_t now);
  [[nodiscard]] std::int64_t milliseconds() const;

  const bool enabled_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<std::size_t> done_{0};
  std::atomic<std::int64_t> next_draw_;
  std::mutex drawing_;  // guards what follows
  std::string stage_;
  std::size_t total_ = 0;
  bool drawn_ = false;
};

}  // namespace tessera

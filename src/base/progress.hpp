// How far a long job is, drawn on one line of a terminal.
#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace tessera {

/// A job goes through stages. Nothing is drawn before the job is a second old, nor
/// more than ten times a second; the line is erased at the end. A thread of its own draws, so that counting is cheap.
class Progress {
 public:
  enum class Show { never, on_terminal, always };  // on_terminal: if standard error is one
  explicit Progress(Show show = Show::never);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Starts a stage; until the first set_fraction its length is unknown.
  void begin(std::string_view stage);
  /// Tells how far the stage is. From any thread.
  void set_fraction(std::size_t done, std::size_t total) {
    done_.store(static_cast<float>(done) / static_cast<float>(total), std::memory_order_relaxed);
  }
  /// Ends the job and erases the line.
  void finish();

 private:
  static constexpr float unknown = -1;
  void draw_until_finished();
  void draw() const;

  std::atomic<float> done_{unknown};
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::string stage_;
  bool finished_ = false;
  std::thread drawer_;  // runs only if there is something to draw on
};

}  // namespace tessera

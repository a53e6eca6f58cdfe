#include "base/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace tessera {
namespace {

constexpr std::chrono::milliseconds first_draw{1000}, draw_interval{100};
constexpr std::size_t bar_width = 30;

}  // namespace

Progress::Progress(Show show) {
  if (show == Show::always || (show == Show::on_terminal && isatty(STDERR_FILENO) == 1))
    drawer_ = std::thread([this] { draw_until_finished(); });
}

Progress::~Progress() { finish(); }

void Progress::begin(std::string_view stage) {
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  done_.store(unknown, std::memory_order_relaxed);
}

void Progress::draw_until_finished() {
  std::unique_lock lock(mutex_);
  if (changed_.wait_for(lock, first_draw, [this] { return finished_; })) return;
  do draw();
  while (!changed_.wait_for(lock, draw_interval, [this] { return finished_; }));
  std::fputs("\r\033[K", stderr);
}

void Progress::draw() const {
  const float done = done_.load(std::memory_order_relaxed);
  if (done < 0) {
    std::fprintf(stderr, "\r\033[K%s ...", stage_.c_str());
  } else {
    const auto filled = static_cast<std::size_t>(std::min(done, 1.0f) * bar_width);
    const std::string bar = std::string(filled, '#') + std::string(bar_width - filled, '-');
    std::fprintf(stderr, "\r\033[K%s [%s] %3.0f %%", stage_.c_str(), bar.c_str(), 100.0 * static_cast<double>(done));
  }
  std::fflush(stderr);
}

void Progress::finish() {
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  changed_.notify_all();
  if (drawer_.joinable()) drawer_.join();
}

}  // namespace tessera
